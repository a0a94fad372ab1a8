//! How far the writing is.

use super::error::WriteError;
use std::ops::ControlFlow;

/// Hears how many of how many messages or frames are done; [`ControlFlow::Break`] ends the work.
pub type WriteProgress<'a> = dyn FnMut(usize, usize) -> ControlFlow<()> + 'a;

/// Tells `progress`, or stops.
pub(super) fn tell(
    progress: &mut WriteProgress<'_>,
    done: usize,
    total: usize,
) -> Result<(), WriteError> {
    match progress(done, total) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(WriteError::Stopped),
    }
}
