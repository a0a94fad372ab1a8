//! The native half of the Python package: arrays in, answers out. What people call is in `python/eyebolt`.
//!
//! Options come as the words of the program's flags, so that there is one list of them; results go as the JSON that the
//! program writes, which tells every number to the last bit, and as arrays.

mod arrays;
mod calibration;
mod error;
mod learn;
mod listener;
mod per_frame;
mod pools;
mod program;
mod simulation;
mod work;

/// The module, as Python knows it.
#[pyo3::pymodule(name = "_native")]
mod native {
    #[pymodule_export]
    use super::calibration::{
        Calibration, calibrate, check, evaluate, export, monitor, save, write,
    };
    #[pymodule_export]
    use super::learn::{label, train};
    #[pymodule_export]
    use super::per_frame::{pose, segment};
    #[pymodule_export]
    use super::program::{options, program, robots, version};
    #[pymodule_export]
    use super::simulation::{record_simulation, simulate};
}
