//! `eyebolt calibrate`.

use crate::Ending;
use crate::output::{self, Destination};
use crate::progress::Bar;
use crate::summary;
use anyhow::{Context, Result, bail};
use eyebolt::answer::Answer;
use eyebolt::calibrate::{Deviation, Limits, Verdict};
use eyebolt::pipeline::{self, Outcome, Request};
use eyebolt::progress::{Progress, Step};
use eyebolt::report::overlay;
use eyebolt::session::ImageSource;
use eyebolt_recording::Folder;
use eyebolt_registration::LinkCache;
use eyebolt_render::Raster;
use eyebolt_robot::{Arm, PackageRoots, Robot};
use std::path::{Path, PathBuf};

/// Options of `eyebolt calibrate`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder with a recording.toml, or that file itself
    recording: PathBuf,
    /// Where to write the calibration; a refused one goes to *.rejected.json beside it
    #[arg(short, long, default_value = "calibration.json")]
    output: PathBuf,
    /// Robot description (URDF); otherwise the one that recording.toml names
    #[arg(long, value_name = "URDF")]
    robot: Option<PathBuf>,
    /// Base link; otherwise recording.toml's, or guessed
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// End-effector link; otherwise recording.toml's, or guessed
    #[arg(long, value_name = "LINK")]
    end_effector: Option<String>,
    /// Where package:// leads: a folder of packages, or NAME=FOLDER; may be repeated.
    /// ROS_PACKAGE_PATH and AMENT_PREFIX_PATH are searched too
    #[arg(long, value_name = "[NAME=]FOLDER")]
    package_path: Vec<String>,
    /// Find the arm's pixels by what moved, even if the recording has masks
    #[arg(long)]
    no_masks: bool,
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
    /// Where the shapes of links are kept between runs [default: eyebolt in the user's cache folder]
    #[arg(long, value_name = "FOLDER", conflicts_with = "no_cache")]
    cache: Option<PathBuf>,
    /// Keep nothing between runs
    #[arg(long)]
    no_cache: bool,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("must be a number above 0".to_owned()),
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    if let Some(threads) = arguments.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads));
        pool.build_global().context("cannot start the threads")?;
    }
    let destination = Destination::new(&arguments.output, arguments.force)?;
    let bar = Bar::new();
    let recording = Folder::open(&arguments.recording)?;
    if let Some(folder) = &arguments.save_overlay {
        check_overlays(folder, &recording, arguments.force)?;
    }
    let arm = arm(arguments, &recording)?;
    let cache = cache(arguments);
    let request = Request {
        recording: &recording,
        arm: &arm,
        cache: &cache,
        use_masks: !arguments.no_masks,
        limits: limits(arguments),
        seed: arguments.seed,
    };
    let outcome = pipeline::run(&request, &bar)?;
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

/// The arm that the flags name, else the one that the recording names.
fn arm(arguments: &Arguments, recording: &Folder) -> Result<Arm> {
    let section = recording.robot();
    let Some(urdf) = arguments.robot.as_ref().or(section.urdf.as_ref()) else {
        let given = &arguments.recording;
        let file = if given.is_dir() { given.join("recording.toml") } else { given.clone() };
        bail!(
            "{}: robot.urdf: no robot description is named. Add [robot] urdf = \"...\" or give \
             --robot arm.urdf",
            file.display()
        );
    };
    let robot = Robot::from_urdf_file(urdf, &packages(&arguments.package_path))?;
    // The recording's links are those of the robot it names, not of another given instead.
    let other = arguments.robot.is_some();
    let known = |link: &&String| !other || robot.link_index(link).is_some();
    let base = arguments.base.as_ref().or(section.base.as_ref().filter(known));
    let hand = arguments.end_effector.as_ref().or(section.end_effector.as_ref().filter(known));
    Ok(robot.arm(base.map(String::as_str), hand.map(String::as_str))?)
}

/// The packages that flags name, then those that the environment does.
pub fn packages(flags: &[String]) -> PackageRoots {
    let variable = |name| std::env::var(name).ok();
    let (ros, ament) = (variable("ROS_PACKAGE_PATH"), variable("AMENT_PREFIX_PATH"));
    let environment = PackageRoots::from_environment(ros.as_deref(), ament.as_deref());
    let named = flags.iter().fold(PackageRoots::new(), |roots, flag| roots.with_argument(flag));
    named.then(environment)
}

fn cache(arguments: &Arguments) -> LinkCache {
    if arguments.no_cache {
        return LinkCache::disabled();
    }
    let variable = |name| std::env::var_os(name).filter(|value| !value.is_empty());
    let user = || {
        let own = variable("XDG_CACHE_HOME").map(PathBuf::from);
        let home = || variable("HOME").map(|home| Path::new(&home).join(".cache"));
        own.or_else(home).map(|folder| folder.join("eyebolt"))
    };
    arguments.cache.clone().or_else(user).map_or(LinkCache::disabled(), LinkCache::new)
}

/// Better told now than after the work: pictures that are in the way, or a folder that is none.
fn check_overlays(folder: &Path, recording: &Folder, force: bool) -> Result<()> {
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
    recording: &Folder,
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
