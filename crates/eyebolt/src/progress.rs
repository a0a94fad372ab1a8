//! What long work says of itself while it runs, and how it is ended.

pub use eyebolt_recording::{Cancelled, Progress};

/// A step of a calibration, in the order they are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Reading frames, the robot and its shapes.
    Record,
    /// Telling the arm's pixels from the rest.
    Label,
    /// Searching for a pose from nothing.
    Pose,
    /// Refining the pose.
    Refine,
    /// Leaving configurations out and weighing the evidence.
    Calibrate,
    /// Writing the answer and the pictures.
    Report,
}

impl Step {
    /// All steps.
    pub const ALL: [Self; 6] =
        [Self::Record, Self::Label, Self::Pose, Self::Refine, Self::Calibrate, Self::Report];

    /// The step's name, as in `timing_ms`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Record => "record",
            Self::Label => "label",
            Self::Pose => "pose",
            Self::Refine => "refine",
            Self::Calibrate => "calibrate",
            Self::Report => "report",
        }
    }

    /// Tells `progress` that the step begins.
    ///
    /// # Errors
    ///
    /// Cancelled.
    pub fn begin(self, progress: &dyn Progress) -> Result<(), Cancelled> {
        progress.begin(self.name())
    }
}
