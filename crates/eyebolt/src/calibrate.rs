//! How far to trust an answer.

mod calibration;
mod deviation;
mod error;
mod exchanged;
mod jackknife;
mod judge;
mod limits;
mod one_kind;
mod reason;
mod still_part;
mod unknown_parts;
mod verdict;

pub use calibration::Calibration;
pub use deviation::Deviation;
pub use error::covariance_at;
pub(crate) use error::expected as expected_of;
pub(crate) use error::expected_at;
pub use error::{ErrorEstimate, ErrorPart, ErrorSource};
pub use jackknife::Jackknife;
pub use judge::calibrate;
pub use limits::Limits;
pub use reason::{Reason, Verdict};
pub use still_part::{Elsewhere, StillPart};
pub use unknown_parts::UnknownPart;
