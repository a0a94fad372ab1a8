//! `eyebolt pose`, by the networks that come with the program.

use crate::desk::{Desk, text};
use crate::program::{CACHE, Ended, RECORDING, eyebolt};
use crate::simulate::SIMULATED;
use eyebolt_recording::SessionWriter;
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};

fn pose(more: &[&str]) -> Ended {
    let fixed = ["pose", text(&SIMULATED), "--model", "shackle", "--cache", text(&CACHE)];
    eyebolt(&[&fixed, more].concat())
}

#[test]
fn every_frame_has_its_line_and_no_answer_is_far_off() {
    let desk = Desk::new();
    let file = desk.file("poses.jsonl");
    let ended = pose(&["--json", "-o", text(&file)]);
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    assert_eq!(fs::read_to_string(&file).unwrap(), ended.out);
    let lines: Vec<Value> =
        ended.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 15);
    let answered: Vec<&Value> = lines.iter().filter(|line| line["answered"] == true).collect();
    assert!(answered.len() >= 10, "{}", ended.out);
    for line in &answered {
        assert_eq!((&line["method"], &line["reason"]), (&"fused".into(), &Value::Null));
        assert!(line["expected_error"]["translation_mm"].as_f64().unwrap() > 0.0);
        let z = line["camera_from_end_effector"]["translation_m"][2].as_f64().unwrap();
        assert!((0.3..3.0).contains(&z), "{line}");
    }
    // Frames of one configuration, three each, agree.
    for three in lines.chunks(3) {
        let at = |line: &Value, axis: usize| {
            line["camera_from_end_effector"]["translation_m"][axis].as_f64().unwrap()
        };
        let both = three.iter().filter(|line| line["answered"] == true).collect::<Vec<_>>();
        for pair in both.windows(2) {
            let off = (0..3).map(|axis| (at(pair[0], axis) - at(pair[1], axis)).powi(2));
            assert!(off.sum::<f64>().sqrt() < 0.02, "{pair:?}");
        }
    }
    pose(&["-o", text(&file)]).assert_error(1, &["poses.jsonl", "exists", "--force"]);
    // As messages: every line, and the poses that are to be relied on.
    let messages = desk.file("poses.mcap");
    assert_eq!(pose(&["-o", text(&messages)]).code, Some(0));
    let bytes = fs::read(&messages).unwrap();
    let messages: Vec<_> =
        mcap::MessageStream::new(&bytes).unwrap().map(|message| message.unwrap()).collect();
    let on = |topic: &str| messages.iter().filter(|it| it.channel.topic == topic).count();
    assert_eq!(on("/eyebolt/pose"), lines.len());
    assert_eq!(on("/eyebolt/end_effector"), answered.len());
}

/// A cloud without a camera is seen by a camera of our own, which looks elsewhere: poses are in the frame of the cloud all the same.
#[test]
fn a_cloud_has_the_pose_that_its_image_has() {
    let desk = Desk::new();
    let clouds = desk.file("clouds");
    let model = ["--model", "shackle", "--cache", text(&CACHE)];
    let segment = ["segment", text(&SIMULATED), "-o", text(&clouds), "--clouds", "pcd"];
    assert_eq!(eyebolt(&[&segment[..], &model, &["--networks-alone"]].concat()).code, Some(0));
    let places = |said: &str| -> Vec<Option<[f64; 3]>> {
        let lines = said.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        let place = |line: Value| {
            let at = &line["camera_from_end_effector"]["translation_m"];
            let at = [0, 1, 2].map(|axis| at[axis].as_f64());
            (line["answered"] == true).then(|| at.map(Option::unwrap))
        };
        lines.map(place).collect()
    };
    let of_images = places(&pose(&["--json"]).out);
    let mut both = 0;
    for (frame, of_image) in of_images.iter().enumerate().step_by(3) {
        let cloud = clouds.join(format!("cloud_{frame}.pcd"));
        let words = ["pose", text(&cloud), "--robot", "shackle", "--json"];
        let of_cloud = places(&eyebolt(&[&words[..], &model].concat()).out);
        if let ([Some(at)], Some(of_image)) = (&of_cloud[..], of_image) {
            let off = (0..3).map(|axis| (at[axis] - of_image[axis]).powi(2)).sum::<f64>().sqrt();
            assert!(off < 0.01, "frame {frame}: {off} m");
            both += 1;
        }
    }
    assert!(both >= 2, "{both} of 5");
}

/// A recording that is written while it is read: the first poses come before the last frames do, and in the end there are those of all.
#[test]
fn a_recording_that_grows_is_followed() {
    let desk = Desk::new();
    let growing = desk.file("growing.mcap");
    let bytes = fs::read(&*SIMULATED).unwrap();
    let messages: Vec<_> =
        mcap::MessageStream::new(&bytes).unwrap().map(|message| message.unwrap()).collect();
    let mut session = SessionWriter::new(fs::File::create(&growing).unwrap()).unwrap();
    let mut write = |messages: &[mcap::Message<'_>]| {
        for message in messages {
            let kind = &message.channel.schema.as_ref().unwrap().name;
            let time = i64::try_from(message.log_time).unwrap();
            session.write(&message.channel.topic, kind, time, &message.data).unwrap();
        }
        session.flush().unwrap();
    };
    let (first, last) = messages.split_at(2 * messages.len() / 3);
    write(first);
    let topic = "/camera/depth/image_raw";
    let words = ["pose", text(&growing), "--follow", "--json", "--robot", "shackle"];
    let words = [&words[..], &["--depth-topic", topic]].concat();
    let mut child = Command::new(env!("CARGO_BIN_EXE_eyebolt"))
        .args([&words[..], &["--model", "shackle", "--cache", text(&CACHE)]].concat())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let begun = lines.next().unwrap().unwrap();
    write(last);
    session.finish().unwrap();
    let all: Vec<String> = std::iter::once(begun).chain(lines.map(Result::unwrap)).collect();
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(all.len(), 15);
    let answered = all.iter().filter(|line| line.contains("\"answered\":true")).count();
    assert!(answered >= 10, "{all:?}");
    eyebolt(&["pose", text(&RECORDING), "--follow", "--model", "shackle"])
        .assert_error(1, &["--follow", "MCAP"]);
}

/// By standard input, too; and where that is cut, all that came is used.
#[test]
fn a_recording_comes_by_standard_input() {
    let bytes = fs::read(&*SIMULATED).unwrap();
    let words = ["pose", "-", "--json", "--robot", "shackle", "--model", "shackle"];
    let mut child = Command::new(env!("CARGO_BIN_EXE_eyebolt"))
        .args([&words[..], &["--cache", text(&CACHE)]].concat())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let (first, last) = bytes.split_at(2 * bytes.len() / 3);
    input.write_all(first).unwrap();
    let begun = lines.next().unwrap().unwrap();
    assert!(begun.contains("\"answered\""), "{begun}");
    // Without its end.
    input.write_all(&last[..last.len() - 20]).unwrap();
    drop(input);
    assert_eq!(1 + lines.count(), 15);
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[test]
fn standard_input_that_is_no_recording_is_refused() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_eyebolt"))
        .args(["pose", "-", "--model", "shackle"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(b"neither an MCAP nor anything else").unwrap();
    let ended = child.wait_with_output().unwrap();
    let told = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(1), "{told}");
    assert!(told.contains("standard-input.mcap") && told.contains("MCAP"), "{told}");
}

#[test]
fn as_the_networks_have_it_no_error_is_expected() {
    let ended = pose(&["--json", "--method", "rpt", "--no-icp"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for line in ended.out.lines() {
        let line: Value = serde_json::from_str(line).unwrap();
        assert_eq!((&line["method"], &line["expected_error"]), (&"rpt".into(), &Value::Null));
    }
}

#[test]
fn models_of_something_else_are_refused() {
    let refused = |model: &Path, words: &[&str]| {
        eyebolt(&["pose", text(&SIMULATED), "--model", text(model)]).assert_error(1, words);
    };
    refused(Path::new("any-arm"), &["any-arm", "end-effector", "eyebolt train"]);
    refused(Path::new("nowhere"), &["nowhere", "eyebolt train"]);
}
