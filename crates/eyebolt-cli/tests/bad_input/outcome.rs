//! What has to become of a bad input: an error or a refusal, and no other change in the world.

use crate::desk::{Desk, text};
use crate::run::{Ended, calibration, eyebolt};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// What lay where the output goes.
const PRECIOUS: &[u8] = b"precious";

impl Ended {
    /// Checks that it ended with an error of one line that has all of `words`.
    #[track_caller]
    pub fn assert_error(&self, words: &[&str]) {
        let Self { code, out, err } = self;
        assert_eq!(*code, Some(1), "out: {out}\nerr: {err}");
        assert!(err.starts_with("error: ") && err.lines().count() == 1, "{err}");
        assert!(!err.contains("panicked"), "{err}");
        for word in words {
            assert!(err.contains(word), "no {word:?} in: {err}");
        }
    }
}

/// Neither `calibrate`, `info` nor `convert` can use `recording`; all say `words`.
#[track_caller]
pub fn assert_unusable(recording: &Path, words: &[&str]) {
    assert_unusable_with(recording, &[], words);
}

/// As [`assert_unusable`], with `more` arguments.
#[track_caller]
pub fn assert_unusable_with(recording: &Path, more: &[&str], words: &[&str]) {
    assert_not_calibrated(recording, more, words);
    eyebolt(&[&["info", text(recording)], more].concat()).assert_error(words);
    let desk = Desk::new();
    let (file, folder) = (desk.file("out.mcap"), desk.file("out"));
    fs::write(&file, PRECIOUS).unwrap();
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("recording.toml"), PRECIOUS).unwrap();
    for output in [&file, &folder] {
        let arguments = ["convert", text(recording), text(output), "--force"];
        eyebolt(&[&arguments, more].concat()).assert_error(words);
        assert_eq!(desk.names(), ["out", "out.mcap"]);
        assert_eq!(fs::read(&file).unwrap(), PRECIOUS);
        assert_eq!(fs::read(folder.join("recording.toml")).unwrap(), PRECIOUS);
    }
}

/// `calibrate` cannot use `recording` and says `words`.
#[track_caller]
pub fn assert_not_calibrated(recording: &Path, more: &[&str], words: &[&str]) {
    let desk = Desk::new();
    let output = desk.file("calibration.json");
    fs::write(&output, PRECIOUS).unwrap();
    let ended = eyebolt(&calibration(recording, &output, &[&["--force"], more].concat()));
    ended.assert_error(words);
    assert_eq!(desk.names(), ["calibration.json"]);
    assert_eq!(fs::read(&output).unwrap(), PRECIOUS);
}

/// `calibrate` refuses `recording`; a reason has all of `words`.
#[track_caller]
pub fn assert_refused(recording: &Path, words: &[&str]) {
    let desk = Desk::new();
    let output = desk.file("calibration.json");
    fs::write(&output, PRECIOUS).unwrap();
    let ended = eyebolt(&calibration(recording, &output, &["--force"]));
    assert_eq!((ended.code, ended.err.as_str()), (Some(3), ""), "{}", ended.out);
    assert_eq!(desk.names(), ["calibration.json", "calibration.rejected.json"]);
    assert_eq!(fs::read(&output).unwrap(), PRECIOUS);
    let rejected = fs::read(desk.file("calibration.rejected.json")).unwrap();
    let rejected: Value = serde_json::from_slice(&rejected).unwrap();
    let reasons = rejected["reasons"].as_array().unwrap();
    let has_all = |reason: &Value| words.iter().all(|w| reason.as_str().unwrap().contains(w));
    assert!(reasons.iter().any(has_all), "no reason with {words:?}: {reasons:?}");
    assert!(ended.out.contains(words[0]), "{}", ended.out);
}

/// The calibration that `calibrate` makes of `recording` and trusts.
#[track_caller]
pub fn trusted(recording: &Path) -> String {
    let desk = Desk::new();
    let output = desk.file("calibration.json");
    let ended = eyebolt(&calibration(recording, &output, &[]));
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    fs::read_to_string(output).unwrap()
}
