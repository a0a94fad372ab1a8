//! `eyebolt segment`.

use crate::ending::Ending;
use crate::inputs::{RecordingArguments, use_threads};
use crate::output;
use crate::progress::Counting;
use anyhow::{Result, bail};
use eyebolt::progress::Progress;
use eyebolt::record::FrameImages;
use eyebolt::segment::{ARM, END_EFFECTOR, Segmenter};
use eyebolt_recording::write_npy;
use std::path::PathBuf;

/// Options of `eyebolt segment`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    recording: RecordingArguments,
    /// Folder of a model that eyebolt train made, such as models/panda
    #[arg(long, value_name = "FOLDER")]
    model: PathBuf,
    /// Folder for label_FRAME.npy: 0 background, 1 arm, 2 end-effector, 255 no depth
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    /// Replace existing files
    #[arg(long)]
    force: bool,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let mut segmenter = Segmenter::open(&arguments.model)?;
    let recording = arguments.recording.open()?;
    let names = recording.frame_names().to_vec();
    let path = |name: &str| arguments.output.join(format!("label_{name}.npy"));
    names.iter().try_for_each(|name| output::refuse_existing(&path(name), arguments.force))?;
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
        let found = segmenter.segment(&depth, images.camera())?;
        let count = |class: u8| found.label.iter().filter(|label| **label == class).count();
        arm += usize::from(count(ARM) + count(END_EFFECTOR) > 0);
        hand += usize::from(count(END_EFFECTOR) > 0);
        let bytes = write_npy("|u1", &[found.height, found.width], found.label);
        output::write_whole(&path(name), &bytes, arguments.force)?;
    }
    drop(bar);
    let (written, folder) = (names.len() - left_out, arguments.output.display());
    let hand = match segmenter.tells_end_effector() {
        true => format!(", the end-effector in {hand}"),
        false => String::new(),
    };
    output::say(&format!("{written} frames written to {folder}: the arm in {arm}{hand}"));
    if left_out > 0 {
        output::complain(&format!("note: {left_out} damaged frames left out"));
    }
    Ok(Ending::Done)
}
