//! `eyebolt convert`: there and back, and what it will not overwrite.

use crate::desk::{Desk, text};
use crate::good::parsed;
use crate::program::{RECORDING, calibrate, eyebolt};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn convert(from: &Path, to: &Path, more: &[&str]) -> crate::program::Ended {
    let mut arguments = vec!["convert", text(from), text(to)];
    arguments.extend(more);
    eyebolt(&arguments)
}

/// The answer of a recording, without what tells where it came from.
fn answer(desk: &Desk, recording: &Path) -> Value {
    let output = desk.file("answer.json");
    let ended = calibrate(recording, &output, &["--force"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.err);
    let mut answer: Value = serde_json::from_slice(&fs::read(output).unwrap()).unwrap();
    // Its name in the text of the URDF stays, its file does not.
    answer.as_object_mut().unwrap().remove("urdf_hash");
    answer
}

#[test]
fn there_and_back_the_answer_is_the_same() {
    let desk = Desk::new();
    let (mcap, folder, again) = (desk.file("a.mcap"), desk.file("b"), desk.file("c.mcap"));
    for (from, to) in [(RECORDING.as_path(), &mcap), (&mcap, &folder), (&folder, &again)] {
        let ended = convert(from, to, &[]);
        assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
        let said = format!("5 frames, written to {}\n", text(to));
        assert!(ended.out.starts_with(&said), "{}", ended.out);
    }
    let mut good = parsed();
    good.as_object_mut().unwrap().remove("urdf_hash");
    for recording in [&mcap, &folder, &again] {
        assert_eq!(answer(&desk, recording), good, "{}", recording.display());
    }
    // Nothing that is not an answer is left over.
    assert_eq!(desk.names(), ["a.mcap", "answer.json", "b", "c.mcap"]);
    // The same input, the same bytes.
    let twice = desk.file("d.mcap");
    assert_eq!(convert(&RECORDING, &twice, &[]).code, Some(0));
    assert!(fs::read(&twice).unwrap() == fs::read(&mcap).unwrap());
}

#[test]
fn what_exists_is_replaced_only_when_told() {
    let desk = Desk::new();
    let (file, folder) = (desk.file("a.mcap"), desk.file("folder"));
    fs::write(&file, "precious").unwrap();
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("letter.txt"), "precious").unwrap();
    convert(&RECORDING, &file, &[]).assert_error(1, &["a.mcap", "exists", "--force"]);
    convert(&RECORDING, &folder, &[]).assert_error(1, &["folder", "exists", "--force"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
    // Not even when told, if it is no recording.
    convert(&RECORDING, &folder, &["--force"]).assert_error(1, &["folder", "letter.txt"]);
    fs::write(folder.join("recording.toml"), "").unwrap();
    convert(&RECORDING, &folder, &["--force"]).assert_error(1, &["folder", "letter.txt"]);
    assert_eq!(fs::read_to_string(folder.join("letter.txt")).unwrap(), "precious");
    assert_eq!(convert(&RECORDING, &file, &["--force"]).code, Some(0));
    assert!(fs::read(&file).unwrap().starts_with(b"\x89MCAP0\r\n"));
    fs::remove_file(folder.join("letter.txt")).unwrap();
    fs::write(folder.join("depth_77.png"), "").unwrap();
    assert_eq!(convert(&file, &folder, &["--force"]).code, Some(0));
    assert!(!folder.join("depth_77.png").exists() && folder.join("joints.csv").exists());
    assert_eq!(desk.names(), ["a.mcap", "folder"]);
}

#[test]
fn a_recording_is_not_written_over_itself() {
    let desk = Desk::new();
    let file = desk.file("a.mcap");
    assert_eq!(convert(&RECORDING, &file, &[]).code, Some(0));
    let before = fs::read(&file).unwrap();
    convert(&file, &file, &["--force"]).assert_error(1, &["a.mcap", "the recording itself"]);
    assert!(fs::read(&file).unwrap() == before);
    // Nor over the folder that it lies in, whichever of the two was named.
    let folder = desk.file("folder");
    assert_eq!(convert(&file, &folder, &[]).code, Some(0));
    let described = folder.join("recording.toml");
    convert(&described, &folder, &["--force"]).assert_error(1, &["folder", "the recording itself"]);
    fs::create_dir(desk.file("bag")).unwrap();
    let inner = desk.file("bag").join("a.mcap");
    fs::rename(&file, &inner).unwrap();
    convert(&desk.file("bag"), &inner, &["--force"]).assert_error(1, &["the recording itself"]);
    assert!(fs::read(&inner).unwrap() == before && described.exists());
}

#[test]
fn the_robot_that_is_given_replaces_the_bags_own() {
    let desk = Desk::new();
    let (own, mcap, folder) = (desk.file("a.mcap"), desk.file("b.mcap"), desk.file("folder"));
    assert_eq!(convert(&RECORDING, &own, &[]).code, Some(0));
    let urdf = RECORDING.join("other.urdf");
    assert_eq!(convert(&own, &mcap, &["--robot", text(&urdf)]).code, Some(0));
    assert_eq!(convert(&mcap, &folder, &[]).code, Some(0));
    let written = fs::read_to_string(folder.join("robot.urdf")).unwrap();
    assert_eq!(written, fs::read_to_string(urdf).unwrap());
}

#[test]
fn backgrounds_and_truth_go_with_it() {
    let desk = Desk::new();
    let recording = desk.file("recording");
    fs::create_dir(&recording).unwrap();
    for file in fs::read_dir(&*RECORDING).unwrap() {
        let file = file.unwrap().path();
        fs::copy(&file, recording.join(file.file_name().unwrap())).unwrap();
    }
    let described = fs::read_to_string(recording.join("recording.toml")).unwrap();
    let described = described + "\n[background]\ndepth = \"background_{}.npy\"\n";
    fs::write(recording.join("recording.toml"), described).unwrap();
    fs::copy(recording.join("depth_0.npy"), recording.join("background_0.npy")).unwrap();
    // Nothing reads it, so it may say anything.
    fs::write(recording.join("truth.json"), "whatever it says").unwrap();
    let (mcap, folder) = (desk.file("a.mcap"), desk.file("folder"));
    // The second time over a folder with such files in it.
    for more in [&[][..], &["--force"]] {
        assert_eq!(convert(&recording, &mcap, more).code, Some(0));
        let ended = convert(&mcap, &folder, more);
        assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""));
        let [frame, background] =
            ["depth_0.npy", "background_0.npy"].map(|name| fs::read(folder.join(name)).unwrap());
        assert!(frame == background);
        assert_eq!(fs::read_to_string(folder.join("truth.json")).unwrap(), "whatever it says");
    }
    let said = eyebolt(&["info", text(&mcap)]).out;
    let line = said.lines().find(|line| line.contains("/camera/depth/background/image_raw"));
    assert!(line.is_some_and(|line| line.starts_with("background ")), "{said}");
    assert!(said.contains("5 take part"), "{said}");
}

#[test]
fn what_is_not_written_is_said_so() {
    for name in ["a.bag", "a.db3", "a.mcap.zstd"] {
        let ended = convert(&RECORDING, Path::new(name), &[]);
        ended.assert_error(1, &[name, "not written", ".mcap, or a folder"]);
    }
}

#[test]
fn a_recording_that_cannot_be_read_leaves_nothing() {
    let desk = Desk::new();
    let recording = desk.file("recording");
    fs::create_dir(&recording).unwrap();
    for file in fs::read_dir(&*RECORDING).unwrap() {
        let file = file.unwrap().path();
        fs::copy(&file, recording.join(file.file_name().unwrap())).unwrap();
    }
    fs::write(recording.join("depth_4.npy"), "no array").unwrap();
    for name in ["out.mcap", "out"] {
        let ended = convert(&recording, &desk.file(name), &[]);
        ended.assert_error(1, &["depth_4.npy", "NPY"]);
    }
    assert_eq!(desk.names(), ["recording"]);
}

/// A cube in ASCII STL, counter-clockwise from outside.
fn stl() -> String {
    let corner = |i: usize| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|side| 0.06 * side as f64 - 0.03);
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut text = "solid cube\n".to_owned();
    for [a, b, c, d] in faces {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in triangle.map(corner) {
                text += &format!("vertex {x} {y} {z}\n");
            }
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid cube\n"
}

/// What comes with a bag must not make the program read any file that it names.
#[test]
fn a_description_from_a_bag_names_no_file_outside_the_package_folders() {
    let desk = Desk::new();
    fs::write(desk.file("hand.stl"), stl()).unwrap();
    let url = format!("file://{}", text(&desk.file("hand.stl")));
    let described = fs::read_to_string(RECORDING.join("arm.urdf")).unwrap();
    let flange = "<cylinder radius=\"0.04\" length=\"0.03\"/>";
    assert!(described.contains(flange));
    let mesh = format!("<mesh filename=\"{url}\"/>");
    fs::write(desk.file("arm.urdf"), described.replacen(flange, &mesh, 1)).unwrap();
    let bag = desk.file("a.mcap");
    let urdf = desk.file("arm.urdf");
    assert_eq!(convert(&RECORDING, &bag, &["--robot", text(&urdf)]).code, Some(0));
    let output = desk.file("c.json");
    let refused = calibrate(&bag, &output, &[]);
    refused.assert_error(1, &["hand.stl", "--package-path", "--robot", "--allow-outside-files"]);
    let folder = desk.path();
    for more in [vec!["--allow-outside-files"], vec!["--package-path", text(folder)]] {
        let ended = calibrate(&bag, &output, &[more, vec!["--force"]].concat());
        assert!(matches!(ended.code, Some(0 | 3)), "{}{}", ended.out, ended.err);
    }
    // A file that the user names is trusted.
    let ended = calibrate(&bag, &output, &["--robot", text(&urdf), "--force"]);
    assert!(matches!(ended.code, Some(0 | 3)), "{}{}", ended.out, ended.err);
}
