//! Calibrations, and what is done with them.

use crate::arrays::Arrays;
use crate::error::raised;
use crate::work::{Call, run};
use eyebolt_cli::call::{self, Calibrated, Picture};
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::ffi::OsString;
use std::path::PathBuf;

/// A calibration with what it was made of.
#[pyclass(frozen, module = "eyebolt._native")]
pub struct Calibration {
    inner: Calibrated,
}

#[pymethods]
impl Calibration {
    /// What the program writes.
    fn json(&self) -> String {
        self.inner.json()
    }

    /// What to do about each reason of a refusal.
    fn remedies(&self) -> Vec<String> {
        self.inner.remedies()
    }

    /// A page for a browser, about the recording called `name`.
    fn report(&self, py: Python<'_>, name: &str, call: Call<'_>) -> PyResult<String> {
        run(py, &call, |front| self.inner.report(name, front.caller))
    }

    /// What viewers show, as MCAP, and a layout; `None` without a pose.
    fn viewer<'py>(
        &self,
        py: Python<'py>,
        call: Call<'py>,
    ) -> PyResult<Option<(Bound<'py, PyBytes>, String)>> {
        let made = run(py, &call, |front| self.inner.viewer(front.caller))?;
        Ok(made.map(|(bytes, layout)| (PyBytes::new(py, &bytes), layout)))
    }

    /// Every configuration with the posed arm over it: name of its first frame, `(rows, columns, 3)` uint8.
    fn overlays<'py>(
        &self,
        py: Python<'py>,
        call: Call<'py>,
    ) -> PyResult<Vec<(String, Bound<'py, PyArray3<u8>>)>> {
        let pictures = run(py, &call, |front| self.inner.overlays(front.caller))?;
        let array = |(name, picture): (String, Picture)| Ok((name, pixels(py, &picture)?));
        pictures.into_iter().map(array).collect()
    }
}

fn pixels<'py>(py: Python<'py>, picture: &Picture) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let size = [picture.height() as usize, picture.width() as usize, 3];
    PyArray1::from_slice(py, picture.rgb().as_flattened()).reshape(size)
}

/// Calibrates `arrays`, or the recording that `words` name.
#[pyfunction]
pub fn calibrate(
    py: Python<'_>,
    words: Vec<OsString>,
    arrays: Option<Arrays<'_>>,
    call: Call<'_>,
) -> PyResult<Calibration> {
    let frames = arrays.as_ref().map(|arrays| arrays.recording(py)).transpose()?;
    let inner = run(py, &call, |front| call::calibrate(words, frames, front.progress))?;
    Ok(Calibration { inner })
}

/// Refuses a text that is no calibration.
#[pyfunction]
pub fn check(py: Python<'_>, name: &str, text: &str) -> PyResult<()> {
    call::check(name, text).map_err(|error| raised(py, &error))
}

/// Writes a calibration where its verdict belongs; where that is.
#[pyfunction]
pub fn save(
    py: Python<'_>,
    path: PathBuf,
    text: &str,
    trusted: bool,
    force: bool,
) -> PyResult<PathBuf> {
    call::save(&path, text, trusted, force).map_err(|error| raised(py, &error))
}

/// Writes `bytes` to `path`, whole or not at all.
#[pyfunction]
pub fn write(py: Python<'_>, path: PathBuf, bytes: &[u8], force: bool) -> PyResult<()> {
    call::write(&path, bytes, force).map_err(|error| raised(py, &error))
}

/// A calibration in the form that `words` ask for.
#[pyfunction]
pub fn export<'py>(
    py: Python<'py>,
    words: Vec<OsString>,
    text: &str,
    name: &str,
    call: Call<'py>,
) -> PyResult<Bound<'py, PyBytes>> {
    let bytes = run(py, &call, |front| call::export(words, text, name, front.caller))?;
    Ok(PyBytes::new(py, &bytes))
}

/// How far off a calibration (name and text) is, or the tables of models: JSON.
#[pyfunction]
pub fn evaluate(
    py: Python<'_>,
    words: Vec<OsString>,
    calibration: Option<(String, String)>,
    call: Call<'_>,
) -> PyResult<String> {
    run(py, &call, |front| {
        let calibration = calibration.as_ref().map(|(name, text)| (name.as_str(), text.as_str()));
        call::evaluate(words, calibration, front.caller)
    })
}

/// Holds `arrays`, or the recording that `words` name, against a calibration (name and text): whether there is an alarm, and
/// what each view says as JSON.
#[pyfunction]
pub fn monitor(
    py: Python<'_>,
    words: Vec<OsString>,
    calibration: (String, String),
    arrays: Option<Arrays<'_>>,
    call: Call<'_>,
) -> PyResult<(bool, Vec<String>)> {
    let frames = arrays.as_ref().map(|arrays| arrays.recording(py)).transpose()?;
    run(py, &call, |front| {
        let mut views = Vec::new();
        let calibration = (calibration.0.as_str(), calibration.1.as_str());
        let telling = (front.caller, front.progress as &dyn call::Progress);
        let alarm =
            call::monitor(words, calibration, frames, telling, &mut |view| views.push(view))?;
        Ok((alarm, views))
    })
}
