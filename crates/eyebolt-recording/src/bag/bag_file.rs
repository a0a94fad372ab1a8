//! What every kind of file of messages can do.

use super::message::{Location, Message};
use crate::error::RecordingError;
use std::collections::BTreeMap;

/// A file of messages.
///
/// Reading is by streaming: memory holds one chunk (or message) at a time, however long the file.
pub(crate) trait BagFile: std::fmt::Debug + Send + Sync {
    /// Hands every message to `each`, in the order of the file; an error of `each` ends the scan.
    ///
    /// `damage` is asked what to do about a part that cannot be read: the error that it returns
    /// ends the scan; `Ok` goes on behind that part (at the end of the file, the scan is over).
    fn scan(
        &self,
        each: &mut dyn FnMut(&Message<'_>) -> Result<(), RecordingError>,
        damage: &mut dyn FnMut(RecordingError) -> Result<(), RecordingError>,
    ) -> Result<(), RecordingError>;

    /// The metadata record called `name`, in files of a kind that has such.
    fn metadata(&self, _name: &str) -> Result<Option<BTreeMap<String, String>>, RecordingError> {
        Ok(None)
    }

    /// The bytes of the message at `place`, which a scan of this file told.
    fn read(&self, place: Location) -> Result<Vec<u8>, RecordingError>;
}

/// No message, and no chunk of messages, is larger than this when decompressed, bytes: a cloud of
/// 4K with 32 bytes a point. A reader may have three of them in memory: a chunk, a message out of
/// it, and what that becomes.
pub(crate) const LARGEST_CHUNK: u64 = 256 << 20;
