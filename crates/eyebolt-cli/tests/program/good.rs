//! A run that goes well, looked at by many tests.

use crate::desk::{Desk, text};
use crate::program::Ended;
use serde_json::Value;
use std::fs;
use std::sync::LazyLock;

/// A trusted run with pictures and a page, on one thread.
pub struct Good {
    pub desk: Desk,
    pub ended: Ended,
    pub json: String,
}

pub static GOOD: LazyLock<Good> = LazyLock::new(|| {
    let desk = Desk::shared("program-good");
    let pictures = desk.file("pictures");
    let report = desk.file("report.html");
    let ended = desk.calibrate(&[
        "--threads",
        "1",
        "--save-overlay",
        text(&pictures),
        "--report",
        text(&report),
    ]);
    let json = fs::read_to_string(desk.file("calibration.json")).unwrap_or_default();
    Good { desk, ended, json }
});

/// Its file.
pub fn parsed() -> Value {
    serde_json::from_str(&GOOD.json).unwrap()
}
