//! Files that are there, and folders that are not.

use crate::desk::{Desk, text};
use crate::program::calibrate;
use std::fs;
use std::io::Write;
use std::path::Path;

/// A recording that does not exist: who complains of something else has not looked for it yet.
const NOWHERE: &str = "no/such/recording";

#[test]
fn an_existing_calibration_stays_and_no_work_is_done() {
    for name in ["calibration.json", "calibration.rejected.json"] {
        let desk = Desk::new();
        fs::write(desk.file(name), "precious").unwrap();
        let ended = calibrate(Path::new(NOWHERE), &desk.file("calibration.json"), &[]);
        ended.assert_error(1, &[name, "exists", "--force"]);
        assert!(!ended.err.contains(NOWHERE), "{}", ended.err);
        assert_eq!(fs::read(desk.file(name)).unwrap(), b"precious");
        assert_eq!(desk.names(), [name]);
    }
}

#[test]
fn existing_pictures_stay_and_no_work_is_done() {
    let desk = Desk::new();
    let picture = desk.file("overlay_3.png");
    fs::write(&picture, "precious").unwrap();
    let ended = desk.calibrate(&["--save-overlay", text(desk.path())]);
    ended.assert_error(1, &["overlay_3.png", "exists", "--force"]);
    assert_eq!(fs::read(&picture).unwrap(), b"precious");
    assert_eq!(desk.names(), ["overlay_3.png"]);
}

#[test]
fn pictures_need_a_folder() {
    let desk = Desk::new();
    fs::write(desk.file("pictures"), "a file").unwrap();
    let ended = desk.calibrate(&["--save-overlay", text(&desk.file("pictures")), "--force"]);
    ended.assert_error(1, &["pictures", "--save-overlay", "folder"]);
    assert_eq!(desk.names(), ["pictures"]);
}

#[test]
fn an_existing_page_stays_and_no_work_is_done() {
    let desk = Desk::new();
    let page = desk.file("report.html");
    fs::write(&page, "precious").unwrap();
    let ended = desk.calibrate(&["--report", text(&page)]);
    ended.assert_error(1, &["report.html", "exists", "--force"]);
    assert_eq!(fs::read(&page).unwrap(), b"precious");
    assert_eq!(desk.names(), ["report.html"]);
}

#[test]
fn a_page_needs_a_file_of_its_own() {
    let desk = Desk::new();
    let calibration = desk.file("calibration.json");
    let rejected = desk.file("calibration.rejected.json");
    for (path, word) in
        [(desk.path(), "folder"), (&calibration, "goes there"), (&rejected, "goes there")]
    {
        let ended = desk.calibrate(&["--report", text(path), "--force"]);
        ended.assert_error(1, &["--report", word]);
    }
    assert!(desk.names().is_empty());
}

#[test]
fn a_refusal_has_a_page_too_and_force_replaces_one() {
    let desk = Desk::new();
    let page = desk.file("report.html");
    fs::write(&page, "old").unwrap();
    let ended = desk.calibrate_stranger(&["--report", text(&page), "--force"]);
    assert_eq!(ended.code, Some(3), "{}", ended.err);
    let text = fs::read_to_string(&page).unwrap();
    assert!(text.contains("Refused") && text.contains("no pose was found"));
    assert_eq!(desk.names(), ["calibration.rejected.json", "report.html"]);
}

#[test]
fn a_refusal_never_replaces_a_calibration() {
    let desk = Desk::new();
    fs::write(desk.file("calibration.json"), "good").unwrap();
    fs::write(desk.file("calibration.rejected.json"), "old").unwrap();
    assert_eq!(desk.calibrate_stranger(&["--force"]).code, Some(3));
    assert_eq!(fs::read(desk.file("calibration.json")).unwrap(), b"good");
    let rejected = fs::read_to_string(desk.file("calibration.rejected.json")).unwrap();
    assert!(rejected.contains("\"refused\""), "{rejected}");
    assert_eq!(desk.names(), ["calibration.json", "calibration.rejected.json"]);
}

#[test]
fn a_calibration_clears_away_the_refusal_that_it_replaces() {
    let desk = Desk::new();
    fs::write(desk.file("calibration.rejected.json"), "old").unwrap();
    assert_eq!(desk.calibrate(&["--force"]).code, Some(0));
    assert_eq!(desk.names(), ["calibration.json"]);
}

#[test]
fn the_output_needs_a_folder() {
    let desk = Desk::new();
    let ended = calibrate(Path::new(NOWHERE), &desk.file("missing/calibration.json"), &[]);
    ended.assert_error(1, &["missing", "--output", "no such folder"]);
    assert!(desk.names().is_empty());
}

#[test]
fn the_output_is_no_folder() {
    let desk = Desk::new();
    fs::create_dir(desk.file("calibration.json")).unwrap();
    let ended = calibrate(Path::new(NOWHERE), &desk.file("calibration.json"), &["--force"]);
    ended.assert_error(1, &["calibration.json", "--output", "folder"]);
}

#[cfg(unix)]
#[test]
fn the_outputs_folder_must_be_writable() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    let folder = desk.file("locked");
    fs::create_dir(&folder).unwrap();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(folder.join("probe"), "").is_ok() {
        // The harness would keep back what `eprintln!` says of a test that passes.
        let _ = writeln!(std::io::stderr(), "SKIPPED: no folder is read-only to this user");
        return;
    }
    let ended = calibrate(Path::new(NOWHERE), &folder.join("calibration.json"), &[]);
    ended.assert_error(1, &["locked", "--output", "cannot write"]);
}
