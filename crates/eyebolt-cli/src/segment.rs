//! `eyebolt segment`.

mod cloud;
mod teller;

use crate::ending::Ending;
use crate::inputs::{CacheArguments, RecordingArguments, RobotArguments, use_threads};
use crate::output;
use crate::progress::Counting;
use anyhow::{Result, bail};
use cloud::CloudForm;
use eyebolt::progress::Progress;
use eyebolt::record::FrameImages;
use eyebolt::report::classes;
use eyebolt::segment::{ARM, END_EFFECTOR};
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_recording::{Recording, write_npy};
use std::path::PathBuf;
use teller::Teller;

/// Options of `eyebolt segment`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    recording: RecordingArguments,
    /// Folder of a model that eyebolt train made, such as models/panda
    #[arg(long, value_name = "FOLDER")]
    model: PathBuf,
    #[command(flatten)]
    robot: RobotArguments,
    /// Leave the labels as the networks have them; otherwise the pose of the end-effector that explains them says which
    /// pixels are of it
    #[arg(long)]
    networks_alone: bool,
    /// Folder for label_FRAME.npy: 0 background, 1 arm, 2 end-effector, 255 no depth
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Also write the labelled points of each frame there, as cloud_FRAME.ply or .pcd
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
    let teller = teller(arguments, &recording)?;
    let names = recording.frame_names().to_vec();
    let path = |name: &str| arguments.output.join(format!("label_{name}.npy"));
    let more = More { arguments };
    for name in &names {
        output::refuse_existing(&path(name), arguments.force)?;
        more.refuse_existing(name)?;
    }
    let bar = Counting::new()?;
    let tells_end_effector = teller.tells_end_effector();
    let (mut arm, mut hand) = (0, 0);
    let left_out = of(arguments, teller, &recording, &bar, &mut |frame| {
        let count = |class: u8| frame.label.iter().filter(|label| **label == class).count();
        arm += usize::from(count(ARM) + count(END_EFFECTOR) > 0);
        hand += usize::from(count(END_EFFECTOR) > 0);
        more.write(frame.name, &frame.depth, frame.camera, &frame.label)?;
        let shape = [frame.depth.height() as usize, frame.depth.width() as usize];
        let bytes = write_npy("|u1", &shape, frame.label);
        output::write_whole(&path(frame.name), &bytes, arguments.force)
    })?;
    drop(bar);
    let left_out = left_out.len();
    let (written, folder) = (names.len() - left_out, arguments.output.display());
    let hand = match tells_end_effector {
        true => format!(", the end-effector in {hand}"),
        false => String::new(),
    };
    output::say(&format!("{written} frames written to {folder}: the arm in {arm}{hand}"));
    if left_out > 0 {
        output::complain(&format!("note: {left_out} damaged frames left out"));
    }
    Ok(Ending::Done)
}

/// A frame whose pixels are labelled.
pub(crate) struct Segmented<'a> {
    pub(crate) name: &'a str,
    pub(crate) depth: DepthImage,
    pub(crate) camera: &'a PinholeCamera,
    /// A class for each pixel, row by row.
    pub(crate) label: Vec<u8>,
}

/// The recording that `arguments` name.
pub(crate) fn named(arguments: &Arguments) -> Result<Recording<'static>> {
    arguments.recording.open_of(&arguments.robot)
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
    let camera = images.camera();
    let mut left_out = Vec::new();
    for (index, name) in names.iter().enumerate() {
        progress.advance(index, names.len())?;
        let Some(depth) = images.depth(recording.source(), index)? else {
            left_out.push(name.clone());
            continue;
        };
        let label = teller.label(&depth, camera)?.label;
        each(Segmented { name, depth, camera, label })?;
    }
    progress.advance(names.len(), names.len())?;
    Ok(left_out)
}

/// What is written beside labels.
struct More<'a> {
    arguments: &'a Arguments,
}

impl More<'_> {
    fn cloud(&self, name: &str) -> Option<(CloudForm, PathBuf)> {
        let form = self.arguments.clouds?;
        Some((form, self.arguments.output.join(format!("cloud_{name}.{}", form.ending()))))
    }

    fn picture(&self, name: &str) -> Option<PathBuf> {
        Some(self.arguments.overlay.as_ref()?.join(format!("overlay_{name}.png")))
    }

    fn refuse_existing(&self, name: &str) -> Result<()> {
        let paths = self.cloud(name).map(|(_, path)| path).into_iter().chain(self.picture(name));
        paths.into_iter().try_for_each(|path| output::refuse_existing(&path, self.arguments.force))
    }

    fn write(
        &self,
        name: &str,
        depth: &DepthImage,
        camera: &PinholeCamera,
        label: &[u8],
    ) -> Result<()> {
        if let Some((form, path)) = self.cloud(name) {
            output::write_whole(&path, &form.bytes(depth, camera, label), self.arguments.force)?;
        }
        if let Some(path) = self.picture(name) {
            let picture = classes(depth, label).encode_png();
            output::write_whole(&path, &picture, self.arguments.force)?;
        }
        Ok(())
    }
}
