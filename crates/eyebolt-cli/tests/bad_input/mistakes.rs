//! `docs/mistakes.md`: what people do wrong, and what they are told. The page is what the program says:
//! `EYEBOLT_WRITE=1` writes it anew.

use crate::desk::Desk;
use crate::folder::SHOTS;
use crate::recording::{npy_f32, npy_f64, write, write_depth};
use crate::run::{CACHE, command, end, start};
use crate::scene::CAMERA;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// A mistake: what it is, what is typed, what the program said before anybody thought of it, and how it
/// comes about in a folder with the recording `rec`.
struct Mistake {
    what: &'static str,
    typed: &'static str,
    before: &'static str,
    make: fn(&Path),
}

const PAGE: &str = include_str!("../../../../docs/mistakes.md");

const HEAD: &str = "\
# Mistakes, and what eyebolt says

Errors name the file, the field and what to do; what is damaged, missing or of another kind is called so. This page is written by a test, which
makes each of these mistakes: *now* is what the program says, *before*, in words, what it said at first.

| mistake | typed | before | now |
|---|---|---|---|
";

fn nothing(_: &Path) {}

fn replace(folder: &Path, name: &str, from: &str, to: &str) {
    let path = folder.join(name);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "no {from:?} in {text}");
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

/// The depth of frame 1 times `factor`.
fn scale_depth(folder: &Path, factor: f32) {
    let shape = [CAMERA.height() as usize, CAMERA.width() as usize];
    for (frame, shot) in SHOTS[..2].iter().enumerate() {
        let scaled: Vec<f32> = shot.depth_m.iter().map(|z| factor * z).collect();
        write(folder, &format!("rec/depth_{frame}.npy"), &npy_f32(&shape, &scaled));
    }
}

/// A mesh of `url` in place of the hand's shape.
fn name_mesh(folder: &Path, url: &str) {
    let flange = "<cylinder radius=\"0.04\" length=\"0.03\"/>";
    replace(folder, "rec/arm.urdf", flange, &format!("<mesh filename=\"{url}\"/>"));
}

const MISTAKES: [Mistake; 28] = [
    Mistake {
        what: "a slip in the name",
        typed: "eyebolt calibrate rce",
        before: "cannot read the recording's description: No such file or directory",
        make: nothing,
    },
    Mistake {
        what: "an empty folder",
        typed: "eyebolt calibrate empty",
        before: "cannot read the recording's description: No such file or directory",
        make: |folder| fs::create_dir(folder.join("empty")).unwrap(),
    },
    Mistake {
        what: "a calibration instead of a recording",
        typed: "eyebolt calibrate answer.json",
        before: "taken for a recording.toml: an error of TOML",
        make: |folder| write(folder, "answer.json", br#"{"schema": "eyebolt.calibration/1"}"#),
    },
    Mistake {
        what: "the bag's metadata instead of the bag",
        typed: "eyebolt calibrate metadata.yaml",
        before: "taken for a recording.toml: an error of TOML",
        make: |folder| {
            write(folder, "metadata.yaml", b"rosbag2_bagfile_information:\n  version: 5\n");
        },
    },
    Mistake {
        what: "one image instead of the recording",
        typed: "eyebolt info rec/depth_0.npy",
        before: "taken for a recording.toml: not UTF-8",
        make: nothing,
    },
    Mistake {
        what: "the robot instead of the recording",
        typed: "eyebolt info rec/arm.urdf",
        before: "taken for a recording.toml: an error of TOML",
        make: nothing,
    },
    Mistake {
        what: "a folder with two bags",
        typed: "eyebolt info bags",
        before: "neither was named",
        make: |folder| {
            fs::create_dir(folder.join("bags")).unwrap();
            for name in ["bags/monday.mcap", "bags/tuesday.mcap"] {
                write(folder, name, b"\x89MCAP0\r\n");
            }
        },
    },
    Mistake {
        what: "a folder that nobody described",
        typed: "eyebolt calibrate rec",
        before: "cannot read the recording's description: No such file or directory",
        make: |folder| fs::remove_file(folder.join("rec/recording.toml")).unwrap(),
    },
    Mistake {
        what: "a slip in a key",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| replace(folder, "rec/recording.toml", "depth = ", "detph = "),
    },
    Mistake {
        what: "a unit that is none",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| replace(folder, "rec/recording.toml", "\"m\"", "\"cm\""),
    },
    Mistake {
        what: "millimetres called metres",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| scale_depth(folder, 1000.0),
    },
    Mistake {
        what: "joints of a frame are missing",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| fs::remove_file(folder.join("rec/joints_1.npy")).unwrap(),
    },
    Mistake {
        what: "joints in degrees",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| {
            let degrees: Vec<f64> = SHOTS[1].joints.iter().map(|rad| rad.to_degrees()).collect();
            write(folder, "rec/joints_1.npy", &npy_f64(&[degrees.len()], &degrees));
        },
    },
    Mistake {
        what: "a copy that was cut short",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| {
            let whole = fs::read(folder.join("rec/depth_1.npy")).unwrap();
            write(folder, "rec/depth_1.npy", &whole[..whole.len() / 2]);
        },
    },
    Mistake {
        what: "the intrinsics of another resolution",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| replace(folder, "rec/camera_info.yaml", "width: ", "width: 1"),
    },
    Mistake {
        what: "a camera that was never calibrated",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| {
            let text = fs::read_to_string(folder.join("rec/camera_info.yaml")).unwrap();
            let (before, _) = text.split_once("k: [").unwrap();
            let zeros = format!("{before}k: [0, 0, 0, 0, 0, 0, 0, 0, 0]\n");
            write(folder, "rec/camera_info.yaml", zeros.as_bytes());
        },
    },
    Mistake {
        what: "a slip in the robot's file",
        typed: "eyebolt calibrate rec --robot rec/arm.udrf",
        before: "cannot read the URDF: No such file or directory",
        make: nothing,
    },
    Mistake {
        what: "a robot that is not installed",
        typed: "eyebolt calibrate rec --robot ur5e",
        before: "cannot read the URDF: No such file or directory",
        make: nothing,
    },
    Mistake {
        what: "a slip in a link",
        typed: "eyebolt calibrate rec --base base_lnik",
        before: "the same",
        make: nothing,
    },
    Mistake {
        what: "meshes of a package that is not here",
        typed: "eyebolt calibrate rec",
        before: "looked for it nowhere",
        make: |folder| name_mesh(folder, "package://arm_description/meshes/hand.stl"),
    },
    Mistake {
        what: "meshes on another machine",
        typed: "eyebolt calibrate rec",
        before: "looked for it nowhere",
        make: |folder| name_mesh(folder, "file:///home/ann/ws/share/arm_description/hand.stl"),
    },
    Mistake {
        what: "xacro that is half expanded",
        typed: "eyebolt calibrate rec",
        before: "this is xacro: expand it first",
        make: |folder| {
            let xacro = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name=\"arm\">\
                         <xacro:include filename=\"$(find arm_description)/arm.xacro\"/></robot>";
            write(folder, "rec/arm.urdf", xacro.as_bytes());
        },
    },
    Mistake {
        what: "the description of another robot",
        typed: "eyebolt calibrate rec --robot stranger.urdf",
        before: "the same",
        make: |folder| {
            let arm = fs::read_to_string(folder.join("rec/arm.urdf")).unwrap();
            write(
                folder,
                "stranger.urdf",
                arm.replace("joint name=\"", "joint name=\"j_").as_bytes(),
            );
        },
    },
    Mistake {
        what: "a form that calibrate does not write",
        typed: "eyebolt calibrate rec -o camera.yaml",
        before: "JSON, whatever the file was called",
        make: nothing,
    },
    Mistake {
        what: "a result that is there already",
        typed: "eyebolt calibrate rec",
        before: "the same",
        make: |folder| write(folder, "calibration.json", b"{}"),
    },
    Mistake {
        what: "an empty bag",
        typed: "eyebolt info empty.mcap",
        before: "no topic has depth",
        make: |folder| write(folder, "empty.mcap", b""),
    },
    Mistake {
        what: "an export of something else",
        typed: "eyebolt export rec/recording.toml --as tf2",
        before: "the same",
        make: nothing,
    },
    Mistake {
        what: "a recording whose truth nobody knows",
        typed: "eyebolt evaluate rec calibration.json",
        before: "the same",
        make: |folder| write(folder, "calibration.json", br#"{"schema": "eyebolt.calibration/1"}"#),
    },
];

/// What the program says, in one line.
fn said(mistake: &Mistake) -> String {
    let desk = Desk::new();
    fs::create_dir(desk.file("rec")).unwrap();
    write_depth(&desk.file("rec"), &SHOTS[..2]);
    (mistake.make)(desk.path());
    let mut arguments: Vec<&str> = mistake.typed.split(' ').skip(1).collect();
    let cache = CACHE.path().to_str().unwrap();
    if arguments[0] == "calibrate" {
        arguments.extend(["--cache", cache]);
    }
    let folder = desk.path().display();
    let ended = end(start(&mut command(&format!("cd {folder};"), &arguments)));
    assert_ne!(ended.code, Some(0), "{}: {}", mistake.what, ended.out);
    // A refusal is told on standard output: its first reason.
    let line = ended.err.lines().next().or_else(|| {
        let reasons = ended.out.lines().map(str::trim_start);
        reasons.skip_while(|line| !line.starts_with("REFUSED")).nth(1)
    });
    let line = line.unwrap_or_else(|| panic!("{}: nothing is said", mistake.what));
    without_places(line)
}

/// Without the list of places that were looked at, which are this machine's.
fn without_places(line: &str) -> String {
    let between = line.split_once("; looked for ").and_then(|(before, after)| {
        after
            .split_once("; ")
            .map(|(_, remedy)| format!("{before}; looked for it in ...; {remedy}"))
    });
    between.unwrap_or_else(|| line.to_owned())
}

#[test]
fn the_page_says_what_the_program_says() {
    let cell = |text: &str| text.replace('|', "\\|").replace('<', "&lt;");
    let mut page = HEAD.to_owned();
    for mistake in &MISTAKES {
        let Mistake { what, typed, before, .. } = mistake;
        let now = cell(&said(mistake));
        let _ = writeln!(page, "| {what} | `{typed}` | {} | {now} |", cell(before));
    }
    if std::env::var_os("EYEBOLT_WRITE").is_some() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/mistakes.md");
        fs::write(path, &page).unwrap();
        return;
    }
    for (written, now) in PAGE.lines().zip(page.lines()) {
        assert_eq!(written, now, "docs/mistakes.md");
    }
    assert_eq!(PAGE.lines().count(), page.lines().count());
}
