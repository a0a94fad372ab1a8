//! A simulated recording, written.

use crate::output;
use crate::progress::Counting;
use anyhow::Result;
use eyebolt::progress::Progress;
use eyebolt::simulate::{Plan, SimulateError};
use std::io::BufWriter;
use std::path::Path;

/// Writes the recording of `plan` to `path`, whole or not at all.
pub fn record(plan: &Plan<'_>, path: &Path, force: bool) -> Result<()> {
    record_telling(plan, path, force, &Counting::new()?)
}

/// As [`record`], telling `progress` of it.
pub fn record_telling(
    plan: &Plan<'_>,
    path: &Path,
    force: bool,
    progress: &dyn Progress,
) -> Result<()> {
    output::write_through(path, force, |file| {
        plan.record(BufWriter::new(file), progress).map_err(|error| match error {
            SimulateError::Write(error) => output::named(error, path),
            other => other.into(),
        })
    })
}
