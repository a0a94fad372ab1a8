//! Labels held against the truth: on simulated recordings of every camera, and on real ones against
//! their masks.
//!
//! ```text
//! cargo run --release -p eyebolt --example label_truth -- [--robot shackle] [--sensor NAME] [--seeds 2]
//!     [--frames 3] [--joint-offset-sigma-deg 0] [--depth-scale 1] [FOLDER...]
//! ```
//!
//! Each recording is calibrated from nothing, and then every frame labelled. Without a folder, arms are
//! simulated before each camera, with frames of the background and without; of the pixels with depth
//! it is said how many are ignored, and of the others how many show what an ideal camera sees there.
//! A folder with a `recording.toml` that names robot and masks is labelled without its masks and
//! compared with them, but for 3 pixels on either side of their edges.

#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::answer::Answer;
use eyebolt::dataset::{LabelRun, Labelled};
use eyebolt::end_effector::EndEffector;
use eyebolt::export::SavedCalibration;
use eyebolt::pipeline::{self, Outcome, Request};
use eyebolt::record::RecordOptions;
use eyebolt::robots::BuiltIn;
use eyebolt::simulate::{Faults, PRESETS, Plan, Scenario, TrueView, Viewpoint, plan};
use eyebolt_recording::{BagOptions, FrameSource, Recording};
use eyebolt_registration::{Label, Labels, LinkCache};
use eyebolt_render::Sensor;
use eyebolt_robot::{Arm, PackageRoots, Robot};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

type Failure = Box<dyn Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let (mut flags, mut folders) = (BTreeMap::new(), Vec::new());
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.strip_prefix("--") {
            Some(name) => drop(flags.insert(name.to_owned(), arguments.next().ok_or("no value")?)),
            None => folders.push(argument),
        }
    }
    println!(
        "recording                          verdict  labelled  left out   right %  ignored %  wrong: \
         rest>arm  rest>hand  arm>rest  arm>hand  hand>rest  hand>arm (%)"
    );
    for folder in &folders {
        real(Path::new(folder))?;
    }
    if folders.is_empty() {
        simulated(&flags)?;
    }
    Ok(())
}

fn simulated(flags: &BTreeMap<String, String>) -> Result<(), Failure> {
    let number = |name: &str, default: usize| flags.get(name).map_or(Ok(default), |n| n.parse());
    let real = |name: &str, default: f64| flags.get(name).map_or(Ok(default), |n| n.parse());
    let faults = Faults {
        joint_offset_sigma: real("joint-offset-sigma-deg", 0.0)?.to_radians(),
        depth_scale: real("depth-scale", 1.0)?,
        ..Faults::default()
    };
    let robot = flags.get("robot").map_or("shackle", String::as_str);
    let robot = BuiltIn::named(robot).ok_or("no such robot")?;
    let only = flags.get("sensor");
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-label-truth-links"));
    let arm = robot.arm();
    for sensor in Sensor::ALL.iter().filter(|s| only.is_none_or(|only| only == s.name)) {
        for seed in 1..=number("seeds", 2)? {
            for backgrounds in [8, 0] {
                let scenario = Scenario {
                    arm: &arm,
                    urdf: robot.urdf,
                    sensor: *sensor,
                    viewpoint: Viewpoint::Preset(&PRESETS[seed % PRESETS.len()]),
                    configurations: 6,
                    frames: number("frames", 3)?,
                    moving_frames: 0,
                    backgrounds,
                    clutter: 8,
                    faults,
                    seed: seed as u64,
                };
                let name = format!("{} {} {seed} {backgrounds} empty", robot.name, sensor.name);
                one_simulated(&name, &plan(scenario, &cache)?, &arm, &cache)?;
            }
        }
    }
    Ok(())
}

fn one_simulated(name: &str, plan: &Plan<'_>, arm: &Arm, cache: &LinkCache) -> Result<(), Failure> {
    let source = plan.in_memory()?;
    let truth: Vec<TrueView> = (0..6).map(|index| plan.true_view(index)).collect();
    let compared = |index: usize, labelled: &Labelled| {
        let configuration = source.frame_names()[index].split('-').next().map(str::parse::<usize>);
        let truth = &truth[configuration.expect("numbered").expect("numbered").min(5)];
        let mut counts = Counts::default();
        for (at, label) in labelled.frame.labels.iter().enumerate() {
            if labelled.frame.depth.depth_m()[at] > 0.0 {
                counts.add(usize::from(truth.label[at]), *label);
            }
        }
        counts
    };
    judge(name, &source, arm, cache, compared)
}

fn real(folder: &Path) -> Result<(), Failure> {
    let recording = Recording::open(folder, &BagOptions::default())?;
    let section = recording.robot();
    let urdf = section.urdf.clone().ok_or("recording.toml names no robot")?;
    let robot = Robot::from_urdf_file(&urdf, &PackageRoots::new())?;
    let arm = robot.arm(section.base.as_deref(), section.end_effector.as_deref())?;
    let source = recording.source();
    let compared = |index: usize, labelled: &Labelled| {
        let mask = source.read_frame(index).ok().and_then(|frame| frame.mask);
        let mask = mask.expect("a recording with masks");
        let (width, height) = (mask.width() as usize, mask.height() as usize);
        let masked = Labels::from_fn(0..width, 0..height, |u, v| {
            if mask.at(u as u32, v as u32) { Label::Arm } else { Label::Background }
        });
        let near = |other: Label| masked.near(3.0, move |label| label == other);
        let (near_arm, near_rest) = (near(Label::Arm), near(Label::Background));
        let mut counts = Counts::default();
        for (at, label) in labelled.frame.labels.iter().enumerate() {
            let is_edge = near_arm[at] && near_rest[at];
            if labelled.frame.depth.depth_m()[at] > 0.0 && !is_edge {
                // Masks do not tell the hand from the arm.
                let label = if *label == Label::EndEffector { Label::Arm } else { *label };
                counts.add(usize::from(near_arm[at]), label);
            }
        }
        counts
    };
    let name = folder.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-label-truth-links"));
    judge(&name, source, &arm, &cache, compared)
}

/// Calibrates, labels every frame, and prints a line.
fn judge(
    name: &str,
    source: &dyn FrameSource,
    arm: &Arm,
    cache: &LinkCache,
    compared: impl Fn(usize, &Labelled) -> Counts + Sync,
) -> Result<(), Failure> {
    let options = RecordOptions { use_masks: false, ..RecordOptions::default() };
    let request = Request { cache: cache.clone(), options, ..Request::new(source, arm) };
    let outcome = pipeline::run(&request, &())?;
    let answer = Answer::new(&request, &outcome);
    let Outcome { observations: Some(observations), .. } = &outcome else {
        return Err("not this robot".into());
    };
    let calibration = SavedCalibration::parse("answer", &answer.to_json())?;
    let end_effector = EndEffector::of(arm)?;
    let run = LabelRun::new(source, (observations, &options), (arm, &end_effector), &calibration)?;
    let frames = 0..source.frame_names().len();
    let counted = frames.into_par_iter().map(|index| match run.frame(index)? {
        Ok(labelled) => Ok(Ok(compared(index, &labelled))),
        Err(left_out) => Ok(Err(left_out.to_string())),
    });
    let counted: Vec<Result<Counts, String>> = counted.collect::<Result<_, Failure>>()?;
    let left_out: Vec<&String> =
        counted.iter().filter_map(|counts| counts.as_ref().err()).collect();
    let mut all = Counts::default();
    let mut labelled = 0;
    for counts in counted.iter().flatten() {
        all.extend(counts);
        labelled += 1;
    }
    println!("{name:34} {:8} {labelled:8}  {:8}   {}", answer.verdict, left_out.len(), all.shown());
    left_out.first().iter().for_each(|reason| println!("    {reason}"));
    answer.reasons.iter().for_each(|reason| println!("    refused: {reason}"));
    Ok(())
}

/// Pixels by what they show in truth (0 rest, 1 arm, 2 hand) and by label (3 ignore).
#[derive(Default)]
struct Counts([[usize; 4]; 3]);

impl Counts {
    fn add(&mut self, truth: usize, label: Label) {
        let label = match label {
            Label::Background => 0,
            Label::Arm => 1,
            Label::EndEffector => 2,
            Label::Ignore => 3,
        };
        self.0[truth][label] += 1;
    }

    fn extend(&mut self, other: &Self) {
        let pairs = self.0.iter_mut().flatten().zip(other.0.iter().flatten());
        pairs.for_each(|(own, other)| *own += other);
    }

    fn shown(&self) -> String {
        let all: usize = self.0.iter().flatten().sum();
        let ignored: usize = self.0.iter().map(|row| row[3]).sum();
        let right: usize = (0..3).map(|class| self.0[class][class]).sum();
        let labelled = (all - ignored).max(1);
        let percent = |count: usize, of: usize| 100.0 * count as f64 / of.max(1) as f64;
        let wrong = [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]
            .map(|(truth, label)| format!("{:9.3}", percent(self.0[truth][label], labelled)));
        let robot = |row: &[usize; 4]| row[1] + row[2];
        let robot_right = robot(&self.0[1]) + robot(&self.0[2]);
        let said_robot = robot_right + robot(&self.0[0]);
        let is_robot = robot_right + self.0[1][0] + self.0[2][0];
        let ignored_of = |class: usize| percent(self.0[class][3], self.0[class].iter().sum());
        format!(
            "{:7.3}   {:7.3}   {}   robot precision {:.2}, recall {:.2}; ignored of rest, arm, hand {:.1} {:.1} {:.1}",
            percent(right, labelled),
            percent(ignored, all),
            wrong.join(" "),
            percent(robot_right, said_robot),
            percent(robot_right, is_robot),
            ignored_of(0),
            ignored_of(1),
            ignored_of(2)
        )
    }
}
