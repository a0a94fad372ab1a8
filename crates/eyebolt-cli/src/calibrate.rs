//! `eyebolt calibrate`.

pub mod learned;
mod limits;
mod marker;
mod viewer;
mod way;

use crate::ending::Ending;
use crate::front::{Front, Terminal};
use crate::inputs::{RecordingArguments, RobotArguments, use_threads};
use crate::names;
use crate::output::{self, Destination, STDOUT};
use crate::progress::{Bar, leaves};
use crate::summary;
use anyhow::{Result, bail};
use eyebolt::answer::Answer;
use eyebolt::calibrate::Verdict;
use eyebolt::observations::Configuration;
use eyebolt::pipeline::{Failure, Outcome, Request};
use eyebolt::progress::{Progress, Step};
use eyebolt::record::RecordError;
use eyebolt::report::{Context, Picture, html, overlays};
use eyebolt_recording::Recording;
use learned::LearnedArguments;
pub use limits::LimitArguments;
use std::path::{Path, PathBuf};
pub(crate) use viewer::bytes as viewer_bytes;
pub use way::WayArguments;

/// Options of `eyebolt calibrate`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    recording: RecordingArguments,
    /// Where to write the calibration; a refused one goes to *.rejected.json beside it. With -, either
    /// goes to standard output, and what is said of it to standard error
    #[arg(short, long, default_value = "calibration.json")]
    output: PathBuf,
    #[command(flatten)]
    robot: RobotArguments,
    #[command(flatten)]
    way: WayArguments,
    /// Draw the posed arm over each frame, as PNG files in this folder
    #[arg(long, value_name = "FOLDER")]
    save_overlay: Option<PathBuf>,
    /// Write a page for a browser, complete in one file: verdict, transform, what is left over,
    /// pictures, and the clouds with the robot to turn about
    #[arg(long, value_name = "HTML")]
    report: Option<PathBuf>,
    /// Write what Foxglove, Lichtblick and (by `ros2 bag play`) RViz show: the posed robot, points coloured by how far they lie
    /// from it, outlines and transforms; a layout for the first two goes beside it, to *.layout.json
    #[arg(long, value_name = "MCAP")]
    viewer_mcap: Option<PathBuf>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Add the milliseconds of each stage to the calibration
    #[arg(long)]
    timing: bool,
    #[command(flatten)]
    marker: marker::MarkerArguments,
}

impl Arguments {
    /// Of a recording that this program made, everything that has no flag elsewhere by default.
    #[cfg(feature = "live")]
    pub(crate) fn of_session(
        (recording, robot): (RecordingArguments, RobotArguments),
        (output, report): (PathBuf, Option<PathBuf>),
        way: WayArguments,
        force: bool,
    ) -> Self {
        Self {
            recording,
            output,
            robot,
            way,
            save_overlay: None,
            report,
            viewer_mcap: None,
            force,
            threads: None,
            timing: false,
            marker: marker::MarkerArguments::default(),
        }
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let destination = Destination::new(&arguments.output, arguments.force)?;
    leaves("nothing was written".to_owned())?;
    let bar = Bar::new();
    let recording = arguments.recording.open_of(&arguments.robot)?;
    if let Some(folder) = &arguments.save_overlay {
        check_overlays(folder, &recording, arguments.force)?;
    }
    if let Some(report) = &arguments.report {
        check_report(report, &destination, arguments.force)?;
    }
    if let Some(viewer) = &arguments.viewer_mcap {
        let source = &arguments.recording.recording;
        viewer::check(viewer, source, &recording, &destination, arguments.force)?;
    }
    let arm = arguments.robot.arm(&arguments.recording.recording, &recording)?;
    let recording = arguments.robot.noted(recording, &arm)?;
    let request = arguments.way.request(&recording, &arm);
    if let Some(target) = &arguments.marker.marker {
        let path = &arguments.recording.recording;
        return marker::run(&arguments.marker, target, &request, path, &destination, &bar);
    }
    let outcome = outcome(&arguments.way.learned, &arguments.recording.recording, &request, &bar)?;
    Step::Report.begin(&bar)?;
    let pictures = draw(arguments, &recording, &outcome);
    let saved = match &arguments.save_overlay {
        Some(folder) => save_overlays(folder, &outcome, &pictures, arguments.force),
        None => Ok(Vec::new()),
    };
    let timing = bar.finish();
    let mut answer = answer(&arguments.robot, &request, &outcome);
    answer.timing_ms = arguments.timing.then_some(timing);
    let trusted = outcome.calibration.verdict == Verdict::Trusted;
    let path = destination.write(trusted, answer.to_json().as_bytes())?;
    let report = save_report(arguments, &answer, &outcome, &pictures);
    let viewer = save_viewer(arguments, &recording, &answer, &outcome, &pictures);
    // A picture or a page that could not be written must not cost the calibration.
    let written = arguments.report.as_deref().filter(|_| report.is_ok());
    let verdict = &outcome.calibration.verdict;
    let saved_paths = saved.as_deref().unwrap_or_default();
    let mut summary = summary::text(&answer, verdict, &path, saved_paths, written);
    summary += viewer.as_deref().unwrap_or_default();
    // Standard output has the calibration, if that was asked for.
    if path == Path::new(STDOUT) {
        output::complain(&summary)
    } else {
        output::say(&summary)
    }
    saved.and(report).and(viewer)?;
    Ok(if trusted { Ending::Done } else { Ending::Refused })
}

/// Calibrates the recording that `arguments` name.
pub(crate) fn of_named(
    arguments: &Arguments,
    progress: &dyn Progress,
) -> Result<(Answer, Outcome)> {
    of(arguments, arguments.recording.open_of(&arguments.robot)?, progress)
}

/// Calibrates `recording`, whatever `arguments` name.
pub(crate) fn of(
    arguments: &Arguments,
    recording: Recording<'_>,
    progress: &dyn Progress,
) -> Result<(Answer, Outcome)> {
    let path = &arguments.recording.recording;
    let arm = arguments.robot.arm(path, &recording)?;
    let recording = arguments.robot.noted(recording, &arm)?;
    let request = arguments.way.request(&recording, &arm);
    let outcome = outcome(&arguments.way.learned, path, &request, progress)?;
    Ok((answer(&arguments.robot, &request, &outcome), outcome))
}

/// Every configuration of the recording that `arguments` name with the posed arm over it.
pub(crate) fn pictures_of_named(
    arguments: &Arguments,
    outcome: &Outcome,
    front: &dyn Front,
) -> Result<Vec<Picture>> {
    let recording = arguments.recording.open_of(&arguments.robot)?;
    Ok(pictures(&recording, outcome, front))
}

/// What viewers show of the recording that `arguments` name, and a layout of it; `None` without a pose.
pub(crate) fn viewer_of_named(
    arguments: &Arguments,
    answer: &Answer,
    outcome: &Outcome,
    front: &dyn Front,
) -> Result<Option<(Vec<u8>, String)>> {
    let recording = arguments.recording.open_of(&arguments.robot)?;
    let pictures = pictures(&recording, outcome, front);
    viewer_bytes(answer, outcome, viewer::stamps(&recording, outcome), &pictures)
}

/// Calibrates the recording at `path` by the way that is asked for; errors say which recording it was.
pub(crate) fn outcome(
    arguments: &LearnedArguments,
    path: &Path,
    request: &Request<'_>,
    progress: &dyn Progress,
) -> Result<Outcome> {
    let outcome = learned::calibrate(arguments, path, request, progress);
    outcome.map_err(|error| match error.downcast() {
        Ok(failure) => named(failure, path),
        Err(other) => other,
    })
}

/// The error, with the recording where that is what does not fit and the error names no file.
pub(crate) fn named(error: Failure, recording: &Path) -> anyhow::Error {
    let in_frame = matches!(
        error,
        Failure::Record(
            RecordError::Kinematics { .. }
                | RecordError::JointsNotTold { .. }
                | RecordError::MaskSize { .. }
                | RecordError::ImageSize { .. }
                | RecordError::NoFrames
                | RecordError::NeverAtRest
                | RecordError::Projection { .. }
        )
    );
    match in_frame {
        true => anyhow::Error::new(error).context(recording.display().to_string()),
        false => error.into(),
    }
}

/// What the file says of `outcome`, and of the flags that led to it.
pub(crate) fn answer(robot: &RobotArguments, request: &Request<'_>, outcome: &Outcome) -> Answer {
    let mut answer = Answer::new(request, outcome);
    answer.stated_joints = robot.stated_joints().collect();
    for part in &mut answer.left_out {
        *part = names::in_flags(part);
    }
    answer
}

/// Better told now than after the work: pictures that are in the way, or a folder that is none.
fn check_overlays(folder: &Path, recording: &Recording, force: bool) -> Result<()> {
    if folder.exists() && !folder.is_dir() {
        bail!("{}: --save-overlay: not a folder. Name one", folder.display());
    }
    let mut paths = recording.frame_names().iter().map(|name| overlay_path(folder, name));
    paths.try_for_each(|path| output::refuse_existing(&path, force))
}

fn overlay_path(folder: &Path, frame: &str) -> PathBuf {
    folder.join(format!("overlay_{frame}.png"))
}

/// The page goes where nothing else of this run does.
fn check_report(report: &Path, destination: &Destination, force: bool) -> Result<()> {
    if report.is_dir() {
        bail!("{}: --report: this is a folder. Name a file in it", report.display());
    }
    if destination.is(report) {
        bail!("{}: --report: the calibration goes there. Name another file", report.display());
    }
    let ending = report.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    if !["html", "htm"].contains(&ending.to_ascii_lowercase().as_str()) {
        bail!(
            "{}: --report: a page for browsers. Name a file that ends in .html",
            report.display()
        );
    }
    output::refuse_existing(report, force)
}

/// Every configuration with the posed arm over it, if anybody wants them.
fn draw(arguments: &Arguments, recording: &Recording, outcome: &Outcome) -> Vec<Picture> {
    let wanted = [&arguments.save_overlay, &arguments.report, &arguments.viewer_mcap];
    match wanted.iter().any(|path| path.is_some()) {
        true => pictures(recording, outcome, &Terminal),
        false => Vec::new(),
    }
}

/// Every configuration with the posed arm over it.
pub(crate) fn pictures(
    recording: &Recording<'_>,
    outcome: &Outcome,
    front: &dyn Front,
) -> Vec<Picture> {
    let color = |configuration: &Configuration| {
        let first = configuration.frames.first()?;
        let index = recording.frame_names().iter().position(|name| name == first)?;
        // A colour image of another camera, or none: the depth image serves as well.
        recording.read_color(index).unwrap_or_else(|error| {
            let error = names::in_flags(&error.to_string());
            front.note(&format!("{error}; drawn over the depth image instead"));
            None
        })
    };
    overlays(outcome, color).collect()
}

/// Writes the pictures of all configurations; their paths.
fn save_overlays(
    folder: &Path,
    outcome: &Outcome,
    pictures: &[Picture],
    force: bool,
) -> Result<Vec<PathBuf>> {
    let configurations =
        outcome.observations.iter().flat_map(|observations| &observations.configurations);
    let named = configurations.zip(pictures).map(|(configuration, picture)| {
        let path = overlay_path(folder, &configuration.frames[0]);
        output::write_whole(&path, &picture.encode_png(), force)?;
        Ok(path)
    });
    named.collect()
}

fn save_report(
    arguments: &Arguments,
    answer: &Answer,
    outcome: &Outcome,
    pictures: &[Picture],
) -> Result<()> {
    let Some(path) = &arguments.report else { return Ok(()) };
    let recording = arguments.recording.recording.display().to_string();
    let page = page(&recording, answer, outcome, pictures);
    output::write_whole(path, page.as_bytes(), arguments.force)
}

/// Writes what viewers show, if that was asked for; what to say of it.
fn save_viewer(
    arguments: &Arguments,
    recording: &Recording<'_>,
    answer: &Answer,
    outcome: &Outcome,
    pictures: &[Picture],
) -> Result<String> {
    let Some(path) = &arguments.viewer_mcap else { return Ok(String::new()) };
    let made_of = viewer::MadeOf { recording, answer, outcome, pictures };
    viewer::save(path, &made_of, arguments.force)
}

/// The page on `answer`.
pub(crate) fn page(
    recording: &str,
    answer: &Answer,
    outcome: &Outcome,
    pictures: &[Picture],
) -> String {
    let context = Context { recording, pictures, call_input: names::flag, ..Context::default() };
    html(answer, outcome, &context)
}
