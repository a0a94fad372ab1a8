//! Ctrl-C in the middle of the work.

use crate::desk::{Desk, text};
use crate::folder::Recorded;
use crate::run::{PATIENCE, command, end, start};
use std::os::unix::fs::symlink;
use std::process::Command;
use std::thread;
use std::time::Instant;

/// More frames than can be written before the program hears of it: half a minute of work.
const FRAMES: usize = 3000;

/// A recording of the same frame over and over.
fn long() -> Recorded {
    let recorded = Recorded::two();
    for frame in 2..FRAMES {
        for (name, ending) in [("depth", "npy"), ("mask", "png"), ("joints", "npy")] {
            let link = recorded.path().join(format!("{name}_{frame}.{ending}"));
            symlink(format!("{name}_1.{ending}"), link).unwrap();
        }
    }
    recorded
}

/// Interrupts a conversion to `name` when something has appeared beside it that will become it.
fn interrupt(name: &str) {
    let (desk, recorded) = (Desk::new(), long());
    let output = desk.file(name);
    let mut convert = start(&mut command("", &["convert", text(recorded.path()), text(&output)]));
    let begun = Instant::now();
    while desk.names().is_empty() && convert.try_wait().unwrap().is_none() {
        assert!(begun.elapsed() < PATIENCE, "nothing is written");
        thread::yield_now();
    }
    let sent = Command::new("kill").args(["-INT", &convert.id().to_string()]).status().unwrap();
    assert!(sent.success());
    end(convert).assert_error(&["stopped", "nothing was written"]);
    assert!(desk.names().is_empty(), "{:?}", desk.names());
}

#[test]
fn a_file_half_written() {
    interrupt("out.mcap");
}

#[test]
fn a_folder_half_written() {
    interrupt("out");
}
