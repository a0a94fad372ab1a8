//! What has to be done, in order.

use super::arguments::Arguments;
use std::path::{Path, PathBuf};

/// A command of this program, and what it leaves: if that is there, it was done.
pub struct Step {
    pub about: String,
    pub product: PathBuf,
    pub arguments: Vec<String>,
}

/// The page with the tables.
pub const REPORT: &str = "report.html";

/// How much is recorded: configurations and frames of each.
struct Size {
    training: [u32; 2],
    test: [u32; 2],
    steps: u64,
}

/// The paper's setting: about 7000 frames of three poses to learn from, and six configurations of ten frames of three
/// others to test on.
const WHOLE: Size = Size { training: [233, 10], test: [6, 10], steps: 20_000 };
const QUICK: Size = Size { training: [8, 2], test: [5, 1], steps: 400 };

/// Places of the camera.
const POSES: [&str; 3] = ["p1", "p2", "p3"];

/// All steps of a reproduction.
pub fn steps(arguments: &Arguments) -> Vec<Step> {
    let size = if arguments.quick { QUICK } else { WHOLE };
    let mut steps = Vec::new();
    let mut models = Vec::new();
    match &arguments.model {
        Some(model) => models.push(word(&model.place(""))),
        None => {
            let recorded = |(index, pose): (usize, &&str)| {
                record(arguments, "train", pose, index, size.training)
            };
            steps.extend(POSES.iter().enumerate().map(recorded));
            steps.extend(POSES.iter().map(|pose| label(arguments, pose)));
            let mut sets: Vec<(&str, Vec<&str>)> = vec![("all", POSES.to_vec())];
            if arguments.each {
                sets.extend(POSES.iter().map(|pose| (*pose, vec![*pose])));
            }
            for (name, poses) in sets {
                let taught = train(arguments, name, &poses, arguments.steps.unwrap_or(size.steps));
                models.push(format!("{name}={}", word(&models_folder(arguments, name))));
                steps.push(taught);
            }
        }
    }
    let tested =
        |(index, pose): (usize, &&str)| record(arguments, "test", pose, 100 + index, size.test);
    steps.extend(POSES.iter().enumerate().map(tested));
    let marked = |(index, pose): (usize, &&str)| mark(arguments, pose, 100 + index, size.test);
    steps.extend(POSES.iter().enumerate().map(marked));
    steps.push(evaluate(arguments, &models));
    steps
}

fn record(
    arguments: &Arguments,
    what: &str,
    pose: &str,
    seed: usize,
    [configurations, frames]: [u32; 2],
) -> Step {
    let product = recording(arguments, what, pose);
    let mut words = words(&["simulate", "--robot", &arguments.robot, "--sensor", "kinect-v1"]);
    words.extend(["--preset".into(), format!("paper-{what}-{pose}")]);
    words.extend(["--configurations".into(), configurations.to_string()]);
    words.extend(["--frames".into(), frames.to_string(), "--seed".into(), seed.to_string()]);
    words.extend(["--output".into(), word(&product)]);
    Step { about: format!("record {what} pose {pose}"), product, arguments: words }
}

/// The marker that a hand carries in recordings for the paper's baseline.
const MARKER: &str = "aruco:4x4_50:0.08";
/// So many of its configurations, since not all show the marker.
const MARKED: u32 = 3;

fn mark(arguments: &Arguments, pose: &str, seed: usize, [configurations, _]: [u32; 2]) -> Step {
    let mut step = record(arguments, "test", pose, seed, [MARKED * configurations, 1]);
    step.about = format!("record test pose {pose} with a marker on the hand");
    step.product = recording(arguments, "marked", pose);
    if let Some(output) = step.arguments.last_mut() {
        *output = word(&step.product);
    }
    step.arguments.extend(words(&["--marker", MARKER]));
    step
}

fn label(arguments: &Arguments, pose: &str) -> Step {
    let folder = dataset(arguments, pose);
    let mut words = words(&["label", &word(&recording(arguments, "train", pose))]);
    words.extend(robot(arguments));
    words.extend(["--output".into(), word(&folder)]);
    let about = format!("label training pose {pose}: calibrated from nothing, by nobody");
    Step { about, product: folder.join("dataset.toml"), arguments: words }
}

fn train(arguments: &Arguments, name: &str, poses: &[&str], steps: u64) -> Step {
    let folder = models_folder(arguments, name);
    let mut words = words(&["train", "all", "--robot", &arguments.robot]);
    for pose in poses {
        words.extend(["--data".into(), word(&dataset(arguments, pose))]);
    }
    words.extend(["--steps".into(), steps.to_string()]);
    if let Some(from) = &arguments.from {
        words.extend(["--from".into(), word(&from.place(""))]);
    }
    words.extend(["--output".into(), word(&folder)]);
    let about = format!("teach the networks, {} of the training poses", poses.len());
    Step { about, product: folder.join("keypoints/weights.safetensors"), arguments: words }
}

fn evaluate(arguments: &Arguments, models: &[String]) -> Step {
    let product = arguments.output.join(REPORT);
    let mut words = words(&["evaluate"]);
    words.extend(POSES.iter().map(|pose| word(&recording(arguments, "test", pose))));
    words.extend(robot(arguments));
    words.extend(models.iter().flat_map(|model| ["--model".into(), model.clone()]));
    words.extend(["--marker".into(), MARKER.into()]);
    let marked = POSES.iter().map(|pose| word(&recording(arguments, "marked", pose)));
    words.extend(marked.flat_map(|path| ["--marked".into(), path]));
    words.extend(["--csv".into(), word(&arguments.output.join("tables.csv"))]);
    words.extend(["--report".into(), word(&product), "--force".into()]);
    Step { about: "evaluate".into(), product, arguments: words }
}

fn recording(arguments: &Arguments, what: &str, pose: &str) -> PathBuf {
    arguments.output.join("recordings").join(format!("{what}-{pose}.mcap"))
}

fn dataset(arguments: &Arguments, pose: &str) -> PathBuf {
    arguments.output.join("datasets").join(pose)
}

fn models_folder(arguments: &Arguments, name: &str) -> PathBuf {
    arguments.output.join("models").join(name)
}

/// Recordings of robots that come with the program hold all of their description; others have meshes elsewhere.
fn robot(arguments: &Arguments) -> Vec<String> {
    match eyebolt::robots::BuiltIn::named(&arguments.robot) {
        Some(_) => Vec::new(),
        None => words(&["--robot", &arguments.robot]),
    }
}

fn words(words: &[&str]) -> Vec<String> {
    words.iter().map(|word| (*word).to_owned()).collect()
}

fn word(path: &Path) -> String {
    path.display().to_string()
}
