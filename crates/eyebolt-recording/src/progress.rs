//! How far long work is, and how it is ended.

/// Whoever heard of the progress of some work ended it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

/// Hears how far long work is, and may end it.
///
/// Work asks after each of its parts: a message or a frame that is written, a stage or a hypothesis of a
/// calibration. It leaves nothing half done.
pub trait Progress {
    /// A stage of this name begins; the one before it is over.
    ///
    /// # Errors
    ///
    /// The work is to end.
    fn begin(&self, stage: &'static str) -> Result<(), Cancelled>;

    /// So many of `total` parts of the stage are done.
    ///
    /// # Errors
    ///
    /// The work is to end.
    fn advance(&self, done: usize, total: usize) -> Result<(), Cancelled>;
}

/// Hears nothing, and ends nothing.
impl Progress for () {
    fn begin(&self, _: &'static str) -> Result<(), Cancelled> {
        Ok(())
    }

    fn advance(&self, _: usize, _: usize) -> Result<(), Cancelled> {
        Ok(())
    }
}
