//! What networks tell of single frames.

use crate::arrays::Arrays;
use crate::work::{Call, run};
use eyebolt_cli::call;
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use std::ffi::OsString;

/// Labels, as `(frames, rows, columns)` uint8; names of the frames that they are of; names of damaged ones.
type Segmented<'py> = (Bound<'py, PyArray3<u8>>, Vec<String>, Vec<String>);

/// Labels `arrays`, or the recording that `words` name.
#[pyfunction]
pub fn segment<'py>(
    py: Python<'py>,
    words: Vec<OsString>,
    arrays: Option<Arrays<'py>>,
    call: Call<'py>,
) -> PyResult<Segmented<'py>> {
    let frames = arrays.as_ref().map(|arrays| arrays.recording(py)).transpose()?;
    let (labels, [width, height], names, damaged) = run(py, &call, |front| {
        let (mut labels, mut size, mut names) = (Vec::new(), [0, 0], Vec::new());
        let damaged = call::segment(words, frames, front.progress, &mut |frame| {
            labels.extend(frame.label);
            size = frame.size;
            names.push(frame.name);
            Ok(())
        })?;
        Ok((labels, size, names, damaged))
    })?;
    let labels = PyArray1::from_vec(py, labels).reshape([names.len(), height, width])?;
    Ok((labels, names, damaged))
}

/// Where the end-effector is in each frame of `arrays`, or of the recording that `words` name: JSON.
#[pyfunction]
pub fn pose(
    py: Python<'_>,
    words: Vec<OsString>,
    arrays: Option<Arrays<'_>>,
    call: Call<'_>,
) -> PyResult<Vec<String>> {
    let frames = arrays.as_ref().map(|arrays| arrays.recording(py)).transpose()?;
    run(py, &call, |front| call::pose(words, frames, front.progress))
}
