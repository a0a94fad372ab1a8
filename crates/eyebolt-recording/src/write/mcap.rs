//! MCAP with ROS 2 messages, as `ros2 bag record -s mcap` writes it.

use super::definitions::{TF_STATIC, definition, is_latched};
use super::error::WriteError;
use crate::message::{StaticTransform, types, write_transforms};
use mcap::records::{MessageHeader, Metadata};
use mcap::{Compression, McapError, WriteOptions};
use std::collections::BTreeMap;
use std::io::{self, Seek, Write};
use std::path::PathBuf;

/// Writes messages, one after the other.
pub struct McapWriter<W: Write + Seek> {
    writer: mcap::Writer<W>,
    channels: BTreeMap<String, (u16, u32)>,
}

/// Bytes after which a chunk is closed.
const CHUNK: u64 = 4 << 20;

/// Quality of service of topics whose last message also reaches those who come late.
const LATCHED: &str = "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 1\n  \
    deadline:\n    sec: 9223372036\n    nsec: 854775807\n  lifespan:\n    sec: 9223372036\n    \
    nsec: 854775807\n  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    \
    nsec: 854775807\n  avoid_ros_namespace_conventions: false\n";

impl<W: Write + Seek> McapWriter<W> {
    /// A file without messages.
    ///
    /// # Errors
    ///
    /// A failing `output`.
    pub fn new(output: W) -> Result<Self, WriteError> {
        Self::with(output, WriteOptions::new())
    }

    /// As [`Self::new`], of which a chunk stays in memory until it is whole.
    pub(super) fn in_order(output: W) -> Result<Self, WriteError> {
        Self::with(output, WriteOptions::new().disable_seeking(true))
    }

    fn with(output: W, options: WriteOptions) -> Result<Self, WriteError> {
        // One thread: the same bytes on every machine.
        let options = options
            .compression(Some(Compression::Zstd))
            .compression_threads(0)
            .chunk_size(Some(CHUNK))
            .profile("ros2")
            .library(concat!("eyebolt ", env!("CARGO_PKG_VERSION")));
        let writer = options.create(output).map_err(failed)?;
        Ok(Self { writer, channels: BTreeMap::new() })
    }

    /// Writes a metadata record called `name`.
    pub(crate) fn metadata(
        &mut self,
        name: &str,
        values: &BTreeMap<String, String>,
    ) -> Result<(), WriteError> {
        let metadata = Metadata { name: name.to_owned(), metadata: values.clone() };
        self.writer.write_metadata(&metadata).map_err(failed)
    }

    /// Writes a message in CDR of the type `message_type` (`sensor_msgs/PointCloud2`), stamped `log_time_ns`; of types that are
    /// not known, nothing.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn write(
        &mut self,
        topic: &str,
        message_type: &str,
        log_time_ns: i64,
        data: &[u8],
    ) -> Result<(), WriteError> {
        let (channel_id, sequence) = match self.channels.get(topic).copied() {
            Some(known) => known,
            None => match self.add_channel(topic, message_type)? {
                Some(added) => added,
                None => return Ok(()),
            },
        };
        self.channels.insert(topic.to_owned(), (channel_id, sequence.wrapping_add(1)));
        let time = u64::try_from(log_time_ns).unwrap_or(0);
        let header = MessageHeader { channel_id, sequence, log_time: time, publish_time: time };
        self.writer.write_to_known_channel(&header, data).map_err(failed)
    }

    fn add_channel(
        &mut self,
        topic: &str,
        message_type: &str,
    ) -> Result<Option<(u16, u32)>, WriteError> {
        let Some(definition) = definition(message_type) else { return Ok(None) };
        let name = message_type.replacen('/', "/msg/", 1);
        let schema = self.writer.add_schema(&name, "ros2msg", definition.as_bytes());
        let schema = schema.map_err(failed)?;
        let profile = if is_latched(topic, message_type) { LATCHED } else { "" };
        let metadata = BTreeMap::from([("offered_qos_profiles".to_owned(), profile.to_owned())]);
        let channel = self.writer.add_channel(schema, topic, "cdr", &metadata).map_err(failed)?;
        Ok(Some((channel, 0)))
    }

    /// Ends the chunk, and hands it to the output.
    pub(super) fn flush(&mut self) -> Result<(), WriteError> {
        self.writer.flush().map_err(failed)
    }

    /// Writes what is left, and the index.
    ///
    /// # Errors
    ///
    /// A failing output.
    pub fn finish(mut self) -> Result<(), WriteError> {
        self.writer.finish().map_err(failed)?;
        self.writer.into_inner().flush().map_err(unwritable)
    }
}

/// Writes an MCAP with `transforms` on `/tf_static`, stamped `stamp_ns`.
///
/// # Errors
///
/// A failing `output`.
pub fn write_static_transforms(
    transforms: &[StaticTransform],
    stamp_ns: i64,
    output: impl Write + Seek,
) -> Result<(), WriteError> {
    let mut writer = McapWriter::new(output)?;
    let data = write_transforms(transforms, stamp_ns);
    writer.write(TF_STATIC, types::TRANSFORMS, stamp_ns, &data)?;
    writer.finish()
}

/// The path is not known here: whoever opened the output adds it.
fn unwritable(cause: io::Error) -> WriteError {
    WriteError::File { path: PathBuf::from("MCAP"), cause }
}

fn failed(error: McapError) -> WriteError {
    match error {
        McapError::Io(cause) => unwritable(cause),
        other => unwritable(io::Error::other(other)),
    }
}
