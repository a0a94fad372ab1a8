//! What only a simulation knows of a recording: where the camera really was.
//!
//! For whoever judges a calibration, and for nobody else: it lies in a record of its own, which the
//! readers of recordings never look at, so that no answer can lean on it.

mod find;
mod parse;
mod written;

pub use find::read_truth;
pub(crate) use find::{FILE, text_of};
pub use written::{CameraMoved, Truth};
pub(crate) use written::{RECORD, record};
