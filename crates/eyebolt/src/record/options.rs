//! What to read of a recording.

/// What to read of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordOptions {
    /// Whether to use the masks of the recording.
    pub use_masks: bool,
    /// Of more configurations, those are used that differ most: accuracy hardly grows any more with
    /// their number, and time does.
    pub most_configurations: usize,
}

impl Default for RecordOptions {
    fn default() -> Self {
        Self { use_masks: true, most_configurations: 30 }
    }
}

/// Configurations that are told apart; an arm in more places never rests.
pub(crate) const MOST_CONFIGURATIONS: usize = 2000;
