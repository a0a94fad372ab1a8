//! Memory for what a file has, not for what it promises.

use std::io::{self, Read};

/// First memory that a buffer gets, bytes.
const FIRST_STEP: usize = 64 << 10;

/// Replaces what is in `buffer` by what `reader` gives, `most` bytes or up to its end.
///
/// The buffer grows with what comes: it never has twice the memory of that, nor more than `most`.
pub(super) fn read_up_to(
    reader: &mut impl Read,
    buffer: &mut Vec<u8>,
    most: u64,
) -> io::Result<()> {
    buffer.clear();
    loop {
        let left = most.saturating_sub(buffer.len() as u64);
        let step = left.min(buffer.len().max(FIRST_STEP) as u64);
        if step == 0 {
            return Ok(());
        }
        buffer.reserve_exact(usize::try_from(step).unwrap_or(0));
        let come = reader.by_ref().take(step).read_to_end(buffer)?;
        if (come as u64) < step {
            return Ok(());
        }
    }
}
