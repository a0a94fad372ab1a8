//! Disks that are full before the output is whole.

use crate::desk::{Desk, text};
use crate::folder::{GOOD, Recorded};
use crate::run::{Ended, calibration, command, end, start};
use std::fs::{self, File};
use std::io::Write;
use std::process::Command;

/// No file may become larger than 512 bytes (1 KiB with some shells), as if the disk were full by
/// then; whoever tries is told so instead of being killed.
const TINY_FILES: &str = "trap '' XFSZ; ulimit -f 1;";

/// Runs the program with these arguments while files cannot grow.
fn on_full_disk(arguments: &[&str]) -> Ended {
    end(start(&mut command(TINY_FILES, arguments)))
}

/// A desk with a file and a recording that nobody wants to lose.
fn precious() -> Desk {
    let desk = Desk::new();
    fs::write(desk.file("out.mcap"), "precious").unwrap();
    fs::create_dir(desk.file("out")).unwrap();
    fs::write(desk.file("out/recording.toml"), "precious").unwrap();
    desk
}

#[track_caller]
fn assert_unchanged(desk: &Desk) {
    assert_eq!(desk.names(), ["out", "out.mcap"]);
    assert_eq!(fs::read(desk.file("out.mcap")).unwrap(), b"precious");
    assert_eq!(fs::read(desk.file("out/recording.toml")).unwrap(), b"precious");
    assert_eq!(fs::read_dir(desk.file("out")).unwrap().count(), 1);
}

#[test]
fn a_calibration_that_does_not_fit() {
    let (desk, recorded) = (precious(), Recorded::all());
    let output = desk.file("out.json");
    fs::rename(desk.file("out.mcap"), &output).unwrap();
    let ended = on_full_disk(&calibration(recorded.path(), &output, &["--force"]));
    ended.assert_error(&["out.json", "cannot write", "Make room there"]);
    fs::rename(&output, desk.file("out.mcap")).unwrap();
    assert_unchanged(&desk);
}

#[test]
fn an_export_that_does_not_fit() {
    let (desk, saved) = (precious(), Desk::new());
    let calibration = saved.file("calibration.json");
    fs::write(&calibration, &*GOOD).unwrap();
    let output = desk.file("out.mcap");
    let ended = on_full_disk(&[
        "export",
        text(&calibration),
        "--as",
        "mcap",
        "--output",
        text(&output),
        "--force",
    ]);
    ended.assert_error(&["out.mcap", "cannot write", "Make room there"]);
    assert_unchanged(&desk);
}

#[test]
fn a_converted_recording_that_does_not_fit() {
    let (desk, recorded) = (precious(), Recorded::two());
    for name in ["out.mcap", "out"] {
        let output = desk.file(name);
        let ended = on_full_disk(&["convert", text(recorded.path()), text(&output), "--force"]);
        ended.assert_error(&[text(&output), "cannot write", "Make room there"]);
        assert_unchanged(&desk);
    }
}

#[test]
fn standard_output_that_is_full() {
    let Ok(full) = File::options().write(true).open("/dev/full") else {
        let _ = writeln!(std::io::stderr(), "SKIPPED: there is no /dev/full");
        return;
    };
    let desk = Desk::new();
    let saved = desk.file("calibration.json");
    fs::write(&saved, &*GOOD).unwrap();
    let mut export = command("", &["export", text(&saved), "--as", "tf2"]);
    let output = export.stdout(full).output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    let ended = Ended { code: output.status.code(), out: String::new(), err };
    ended.assert_error(&["standard output", "cannot write", "Make room"]);
}

/// A file system of its own, of 64 KiB, that only the program and its shell see.
#[test]
fn a_file_system_that_is_too_small() {
    let (desk, recorded) = (Desk::new(), Recorded::two());
    let small = desk.file("small");
    fs::create_dir(&small).unwrap();
    let mount = "mount -t tmpfs -o size=64k tmpfs \"$SMALL\"";
    let unshared = |script: &str| {
        let mut unshared = Command::new("unshare");
        unshared.args(["-rm", "sh", "-c", script, env!("CARGO_BIN_EXE_eyebolt")]);
        unshared.env("SMALL", &small).env("AFTER", desk.path());
        unshared
    };
    if !unshared(mount).output().is_ok_and(|probe| probe.status.success()) {
        let _ = writeln!(std::io::stderr(), "SKIPPED: no file system can be mounted here");
        return;
    }
    let script = format!(
        "{mount}; echo precious > \"$SMALL\"/out.mcap; \"$0\" \"$@\"; code=$?; \
         ls -A \"$SMALL\" > \"$AFTER\"/names; cp \"$SMALL\"/out.mcap \"$AFTER\"; exit $code"
    );
    for name in ["out.mcap", "folder"] {
        let output = small.join(name);
        let mut convert = unshared(&script);
        convert.args(["convert", text(recorded.path()), text(&output), "--force"]);
        let ended = end(start(&mut convert));
        ended.assert_error(&[text(&output), "cannot write", "Make room there"]);
        assert_eq!(fs::read(desk.file("names")).unwrap(), b"out.mcap\n");
        assert_eq!(fs::read(desk.file("out.mcap")).unwrap(), b"precious\n");
    }
}
