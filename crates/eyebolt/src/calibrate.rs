//! Many configurations into one calibration, and how far to trust it.

mod agreement;

pub use agreement::{Agreement, agreement};
