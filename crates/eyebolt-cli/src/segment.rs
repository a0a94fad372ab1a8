//! `eyebolt segment`.

mod cloud;
mod destination;
mod folder;
mod mcap;
mod npz;
mod segmented;
mod teller;

use crate::ending::Ending;
use crate::inputs::{CacheArguments, RecordingArguments, RobotArguments, model_files, use_threads};
use crate::output;
use crate::progress::Counting;
use anyhow::{Result, bail};
use cloud::CloudForm;
use destination::Destination;
use eyebolt::model_files::ModelFiles;
use eyebolt::progress::Progress;
use eyebolt::record::FrameImages;
use eyebolt::report::classes;
use eyebolt::segment::{ARM, END_EFFECTOR};
use eyebolt_recording::{Recording, counted};
pub(crate) use segmented::Segmented;
use std::path::PathBuf;
use teller::Teller;

/// Options of `eyebolt segment`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    recording: RecordingArguments,
    /// Model that eyebolt train made: its folder, or one that comes with the program (any-arm, panda, shackle)
    #[arg(long, value_name = "MODEL", value_parser = model_files())]
    model: ModelFiles,
    #[command(flatten)]
    robot: RobotArguments,
    /// Leave the labels as the networks have them; otherwise the pose of the end-effector that explains them says which
    /// pixels are of it
    #[arg(long)]
    networks_alone: bool,
    /// Folder for label_FRAME.npy: 0 background, 1 arm, 2 end-effector, 255 no depth; or one file: labelled points as .mcap for
    /// Foxglove and RViz, all labels and their probabilities as .npz, the points of a single frame as .ply or .pcd
    #[arg(short, long, value_name = "FOLDER|FILE")]
    output: PathBuf,
    /// Also write the labelled points of each frame into the folder, as cloud_FRAME.ply or .pcd
    #[arg(long, value_enum, value_name = "FORM")]
    clouds: Option<CloudForm>,
    /// Draw each frame with the arm in blue and its end-effector in yellow, as PNG files in this folder
    #[arg(long, value_name = "FOLDER")]
    overlay: Option<PathBuf>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    cache: CacheArguments,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let recording = named(arguments)?;
    let names = recording.frame_names();
    let to = Destination::of(&arguments.output, arguments.clouds, names)?;
    to.refuse_existing(names, arguments.force)?;
    names
        .iter()
        .filter_map(|name| picture(arguments, name))
        .try_for_each(|path| output::refuse_existing(&path, arguments.force))?;
    let mut teller = teller(arguments, &recording)?;
    if to.tells_probability() {
        teller = teller.with_probabilities();
    }
    let tells_end_effector = teller.tells_end_effector();
    let bar = Counting::new()?;
    let mut seen = Seen::default();
    to.fill(&recording, arguments.force, |sink| {
        seen.damaged = of(arguments, teller, &recording, &bar, &mut |frame| {
            seen.count(&frame);
            if let Some(path) = picture(arguments, frame.name) {
                let drawn = classes(&frame.image.depth, &frame.found.label).encode_png();
                output::write_whole(&path, &drawn, arguments.force)?;
            }
            sink.frame(&frame)
        })?
        .len();
        Ok(())
    })?;
    drop(bar);
    output::say(&seen.text(&to.path().display().to_string(), tells_end_effector));
    if seen.damaged > 0 {
        output::complain(&format!("note: {} left out", counted(seen.damaged, "damaged frame")));
    }
    Ok(Ending::Done)
}

fn picture(arguments: &Arguments, name: &str) -> Option<PathBuf> {
    Some(arguments.overlay.as_ref()?.join(format!("overlay_{name}.png")))
}

/// In how many frames what was seen.
#[derive(Default)]
struct Seen {
    frames: usize,
    arm: usize,
    end_effector: usize,
    damaged: usize,
}

impl Seen {
    fn count(&mut self, frame: &Segmented<'_>) {
        let label = &frame.found.label;
        self.frames += 1;
        self.arm += usize::from(label.iter().any(|label| [ARM, END_EFFECTOR].contains(label)));
        self.end_effector += usize::from(label.contains(&END_EFFECTOR));
    }

    fn text(&self, path: &str, tells_end_effector: bool) -> String {
        let hand = match tells_end_effector {
            true => format!(", the end-effector in {}", self.end_effector),
            false => String::new(),
        };
        format!(
            "{} written to {path}: the arm in {}{hand}",
            counted(self.frames, "frame"),
            self.arm
        )
    }
}

/// The recording that `arguments` name.
pub(crate) fn named(arguments: &Arguments) -> Result<Recording<'static>> {
    arguments.recording.open_or_cloud(&arguments.robot)
}

/// The model that `arguments` name, for the robot that they or `recording` name.
pub(crate) fn teller(arguments: &Arguments, recording: &Recording<'_>) -> Result<Teller> {
    arguments.robot.check_named()?;
    if arguments.networks_alone {
        return Teller::networks(&arguments.model);
    }
    let arm = arguments.robot.arm(&arguments.recording.recording, recording);
    Teller::posed(&arguments.model, arm, &arguments.cache.open())
}

/// Hands each frame of `recording` to `each`; names of damaged ones, which are left out.
pub(crate) fn of(
    arguments: &Arguments,
    mut teller: Teller,
    recording: &Recording<'_>,
    progress: &dyn Progress,
    each: &mut dyn FnMut(Segmented<'_>) -> Result<()>,
) -> Result<Vec<String>> {
    let names = recording.frame_names();
    if names.is_empty() {
        bail!("{}: there is no frame in it", arguments.recording.recording.display());
    }
    let images = FrameImages::of(recording.source())?;
    let mut left_out = Vec::new();
    for (index, name) in names.iter().enumerate() {
        progress.advance(index, names.len())?;
        let Some(image) = images.read(recording.source(), index)? else {
            left_out.push(name.clone());
            continue;
        };
        let found = teller.label(&image.depth, images.camera())?;
        each(Segmented { index, name, images: &images, image, found })?;
    }
    progress.advance(names.len(), names.len())?;
    Ok(left_out)
}
