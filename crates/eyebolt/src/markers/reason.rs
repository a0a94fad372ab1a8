//! Why an answer by a marker is refused, and why a configuration took no part.

use eyebolt_markers::NotSeen;
use eyebolt_markers::hand_eye::HandEyeError;

/// Why an answer is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MarkerReason {
    /// Too few configurations show the marker.
    #[error(
        "the marker is seen in {seen} of {configurations} configurations, and {needed} are needed: check \
         dictionary and number of the marker, and that it is whole in the picture with a white margin"
    )]
    FewViews {
        /// Configurations that show it.
        seen: usize,
        /// Configurations looked at.
        configurations: usize,
        /// How many are needed.
        needed: usize,
    },
    /// The poses leave the camera's place open.
    #[error("{0}")]
    Open(HandEyeError),
    /// The unknowns could not be refined.
    #[error("what the pictures show does not determine the camera's place: turn the hand more")]
    Underdetermined,
    /// The refinement did not settle.
    #[error(
        "the refinement was still moving when it was stopped: the marker or the joints are not this robot's"
    )]
    NotSettled,
    /// Too many configurations do not fit.
    #[error(
        "in {off} of {seen} configurations the marker is not where the robot would have it: check that it is \
         fixed, that joints and description are this robot's, and eye-to-hand or eye-in-hand"
    )]
    Outliers {
        /// Configurations that do not fit.
        off: usize,
        /// Configurations that show the marker.
        seen: usize,
    },
    /// What is seen is far from what is expected everywhere.
    #[error(
        "points of the marker are seen {rms_px:.1} px from where they should be (at most {limit_px:.1} are \
         trusted): check that it is fixed and flat, the intrinsics, and that the arm rested"
    )]
    Residual {
        /// Standard deviation of a coordinate, pixels.
        rms_px: f64,
        /// Allowed, pixels.
        limit_px: f64,
    },
    /// The marker is of another size than said.
    #[error(
        "the marker seems to be {percent:+.1} % larger than said (at most {limit:.0} % are trusted): measure \
         the side of its black square"
    )]
    Size {
        /// How much larger, percent.
        percent: f64,
        /// Allowed, either way, percent.
        limit: f64,
    },
    /// The expected error is too large.
    #[error(
        "the expected error is {translation_mm:.1} mm and {rotation_deg:.2} degrees, more than the \
         {limit_mm:.1} mm and {limit_deg:.2} degrees allowed: record more configurations, nearer to the \
         camera and turned more, or a larger marker"
    )]
    Inaccurate {
        /// Expected error, millimetres.
        translation_mm: f64,
        /// Expected error, degrees.
        rotation_deg: f64,
        /// Allowed, millimetres.
        limit_mm: f64,
        /// Allowed, degrees.
        limit_deg: f64,
    },
}

/// Why a configuration took no part.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DroppedView {
    /// It does not show the marker.
    #[error("{0}")]
    NotSeen(NotSeen),
    /// What it shows makes no pose.
    #[error("what is seen of the marker makes no pose")]
    NoPose,
    /// It does not fit the others.
    #[error("the marker is {rms_px:.1} px from where the others have it")]
    Off {
        /// Root mean square distance, pixels.
        rms_px: f64,
    },
}
