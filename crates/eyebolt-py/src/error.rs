//! Errors as the one exception that the package has.

use eyebolt_cli::call::CallError;
use pyo3::PyTypeInfo;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;

/// `eyebolt.Error` with the parts of `error`.
pub fn raised(py: Python<'_>, error: &CallError) -> PyErr {
    let made = || {
        let class = py.import("eyebolt._errors")?.getattr("Error")?;
        class.call1((&error.text, &error.file, &error.field, &error.remedy))
    };
    made().map_or_else(|failed| failed, PyErr::from_value)
}

/// Says each of `notes` as a warning of whoever called the package.
pub fn warn(py: Python<'_>, notes: &[String]) -> PyResult<()> {
    /// Above this module: the package, and its caller.
    const CALLER: i32 = 2;
    notes.iter().try_for_each(|note| {
        let note = CString::new(note.replace('\0', " "))?;
        PyErr::warn(py, &PyUserWarning::type_object(py), &note, CALLER)
    })
}
