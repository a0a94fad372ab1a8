//! `eyebolt pose`.

mod lines;
mod mcap;

use crate::ending::Ending;
use crate::inputs::{CacheArguments, RecordingArguments, RobotArguments, use_threads};
use crate::output;
use crate::progress::Counting;
use anyhow::{Result, bail};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use eyebolt::pose::{EndEffectorShape, PoseEstimator, PoseMethod, Recognizer};
use eyebolt::progress::Progress;
use eyebolt::record::{FrameImage, FrameImages};
use eyebolt_recording::Recording;
use eyebolt_robot::JointPositions;
use lines::Line;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Options of `eyebolt pose`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    recording: RecordingArguments,
    #[command(flatten)]
    robot: RobotArguments,
    /// Folder of a model that eyebolt train made for this end-effector, such as models/panda
    #[arg(long, value_name = "FOLDER")]
    model: PathBuf,
    /// How the pose comes about: by rotation and translation, by matched points, or by both and what the
    /// image supports
    #[arg(long, default_value = "fused", value_parser = method())]
    method: PoseMethod,
    /// Leave the pose as the networks have it
    #[arg(long)]
    no_icp: bool,
    /// Take the positions of fingers from the recording's joint states; otherwise the likeliest
    /// opening is found
    #[arg(long)]
    joint_states: bool,
    /// A line of JSON for each frame instead of text
    #[arg(long)]
    json: bool,
    /// Write the lines of JSON to this file, too; if it ends in .mcap, the poses as messages for Foxglove and RViz
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace an existing file
    #[arg(long)]
    force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    cache: CacheArguments,
}

fn method() -> impl TypedValueParser<Value = PoseMethod> {
    PossibleValuesParser::new(PoseMethod::ALL.map(|(name, _)| name)).try_map(|name| {
        let known = PoseMethod::ALL.into_iter().find(|(known, _)| *known == name);
        known.map(|(_, method)| method).ok_or("not a method")
    })
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    if let Some(path) = &arguments.output {
        output::refuse_existing(path, arguments.force)?;
    }
    let recording = named(arguments)?;
    let bar = Counting::new()?;
    let lines = of(arguments, &recording, &bar, &mut |line| {
        if arguments.json {
            output::say(&line.json());
        }
    })?;
    drop(bar);
    if !arguments.json {
        lines.iter().for_each(|line| output::say(&line.text()));
    }
    if let Some(path) = &arguments.output {
        write(path, &recording, &lines, arguments.force)?;
    }
    let answered = lines.iter().filter(|line| line.answered).count();
    if !arguments.json {
        output::say(&format!("{answered} of {} frames answered", lines.len()));
    }
    Ok(if answered == 0 { Ending::Refused } else { Ending::Done })
}

fn write(path: &Path, recording: &Recording<'_>, lines: &[Line], force: bool) -> Result<()> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mcap")) {
        let filled = |file: &mut File| {
            mcap::write(recording, lines, file).map_err(|error| output::named(error, path))
        };
        return output::write_through(path, force, filled);
    }
    let text: String = lines.iter().map(|line| line.json() + "\n").collect();
    output::write_whole(path, text.as_bytes(), force)
}

/// The recording that `arguments` name.
pub(crate) fn named(arguments: &Arguments) -> Result<Recording<'static>> {
    arguments.recording.open_or_cloud(&arguments.robot)
}

/// What is told of each frame of `recording`, and told to `each` as soon as it is known.
pub(crate) fn of(
    arguments: &Arguments,
    recording: &Recording<'_>,
    progress: &dyn Progress,
    each: &mut dyn FnMut(&Line),
) -> Result<Vec<Line>> {
    let path = &arguments.recording.recording;
    let names = recording.frame_names().to_vec();
    if names.is_empty() {
        bail!("{}: there is no frame in it", path.display());
    }
    let arm = arguments.robot.arm(path, recording)?;
    let shape = EndEffectorShape::of(&arm, &arguments.cache.open())?;
    let mut recognizer = Recognizer::open(&arguments.model, shape.clone())?;
    let mut estimator = PoseEstimator::open(&arguments.model, shape, arguments.method)?;
    estimator.refines = !arguments.no_icp;
    let images = FrameImages::of(recording.source())?;
    let mut lines = Vec::with_capacity(names.len());
    for (index, name) in names.iter().enumerate() {
        progress.advance(index, names.len())?;
        let Some(FrameImage { depth, .. }) = images.read(recording.source(), index)? else {
            lines.push(Line::damaged(name, arguments.method));
            continue;
        };
        let joints = joints(arguments, recording, index)?;
        let posture = joints.as_ref().map(|joints| estimator.shape().posture(joints));
        let seen = recognizer.recognize(&depth, images.camera(), posture.as_slice())?;
        let found = match (arguments.method, arguments.no_icp) {
            (PoseMethod::Fused, false) => seen.answer,
            _ => {
                let label = &seen.segmentation.label;
                estimator.estimate(&depth, images.camera(), label, joints.as_ref())?
            }
        };
        let turn = images.optical_from_camera();
        let line = Line::of(name, arguments.method, joints.is_some(), found, turn);
        each(&line);
        lines.push(line);
    }
    progress.advance(names.len(), names.len())?;
    Ok(lines)
}

fn joints(
    arguments: &Arguments,
    recording: &Recording<'_>,
    index: usize,
) -> Result<Option<JointPositions>> {
    let read = || recording.source().read_joints(index);
    Ok(arguments.joint_states.then(read).transpose()?)
}
