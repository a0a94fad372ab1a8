//! Data sets and networks.

use crate::work::{Call, run};
use eyebolt_cli::call;
use pyo3::prelude::*;
use std::ffi::OsString;

/// Labels the recordings that `words` name, by a calibration (name and text) if one is given; what became of each, as JSON.
#[pyfunction]
pub fn label(
    py: Python<'_>,
    words: Vec<OsString>,
    calibration: Option<(String, String)>,
    call: Call<'_>,
) -> PyResult<Vec<String>> {
    run(py, &call, |front| call::label(words, calibration, front.caller))
}

/// Teaches the networks that `words` ask for; names of their folders.
#[pyfunction]
pub fn train(py: Python<'_>, words: Vec<OsString>, call: Call<'_>) -> PyResult<Vec<&'static str>> {
    run(py, &call, |front| call::train(words, front.caller))
}
