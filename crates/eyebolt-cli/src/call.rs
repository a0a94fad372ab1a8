//! The commands as functions, for front ends that are no terminal, such as Python.
//!
//! Options are the words of the command's flags (`--seed=7`), so that they mean what they mean to the program and have the
//! same defaults; whatever has no flag, such as frames in memory, is handed in beside them. Nothing is printed, and nothing
//! written but what the function is for. Errors call flags by their name in snake case: `max_error_mm`.

mod calibrate;
mod calibration;
mod caller;
mod error;
mod frames;
mod keywords;
mod learn;
mod options;
mod simulate;

pub use calibrate::{Calibrated, calibrate};
pub use calibration::{check, evaluate, export, monitor, save, write};
pub use caller::Caller;
pub use error::CallError;
pub use frames::{LabelledFrame, pose, segment};
pub use keywords::keywords;
pub use learn::{label, train};
pub use options::{CallOption, options};
pub use simulate::{Simulated, record_simulation, robots, simulate};

pub use eyebolt::progress::{Cancelled, Progress};
pub use eyebolt::report::Picture;
