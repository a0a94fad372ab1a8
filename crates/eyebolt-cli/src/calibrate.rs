//! `eyebolt calibrate`.

use crate::Ending;
use crate::inputs::{CacheArguments, RecordingArguments, RobotArguments, positive, use_threads};
use crate::output::{self, Destination};
use crate::progress::Bar;
use crate::summary;
use anyhow::{Result, bail};
use eyebolt::answer::Answer;
use eyebolt::calibrate::{Deviation, Limits, Verdict};
use eyebolt::pipeline::{self, Outcome, Request};
use eyebolt::progress::{Progress, Step};
use eyebolt::record::{RecordError, RecordOptions};
use eyebolt::report::overlay;
use eyebolt::session::ImageSource;
use eyebolt_recording::Recording;
use eyebolt_render::Raster;
use std::path::{Path, PathBuf};

/// Options of `eyebolt calibrate`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    recording: RecordingArguments,
    /// Where to write the calibration; a refused one goes to *.rejected.json beside it
    #[arg(short, long, default_value = "calibration.json")]
    output: PathBuf,
    #[command(flatten)]
    robot: RobotArguments,
    /// Find the arm's pixels by what moved, even if the recording has masks
    #[arg(long)]
    no_masks: bool,
    /// Of more configurations, use those that differ most; time grows with the square
    #[arg(long, value_name = "COUNT", default_value_t = 30, value_parser = clap::value_parser!(u16).range(3..))]
    max_configurations: u16,
    /// Draw the posed arm over each frame, as PNG files in this folder
    #[arg(long, value_name = "FOLDER")]
    save_overlay: Option<PathBuf>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
    /// Expected error up to which an answer is trusted, millimetres [default: 20]
    #[arg(long, value_name = "MM", value_parser = positive)]
    max_error_mm: Option<f64>,
    /// Expected error up to which an answer is trusted, degrees [default: 1.2]
    #[arg(long, value_name = "DEG", value_parser = positive)]
    max_error_deg: Option<f64>,
    /// Seed of the search; the same seed gives the same bytes on any number of threads
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Add the milliseconds of each stage to the calibration
    #[arg(long)]
    timing: bool,
    #[command(flatten)]
    cache: CacheArguments,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let destination = Destination::new(&arguments.output, arguments.force)?;
    let bar = Bar::new();
    let recording = arguments.recording.open()?;
    if let Some(folder) = &arguments.save_overlay {
        check_overlays(folder, &recording, arguments.force)?;
    }
    let arm = arguments.robot.arm(&arguments.recording.recording, &recording)?;
    let cache = arguments.cache.open();
    let request = Request {
        recording: &recording,
        arm: &arm,
        cache: &cache,
        options: RecordOptions {
            use_masks: !arguments.no_masks,
            most_configurations: usize::from(arguments.max_configurations),
        },
        limits: limits(arguments),
        seed: arguments.seed,
    };
    let outcome = pipeline::run(&request, &bar)
        .map_err(|error| named(error, &arguments.recording.recording))?;
    bar.begin(Step::Report);
    let pictures = match &arguments.save_overlay {
        Some(folder) => save_overlays(folder, &recording, &outcome, arguments.force),
        None => Ok(Vec::new()),
    };
    let timing = bar.finish();
    let mut answer = Answer::new(&request, &outcome);
    answer.timing_ms = arguments.timing.then_some(timing);
    let trusted = outcome.calibration.verdict == Verdict::Trusted;
    let path = destination.write(trusted, answer.to_json().as_bytes())?;
    // A picture that could not be written must not cost the calibration.
    output::say(&summary::text(&answer, &path, pictures.as_deref().unwrap_or_default()));
    pictures?;
    Ok(if trusted { Ending::Done } else { Ending::Refused })
}

/// The error, with the recording where that is what does not fit and the error names no file.
fn named(error: RecordError, recording: &Path) -> anyhow::Error {
    let in_frame = matches!(
        error,
        RecordError::Kinematics { .. }
            | RecordError::MaskSize { .. }
            | RecordError::Projection { .. }
    );
    match in_frame {
        true => anyhow::Error::new(error).context(recording.display().to_string()),
        false => error.into(),
    }
}

fn limits(arguments: &Arguments) -> Limits {
    let default = Limits::default();
    let expected = Deviation {
        translation_m: arguments
            .max_error_mm
            .map_or(default.expected.translation_m, |mm| 1e-3 * mm),
        rotation_rad: arguments
            .max_error_deg
            .map_or(default.expected.rotation_rad, f64::to_radians),
    };
    Limits { expected, ..default }
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

/// Draws every configuration; the paths of the pictures.
fn save_overlays(
    folder: &Path,
    recording: &Recording,
    outcome: &Outcome,
    force: bool,
) -> Result<Vec<PathBuf>> {
    let (Some(session), Some(refinement)) = (&outcome.session, &outcome.calibration.refinement)
    else {
        return Ok(Vec::new());
    };
    let mut raster = Raster::new(&session.camera);
    let mut paths = Vec::new();
    for configuration in &session.configurations {
        let name = &configuration.frames[0];
        let index = recording.frame_names().iter().position(|other| other == name);
        let color = index.map(|index| recording.read_color(index)).transpose();
        // A colour image of another camera, or none: the depth image serves as well.
        let color = color.unwrap_or_else(|error| {
            output::complain(&format!("note: {error}; drawn over the depth image instead"));
            None
        });
        let color = color.flatten().filter(|_| session.source != ImageSource::DrawnClouds);
        let pose = &refinement.camera_from_base;
        let picture = overlay(session, configuration, &mut raster, pose, color.as_ref());
        let path = overlay_path(folder, name);
        output::write_whole(&path, &picture.encode_png(), force)?;
        paths.push(path);
    }
    Ok(paths)
}
