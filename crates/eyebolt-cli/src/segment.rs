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
    let recording = arguments.recording.open_of(&arguments.robot)?;
    let mut teller = teller(arguments, &recording)?;
    let names = recording.frame_names().to_vec();
    let path = |name: &str| arguments.output.join(format!("label_{name}.npy"));
    let more = More { arguments };
    for name in &names {
        output::refuse_existing(&path(name), arguments.force)?;
        more.refuse_existing(name)?;
    }
    if names.is_empty() {
        bail!("{}: there is no frame in it", arguments.recording.recording.display());
    }
    let images = FrameImages::of(recording.source())?;
    let bar = Counting::new()?;
    let (mut arm, mut hand, mut left_out) = (0, 0, 0);
    for (index, name) in names.iter().enumerate() {
        bar.advance(index, names.len())?;
        let Some(depth) = images.depth(recording.source(), index)? else {
            left_out += 1;
            continue;
        };
        let found = teller.label(&depth, images.camera())?;
        let count = |class: u8| found.label.iter().filter(|label| **label == class).count();
        arm += usize::from(count(ARM) + count(END_EFFECTOR) > 0);
        hand += usize::from(count(END_EFFECTOR) > 0);
        more.write(name, &depth, images.camera(), &found.label)?;
        let bytes = write_npy("|u1", &[found.height, found.width], found.label);
        output::write_whole(&path(name), &bytes, arguments.force)?;
    }
    drop(bar);
    let (written, folder) = (names.len() - left_out, arguments.output.display());
    let hand = match teller.tells_end_effector() {
        true => format!(", the end-effector in {hand}"),
        false => String::new(),
    };
    output::say(&format!("{written} frames written to {folder}: the arm in {arm}{hand}"));
    if left_out > 0 {
        output::complain(&format!("note: {left_out} damaged frames left out"));
    }
    Ok(Ending::Done)
}

fn teller(arguments: &Arguments, recording: &Recording) -> Result<Teller> {
    arguments.robot.check_named()?;
    if arguments.networks_alone {
        return Teller::networks(&arguments.model);
    }
    let arm = arguments.robot.arm(&arguments.recording.recording, recording);
    Teller::posed(&arguments.model, arm, &arguments.cache.open())
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
