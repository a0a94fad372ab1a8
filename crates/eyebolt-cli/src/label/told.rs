//! What is said of a recording that was labelled, or was not.

use eyebolt::dataset::{Filled, IndexLine, PixelCounts};
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// How the labelling of a recording ended.
pub enum Told {
    Labelled(Labelled),
    /// Why its calibration is not to be trusted.
    Refused(Vec<String>),
}

/// What became of the frames of a recording.
pub struct Labelled {
    recording: String,
    labelled: usize,
    known: usize,
    left_out: BTreeMap<String, usize>,
    pixels: PixelCounts,
}

impl Labelled {
    pub fn new(recording: &Path, filled: &Filled) -> Self {
        let mut pixels = PixelCounts::default();
        let files = filled.lines.iter().filter_map(|line| line.labelled.as_ref());
        for counts in files.clone().map(|file| file.pixels) {
            pixels.background += counts.background;
            pixels.arm += counts.arm;
            pixels.end_effector += counts.end_effector;
            pixels.ignore += counts.ignore;
            pixels.no_depth += counts.no_depth;
        }
        let mut left_out = BTreeMap::new();
        for reason in filled.lines.iter().filter_map(|IndexLine { left_out, .. }| left_out.clone())
        {
            *left_out.entry(reason).or_default() += 1;
        }
        let recording = recording.display().to_string();
        Self { recording, labelled: files.count(), known: filled.known, left_out, pixels }
    }

    /// For a person.
    pub fn text(&self) -> String {
        let Self { recording, labelled, known, left_out, pixels } = self;
        let mut text = format!("{recording}: {labelled} frames labelled");
        if *known > 0 {
            let _ = write!(text, ", {known} of all frames were there before");
        }
        let seen = pixels.background + pixels.arm + pixels.end_effector + pixels.ignore;
        let percent = |count: usize| 100.0 * count as f64 / seen.max(1) as f64;
        let _ = write!(
            text,
            "\n  pixels with depth: {:.1} % background, {:.1} % arm, {:.1} % end-effector, {:.1} % \
             ignored",
            percent(pixels.background),
            percent(pixels.arm),
            percent(pixels.end_effector),
            percent(pixels.ignore)
        );
        for (reason, count) in left_out {
            let _ = write!(text, "\n  {count} frames left out: {reason}");
        }
        text
    }

    /// For a program.
    pub fn json(&self) -> String {
        let Self { recording, labelled, known, left_out, pixels } = self;
        json!({
            "recording": recording,
            "labelled": labelled,
            "known": known,
            "left_out": left_out,
            "pixels": pixels,
        })
        .to_string()
    }
}

/// Why a recording was not labelled.
pub fn refused(recording: &Path, reasons: &[String]) -> String {
    let mut text = format!(
        "{}: not labelled, since its calibration is not to be trusted. Remove the cause, or give one \
         that is with --calibration",
        recording.display()
    );
    for reason in reasons {
        let _ = write!(text, "\n  {reason}");
    }
    text
}
