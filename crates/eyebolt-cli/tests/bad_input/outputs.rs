//! Outputs that are there already, or cannot be.

use crate::desk::{Desk, text};
use crate::folder::{GOOD, Recorded};
use crate::run::{calibration, eyebolt};
use std::fs;
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

/// Arguments of every command that writes, to `desk`.
fn commands<'a>(recording: &'a Path, saved: &'a Path, output: &'a Path) -> [Vec<&'a str>; 3] {
    let format = if output.extension().is_some() { "mcap" } else { "tf2" };
    let export = ["export", text(saved), "--as", format, "--output", text(output)];
    let convert = ["convert", text(recording), text(output)];
    [calibration(recording, output, &[]), convert.to_vec(), export.to_vec()]
}

#[test]
fn an_existing_file_without_force() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let saved = recorded.path().join("calibration.json");
    fs::write(&saved, &*GOOD).unwrap();
    let output = desk.file("out.mcap");
    fs::write(&output, "precious").unwrap();
    for arguments in commands(recorded.path(), &saved, &output) {
        eyebolt(&arguments).assert_error(&["out.mcap", "exists", "Give --force"]);
        assert_eq!(fs::read(&output).unwrap(), b"precious");
        assert_eq!(desk.names(), ["out.mcap"]);
    }
}

#[test]
fn an_existing_folder_without_force() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let output = desk.file("out");
    fs::create_dir(&output).unwrap();
    fs::write(output.join("recording.toml"), "precious").unwrap();
    let ended = eyebolt(&["convert", text(recorded.path()), text(&output)]);
    ended.assert_error(&["out", "exists", "Give --force"]);
    assert_eq!(fs::read(output.join("recording.toml")).unwrap(), b"precious");
    assert_eq!(desk.names(), ["out"]);
}

/// With `--force`, too: never somebody's home.
#[test]
fn an_existing_folder_that_is_no_recording() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let output = desk.file("out");
    fs::create_dir(&output).unwrap();
    fs::write(output.join("letter.txt"), "precious").unwrap();
    let ended = eyebolt(&["convert", text(recorded.path()), text(&output), "--force"]);
    ended.assert_error(&["out", "letter.txt", "Name another place"]);
    assert_eq!(fs::read(output.join("letter.txt")).unwrap(), b"precious");
}

#[test]
fn the_recording_itself() {
    let recorded = Recorded::two();
    let before = recorded.read("recording.toml");
    let ended = eyebolt(&["convert", text(recorded.path()), text(recorded.path()), "--force"]);
    ended.assert_error(&[text(recorded.path()), "the recording itself", "another place"]);
    assert_eq!(recorded.read("recording.toml"), before);
}

#[test]
fn a_read_only_folder() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let saved = recorded.path().join("calibration.json");
    fs::write(&saved, &*GOOD).unwrap();
    let folder = desk.file("locked");
    fs::create_dir(&folder).unwrap();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(folder.join("probe"), "").is_ok() {
        // The harness would keep back what `eprintln!` says of a test that passes.
        let _ = writeln!(std::io::stderr(), "SKIPPED: no folder is read-only to this user");
        return;
    }
    for name in ["out.mcap", "out"] {
        for arguments in commands(recorded.path(), &saved, &folder.join(name)) {
            eyebolt(&arguments).assert_error(&["locked", "cannot write", "ermission"]);
            assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
        }
    }
}

#[test]
fn a_saved_calibration_that_is_cut_short() {
    let desk = Desk::new();
    let (saved, output) = (desk.file("calibration.json"), desk.file("tf.txt"));
    // Between two lines: in a number it would be called a bad one.
    let end = GOOD[..GOOD.len() / 2].rfind('\n').unwrap();
    fs::write(&saved, &GOOD[..end]).unwrap();
    fs::write(&output, "precious").unwrap();
    let arguments = ["export", text(&saved), "--as", "tf2", "--output", text(&output), "--force"];
    eyebolt(&arguments).assert_error(&["calibration.json: line", "EOF", "Export the file as"]);
    assert_eq!(fs::read(&output).unwrap(), b"precious");
    assert_eq!(desk.names(), ["calibration.json", "tf.txt"]);
}

/// Told before anybody is listened to.
#[test]
fn a_page_that_cannot_be_served_and_a_report_that_is_there() {
    let desk = Desk::new();
    let output = desk.file("calibration.json");
    let live = ["live", "--localhost-only", "--output", text(&output)];
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let ended = eyebolt(&[&live[..], &["--web", &address]].concat());
    ended.assert_error(&["--web", &address, "in use", "Give another address or port"]);
    assert_eq!(desk.names(), [""; 0]);

    fs::write(desk.file("calibration.html"), "precious").unwrap();
    let ended = eyebolt(&[&live[..], &["--web", "127.0.0.1:0"]].concat());
    ended.assert_error(&["calibration.html", "exists", "Give --force"]);
    assert_eq!(desk.names(), ["calibration.html"]);
}
