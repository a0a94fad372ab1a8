//! `eyebolt train` and `eyebolt segment`.

use crate::desk::{Desk, text};
use crate::program::{CACHE, Ended, RECORDING, eyebolt};
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::LazyLock;
use std::thread;

const BINARY: &str = env!("CARGO_BIN_EXE_eyebolt");
/// Two checkpoints.
const STEPS: &str = "20";

/// Arguments that teach the segmentation of the built-in robot into `output` in a few steps.
fn arguments<'a>(output: &'a Path, more: &[&'a str]) -> Vec<&'a str> {
    let fixed =
        ["train", "segmentation", "--steps", STEPS, "-o", text(output), "--cache", text(&CACHE)];
    [&fixed, more].concat()
}

fn train(output: &Path, more: &[&str]) -> Ended {
    eyebolt(&arguments(output, more))
}

/// A model that knows next to nothing.
static MODEL: LazyLock<(Desk, Ended)> = LazyLock::new(|| {
    let desk = Desk::shared("program-model");
    let ended = train(&desk.file("model"), &[]);
    (desk, ended)
});

fn model() -> std::path::PathBuf {
    MODEL.0.file("model")
}

#[test]
fn a_model_says_what_it_is_and_what_to_do_with_it() {
    let ended = &MODEL.1;
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    for word in ["step 10 of 20", "step 20 of 20", "arm_iou", "eyebolt segment RECORDING --model"] {
        assert!(ended.out.contains(word), "no {word:?} in {}", ended.out);
    }
    let folder = model().join("segmentation");
    let about = fs::read_to_string(folder.join("model.toml")).unwrap();
    for word in
        ["\"end_effector\"", "image_columns = 160", "shackle", "end_effector_recall", "eyebolt 0"]
    {
        assert!(about.contains(word), "no {word:?} in {about}");
    }
    let lines = fs::read_to_string(folder.join("log.jsonl")).unwrap();
    assert_eq!(lines.lines().count(), 2);
    assert!(folder.join("events.out.tfevents.eyebolt").exists());
    assert!(!folder.join("checkpoint").exists());
    // Once more: nothing to do.
    let again = train(&model(), &[]);
    assert!(
        again.out.contains("is there already") && again.out.contains("--force"),
        "{}",
        again.out
    );
    assert_eq!(fs::read_to_string(folder.join("model.toml")).unwrap(), about);
}

#[test]
fn labels_open_in_numpy_and_are_not_overwritten() {
    let (desk, model) = (Desk::new(), model());
    let labels = desk.file("labels");
    let segment =
        || eyebolt(&["segment", text(&RECORDING), "--model", text(&model), "-o", text(&labels)]);
    let ended = segment();
    assert_eq!((ended.code, ended.err.as_str()), (Some(0), ""), "{}", ended.out);
    assert!(ended.out.contains("frames written to"), "{}", ended.out);
    let file = fs::read(labels.join("label_0.npy")).unwrap();
    assert_eq!(file[..8], *b"\x93NUMPY\x01\x00");
    let header = String::from_utf8_lossy(&file[10..128]).into_owned();
    assert!(header.contains("'|u1'"), "{header}");
    let start = 10 + usize::from(u16::from_le_bytes([file[8], file[9]]));
    assert_eq!(start % 64, 0);
    assert!(file[start..].iter().all(|label| [0, 1, 2, 255].contains(label)));
    segment().assert_error(1, &["label_0.npy", "exists", "--force"]);
}

/// What is known of any arm is what an arm's segmentation begins with, unless something else is asked for.
#[test]
fn a_segmentation_begins_with_any_arm() {
    let desk = Desk::new();
    let weights =
        |folder: &Path| fs::read(folder.join("segmentation/weights.safetensors")).unwrap();
    let taught = |name: &str, more: &[&str]| {
        let output = desk.file(name);
        let ended = train(&output, more);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        weights(&output)
    };
    assert!(taught("named", &["--from", "any-arm"]) == weights(&model()));
    assert!(taught("nothing", &["--from-nothing"]) != weights(&model()));
}

/// Killed at any moment, the same command comes to the same bytes.
#[test]
fn a_run_that_was_killed_comes_to_the_same_bytes() {
    let desk = Desk::new();
    let output = desk.file("killed");
    let mut command = Command::new(BINARY);
    let mut child = command
        .args(arguments(&output, &[]))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let checkpoint = output.join("segmentation/checkpoint");
    while !checkpoint.exists() && child.try_wait().unwrap().is_none() {
        thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(checkpoint.exists() && !output.join("segmentation/model.toml").exists());
    // Another length is another run.
    let other = eyebolt(&[
        "train",
        "segmentation",
        "--steps",
        "30",
        "-o",
        text(&output),
        "--cache",
        text(&CACHE),
    ]);
    assert!(other.code == Some(1) && other.err.contains("--steps 20"), "{}", other.err);
    let ended = train(&output, &["--threads", "1"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    for name in ["weights.safetensors", "model.toml"] {
        let read = |folder: &Path| fs::read(folder.join("segmentation").join(name)).unwrap();
        assert!(read(&output) == read(&model()), "{name}");
    }
}

#[test]
fn what_cannot_be_taught_is_said() {
    let desk = Desk::new();
    let output = desk.file("model");
    let refused = |arguments: &[&str], words: &[&str]| {
        let ended = eyebolt(&[&["train", "-o", text(&output)], arguments].concat());
        assert_ne!(ended.code, Some(0), "{}", ended.out);
        words
            .iter()
            .for_each(|word| assert!(ended.err.contains(word), "no {word:?} in {}", ended.err));
    };
    refused(&["rotation", "--any-arm"], &["--any-arm", "Teach the segmentation"]);
    refused(&["--any-arm", "--robot", "shackle"], &["--any-arm", "--robot"]);
    refused(&["segmentation", "--steps", "2", "--from", "nowhere"], &["nowhere", "--from"]);
    refused(&["--from", "any-arm", "--from-nothing"], &["--from", "--from-nothing"]);
    refused(&["segmentation", "--data", "nowhere"], &["nowhere"]);
    refused(&["--robot", "nobody.urdf"], &["nobody.urdf"]);
    refused(&["--simulated", "0.5"], &["--data"]);
}

#[test]
fn models_of_something_else_are_refused() {
    let (desk, model) = (Desk::new(), model().join("segmentation"));
    let copy = desk.file("copy");
    fs::create_dir(&copy).unwrap();
    let refused = |text_of: &str, weights: &[u8], words: &[&str]| {
        fs::write(copy.join("model.toml"), text_of).unwrap();
        fs::write(copy.join("weights.safetensors"), weights).unwrap();
        let labels = desk.file("labels");
        let arguments = ["segment", text(&RECORDING), "--model", text(&copy), "-o", text(&labels)];
        eyebolt(&arguments).assert_error(1, words);
        assert!(!labels.exists());
    };
    let about = fs::read_to_string(model.join("model.toml")).unwrap();
    let weights = fs::read(model.join("weights.safetensors")).unwrap();
    refused(&about, &weights[..weights.len() / 2], &["copy", "weights"]);
    refused(&about, b"", &["copy", "weights"]);
    refused(&about.replace("\"arm\"", "\"leg\""), &weights, &["classes", "leg"]);
    refused(&about.replace("inverse_z_per_m", "colour"), &weights, &["features", "colour"]);
    refused(&about.replace("stem_kernel = 3", "stem_kernel = 5"), &weights, &["kernel"]);
    refused(&format!("version = 9\n{about}"), &weights, &["model.toml", "version"]);
    refused("nonsense", &weights, &["model.toml"]);
    let nowhere = eyebolt(&["segment", text(&RECORDING), "--model", "nowhere", "-o", "labels"]);
    nowhere.assert_error(1, &["nowhere", "model.toml", "eyebolt train"]);
}
