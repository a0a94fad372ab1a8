//! Ctrl-C in the middle of the work.

use crate::desk::{Desk, text};
use crate::folder::{GOOD, Recorded};
use crate::run::{PATIENCE, command, end, start};
use std::os::unix::fs::symlink;
use std::process::Command;
use std::thread;
use std::time::Instant;

/// More frames than can be written before the program hears of it: half a minute of work.
const FRAMES: usize = 3000;

/// A recording of the same frame over and over.
fn long(frames: usize) -> Recorded {
    let recorded = Recorded::two();
    for frame in 2..frames {
        for (name, ending) in [("depth", "npy"), ("mask", "png"), ("joints", "npy")] {
            let link = recorded.path().join(format!("{name}_{frame}.{ending}"));
            symlink(format!("{name}_1.{ending}"), link).unwrap();
        }
    }
    recorded
}

/// Interrupts a conversion to `name` when something has appeared beside it that will become it.
fn interrupt(name: &str) {
    let (desk, recorded) = (Desk::new(), long(FRAMES));
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

/// Frames that take some seconds to label.
const LABELLED_FRAMES: usize = 250;

/// What was labelled stays, and the next run goes on from there.
#[test]
fn a_data_set_half_filled() {
    let (desk, recorded) = (Desk::new(), long(LABELLED_FRAMES));
    let (calibration, set) = (desk.file("calibration.json"), desk.file("set"));
    std::fs::write(&calibration, &*GOOD).unwrap();
    let given = ["--calibration", text(&calibration), "--json", "--no-cache"];
    let arguments =
        [&["label", text(recorded.path()), "--output", text(&set)], &given[..]].concat();
    let mut label = start(&mut command("", &arguments));
    let begun = Instant::now();
    while !set.join("frames").exists() && label.try_wait().unwrap().is_none() {
        assert!(begun.elapsed() < PATIENCE, "nothing is labelled");
        thread::yield_now();
    }
    let sent = Command::new("kill").args(["-INT", &label.id().to_string()]).status().unwrap();
    assert!(sent.success());
    end(label).assert_error(&["before all frames were labelled", "Run it again to go on"]);
    assert!(!set.join("index.jsonl").exists());
    let ended = end(start(&mut command("", &arguments)));
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    let told: serde_json::Value = serde_json::from_str(&ended.out).unwrap();
    let known = told["known"].as_u64().unwrap();
    assert_eq!(told["labelled"], LABELLED_FRAMES);
    assert!(known > 0 && known < LABELLED_FRAMES as u64, "{known}");
}

/// Whether the process catches the signal that Ctrl-C sends, in a thread of its own as the program
/// does. The shell that becomes the program catches it too, and has one thread.
#[cfg(target_os = "linux")]
fn catches_interrupts(process: u32) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let field = |name| status.lines().find_map(|line| line.strip_prefix(name)).map(str::trim);
    let caught = field("SigCgt:").and_then(|mask| u64::from_str_radix(mask, 16).ok());
    let threads = field("Threads:").and_then(|count| count.parse::<usize>().ok());
    // SIGINT is the second.
    caught.is_some_and(|mask| mask & 0b10 != 0) && threads.is_some_and(|count| count > 1)
}

/// A calibration writes nothing before its end, and says so.
#[cfg(target_os = "linux")]
#[test]
fn a_calibration_half_done() {
    let (desk, recorded) = (Desk::new(), long(FRAMES));
    let output = desk.file("calibration.json");
    let arguments = crate::run::calibration(recorded.path(), &output, &[]);
    let mut calibrate = start(&mut command("", &arguments));
    let begun = Instant::now();
    while !catches_interrupts(calibrate.id()) && calibrate.try_wait().unwrap().is_none() {
        assert!(begun.elapsed() < PATIENCE, "it listens to nobody");
        thread::yield_now();
    }
    let sent = Command::new("kill").args(["-INT", &calibrate.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let ended = end(calibrate);
    assert_eq!((ended.code, ended.out.as_str()), (Some(130), ""), "{}", ended.err);
    assert_eq!(ended.err.trim(), "stopped: nothing was written");
    assert!(desk.names().is_empty(), "{:?}", desk.names());
}
