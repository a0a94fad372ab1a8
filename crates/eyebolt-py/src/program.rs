//! The program, and what it knows.

use eyebolt_cli::call;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::ffi::OsString;

/// Runs the program on `words`, the first of which is its name; its exit status. Ctrl-C, standard output and standard error
/// are left to it. `started_by` are the words that start it anew.
#[pyfunction]
pub fn program(py: Python<'_>, started_by: Vec<OsString>, words: Vec<OsString>) -> u8 {
    py.detach(|| eyebolt_cli::program(&started_by, words))
}

/// Options of the command called `command`: whether each has a value, whether it may be repeated, and what it is if it is
/// not told.
#[pyfunction]
pub fn options(command: &str) -> BTreeMap<String, (bool, bool, Option<String>)> {
    let known = call::options(command).into_iter();
    known.map(|it| (it.name, (it.takes_value, it.repeats, it.default))).collect()
}

/// Name and description of each robot that comes with the program.
#[pyfunction]
pub fn robots() -> BTreeMap<&'static str, String> {
    call::robots()
}

/// The version.
#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}
