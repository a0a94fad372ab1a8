//! A session that is recorded while it happens.

use super::error::WriteError;
use super::mcap::McapWriter;
use crate::bag::ros_type;
use crate::own_metadata;
use std::io::{Seek, Write};

/// Writes messages of others as they come, as MCAP. What reached the output is whole records, so that a
/// session that is killed is read to the last of them.
pub struct SessionWriter<W: Write + Seek> {
    writer: McapWriter<W>,
}

impl<W: Write + Seek> SessionWriter<W> {
    /// A session without messages.
    ///
    /// # Errors
    ///
    /// A failing `output`.
    pub fn new(output: W) -> Result<Self, WriteError> {
        let mut writer = McapWriter::in_order(output)?;
        writer.metadata(own_metadata::NAME, &own_metadata::of_session())?;
        writer.flush()?;
        Ok(Self { writer })
    }

    /// Writes a message in CDR of the type `message_type` (`sensor_msgs/msg/Image`); of types that no
    /// recording needs, nothing. It may wait in memory for others: see [`Self::flush`].
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn write(
        &mut self,
        topic: &str,
        message_type: &str,
        received_ns: i64,
        data: &[u8],
    ) -> Result<(), WriteError> {
        self.writer.write(topic, &ros_type(message_type), received_ns, data)
    }

    /// Hands what was written to the output.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn flush(&mut self) -> Result<(), WriteError> {
        self.writer.flush()
    }

    /// Writes what is left, and the index.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn finish(self) -> Result<(), WriteError> {
        self.writer.finish()
    }
}
