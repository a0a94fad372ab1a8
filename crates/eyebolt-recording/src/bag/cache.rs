//! The chunk decompressed last, for readers of one message after the other.

use std::sync::{Arc, Mutex, PoisonError};

/// Larger chunks are not kept from one message to the next, bytes.
const LARGEST_KEPT: usize = 64 << 20;

/// One decompressed chunk, by its offset in the file.
#[derive(Debug, Default)]
pub(crate) struct ChunkCache(Mutex<Option<(u64, Arc<Vec<u8>>)>>);

impl ChunkCache {
    /// The chunk at `offset`, from memory or from `unpack`.
    pub(crate) fn get<E>(
        &self,
        offset: u64,
        unpack: impl FnOnce() -> Result<Vec<u8>, E>,
    ) -> Result<Arc<Vec<u8>>, E> {
        // What is in it is whole, whatever became of the thread that put it there.
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, records)) = lock().as_ref().filter(|(known, _)| *known == offset) {
            return Ok(Arc::clone(records));
        }
        // Not under the lock: other threads want other chunks.
        let records = Arc::new(unpack()?);
        if records.len() > LARGEST_KEPT {
            return Ok(records);
        }
        *lock() = Some((offset, Arc::clone(&records)));
        Ok(records)
    }
}
