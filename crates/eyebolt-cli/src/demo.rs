//! `eyebolt demo`.

use crate::ending::Ending;
use crate::inputs::{CacheArguments, use_threads};
use crate::names;
use crate::output::{self, Destination};
use crate::progress::{Bar, Waiting, leaves};
use crate::record_command;
use crate::simulate::{flags, numbers, record};
use crate::summary;
use anyhow::{Context as _, Result, bail};
use eyebolt::answer::Answer;
use eyebolt::calibrate::Verdict;
use eyebolt::evaluate::Evaluation;
use eyebolt::pipeline::{self, Outcome, Request};
use eyebolt::report::{Context, Picture, TruthComparison, html, overlays};
use eyebolt::robots::BuiltIn;
use eyebolt::simulate::{Faults, Ranges, Scenario, Viewpoint, plan};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_recording::{BagOptions, Recording};
use eyebolt_registration::LinkCache;
use eyebolt_render::Sensor;
use eyebolt_robot::Arm;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Options of `eyebolt demo`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder for what it makes; otherwise eyebolt-demo, or the next such name that is free
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Depth camera
    #[arg(long, default_value = "kinect-v1", value_parser = flags::sensor())]
    sensor: Sensor,
    /// Seed of the arm's configurations, the things around it and the noise
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How far each joint is from where it says, degrees: what becomes of it?
    #[arg(long, value_name = "DEG", default_value_t = 0.0,
          value_parser = numbers::number(0.0, 90.0), allow_hyphen_values = true)]
    joint_offset_deg: f64,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    cache: CacheArguments,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let folder = folder(arguments.output.as_deref())?;
    let robot = BuiltIn::named("shackle").context("no robot is built in")?;
    let arm = robot.arm();
    let cache = arguments.cache.open();
    let scenario = Scenario {
        arm: &arm,
        urdf: robot.urdf,
        sensor: arguments.sensor,
        viewpoint: Viewpoint::Within(whole_arm()),
        configurations: 6,
        frames: 10,
        moving_frames: 0,
        backgrounds: 10,
        clutter: 8,
        faults: Faults {
            joint_offset: arguments.joint_offset_deg.to_radians(),
            ..Faults::default()
        },
        seed: arguments.seed,
    };
    let waiting = Waiting::new("choosing configurations");
    let plan = plan(scenario, &cache)?;
    drop(waiting);
    let session = folder.join(SESSION);
    leaves(format!("what was done is in {}", folder.display()))?;
    if let Err(error) = record(&plan, &session, false) {
        // Only if nothing is in it.
        let _ = std::fs::remove_dir(&folder);
        return Err(error);
    }
    output::say(&format!(
        "1. simulated: {},\n   seen by {}; 6 configurations of 10 frames -> {}",
        robot.about().description,
        arguments.sensor.about,
        session.display()
    ));
    calibrate(&arm, &cache, &folder, &plan.sought_camera_from_base())
}

/// Where a camera has all of the arm in its image, about wherever it reaches.
fn whole_arm() -> Ranges {
    let radians = |degrees: [f64; 2]| degrees.map(f64::to_radians);
    Ranges {
        workspace_m: [0.10, 0.0, 0.45],
        distance_m: [1.75, 1.80],
        azimuth: radians([40.0, 45.0]),
        elevation: radians([22.0, 25.0]),
        askew: 0.03,
    }
}

/// The folder that was asked for, or a new one.
fn folder(asked: Option<&Path>) -> Result<PathBuf> {
    let empty = |path: &PathBuf| path.read_dir().is_ok_and(|mut entries| entries.next().is_none());
    let free = |path: &PathBuf| !path.exists() || empty(path);
    if let Some(path) = asked {
        let path = path.to_owned();
        if !free(&path) {
            bail!("{}: it is there already. Name a new folder", path.display());
        }
        return Ok(path);
    }
    let mut names = std::iter::once(PathBuf::from("eyebolt-demo"))
        .chain((2..1000).map(|n| PathBuf::from(format!("eyebolt-demo-{n}"))));
    names.find(free).context("eyebolt-demo: there are too many. Remove some, or name an --output")
}

/// Calibrates the recording in `folder` as anybody would, and tells how far off that is.
fn calibrate(
    arm: &Arm,
    cache: &LinkCache,
    folder: &Path,
    truth: &Transform<Camera, Base>,
) -> Result<Ending> {
    let session = folder.join(SESSION);
    let begun = Instant::now();
    let bar = Bar::new();
    let recording = Recording::open(&session, &BagOptions::default())?;
    let request = Request { cache: cache.clone(), ..Request::new(recording.source(), arm) };
    let outcome = pipeline::run(&request, &bar)?;
    bar.finish();
    let spent_s = begun.elapsed().as_secs_f64();
    let answer = Answer::new(&request, &outcome);
    let trusted = outcome.calibration.verdict == Verdict::Trusted;
    let destination = Destination::new(&folder.join("calibration.json"), false)?;
    let path = destination.write(trusted, answer.to_json().as_bytes())?;
    output::say(&format!("2. calibrated from nothing, without masks, in {spent_s:.1} s:\n"));
    output::say(&summary::text(&answer, &outcome.calibration.verdict, &path, &[], None));
    let pose = outcome.calibration.camera_from_base;
    let evaluation = pose.map(|pose| Evaluation::of(&pose, truth));
    output::say(&match &evaluation {
        Some(evaluation) => format!(
            "\n3. against where the camera really was: {:.2} mm and {:.3} degrees off",
            evaluation.translation_mm, evaluation.rotation_deg
        ),
        None => "\n3. no pose was found, so there is nothing to compare".to_owned(),
    });
    let report = report(folder, &answer, &outcome, evaluation)?;
    output::say(&format!(
        "4. the report, to open in a browser -> {}\n\n{}",
        report.display(),
        next()
    ));
    Ok(if trusted { Ending::Done } else { Ending::Refused })
}

/// Writes the report; its path.
fn report(
    folder: &Path,
    answer: &Answer,
    outcome: &Outcome,
    evaluation: Option<Evaluation>,
) -> Result<PathBuf> {
    let pictures: Vec<Picture> = overlays(outcome, |_| None).collect();
    let context = Context {
        recording: &folder.join(SESSION).display().to_string(),
        pictures: &pictures,
        truth: evaluation.map(|evaluation| TruthComparison {
            translation_mm: evaluation.translation_mm,
            rotation_deg: evaluation.rotation_deg,
        }),
        call_input: names::flag,
    };
    let path = folder.join("report.html");
    output::write_whole(&path, html(answer, outcome, &context).as_bytes(), false)?;
    Ok(path)
}

/// Name of the recording in the demo's folder.
const SESSION: &str = "session.mcap";

/// What to do with an arm of one's own.
fn next() -> String {
    format!(
        "\
With your own arm: let it rest in six or more configurations that look different to the camera,
the hand in view, and record it (`eyebolt record-command` knows other cameras):

  {}

  eyebolt info my_bag                                   # what is in it, what is missing
  eyebolt calibrate my_bag --report report.html         # where the camera is, how far to trust it
  eyebolt export calibration.json --as ros2-launch      # for tf2, MoveIt, easy_handeye2, URDF...",
        record_command::usual()
    )
}
