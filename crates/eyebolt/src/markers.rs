//! Calibration by a marker in the colour pictures, for those who have one: on the hand of an arm before a
//! camera that stands still, or standing still before a camera on the hand.
//!
//! [`observe`] reads the pictures, [`calibrate`] solves and judges, and where depth was recorded too,
//! [`follow`] goes on from the marker's answer with the arm's own shape.

mod arrangement;
mod calibrate;
mod error;
mod follow;
mod observe;
mod reason;
mod request;
mod seen;

pub use arrangement::{Arrangement, EyeInHand, EyeToHand};
pub use calibrate::{MarkerCalibration, MarkerOutcome, calibrate};
pub use error::{MarkerErrorEstimate, MarkerErrorPart};
pub use follow::{FromMarker, difference, follow};
pub use observe::{MarkerConfiguration, MarkerObservations, observe};
pub use reason::{DroppedView, MarkerReason};
pub use request::{MarkerFailure, MarkerRequest};
