//! `--viewer-mcap`: what viewers of robots' data show.

use crate::convert::refuse_source;
use crate::output::{self, Destination};
use anyhow::{Result, bail};
use eyebolt::answer::Answer;
use eyebolt::observations::Configuration;
use eyebolt::pipeline::Outcome;
use eyebolt::report::{Picture, Viewer};
use eyebolt_recording::Recording;
use std::io::{BufWriter, Cursor};
use std::path::{Path, PathBuf};

/// What a file for viewers is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct MadeOf<'a> {
    pub(super) recording: &'a Recording<'a>,
    pub(super) answer: &'a Answer,
    pub(super) outcome: &'a Outcome,
    pub(super) pictures: &'a [Picture],
}

/// Better told now than after the work: the file and its layout go where nothing else of this run does, nor `source` is.
pub(super) fn check(
    path: &Path,
    source: &Path,
    recording: &Recording<'_>,
    destination: &Destination,
    force: bool,
) -> Result<()> {
    if path.is_dir() {
        bail!("{}: --viewer-mcap: this is a folder. Name a file in it", path.display());
    }
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    if !ending.eq_ignore_ascii_case("mcap") {
        bail!("{}: --viewer-mcap: an MCAP. Name a file that ends in .mcap", path.display());
    }
    let layout = layout_path(path);
    if destination.is(&layout) {
        bail!(
            "{}: --viewer-mcap: the calibration goes there, and so would its layout. Name another file",
            layout.display()
        );
    }
    for file in [path, &layout] {
        output::refuse_existing(file, force)?;
    }
    refuse_source(path, source)?;
    let files = &recording.provenance().files;
    files.iter().try_for_each(|file| refuse_source(path, file))
}

/// Writes the file and its layout; what to say of them.
pub(super) fn save(path: &Path, made_of: &MadeOf<'_>, force: bool) -> Result<String> {
    let MadeOf { recording, answer, outcome, pictures } = *made_of;
    let Some(viewer) = Viewer::new(answer, outcome) else {
        return Ok(format!("\nno pose to show: {} was not written", path.display()));
    };
    let stamps_ns = stamps(recording, outcome);
    output::write_through(path, force, |file| {
        viewer
            .write(BufWriter::new(file), stamps_ns.as_deref(), pictures)
            .map_err(|error| output::named(error, path))
    })?;
    let layout = layout_path(path);
    output::write_whole(&layout, viewer.layout().as_bytes(), force)?;
    Ok(format!("\nfor viewers in {}, with the layout {}", path.display(), layout.display()))
}

/// The bytes of such a file and its layout; `None` without a pose.
pub(crate) fn bytes(
    answer: &Answer,
    outcome: &Outcome,
    stamps_ns: Option<Vec<i64>>,
    pictures: &[Picture],
) -> Result<Option<(Vec<u8>, String)>> {
    let Some(viewer) = Viewer::new(answer, outcome) else { return Ok(None) };
    let mut file = Cursor::new(Vec::new());
    viewer.write(&mut file, stamps_ns.as_deref(), pictures)?;
    Ok(Some((file.into_inner(), viewer.layout())))
}

fn layout_path(path: &Path) -> PathBuf {
    path.with_extension("layout.json")
}

/// When the first frame of each configuration was taken.
pub(super) fn stamps(recording: &Recording<'_>, outcome: &Outcome) -> Option<Vec<i64>> {
    let names = recording.frame_names();
    let stamp_ns = |configuration: &Configuration| {
        let first = configuration.frames.first()?;
        Some(recording.stamp_ns(names.iter().position(|name| name == first)?))
    };
    outcome.observations.as_ref()?.configurations.iter().map(stamp_ns).collect()
}
