//! `eyebolt label`.

mod calibrated;
mod one;
mod told;

use crate::ending::Ending;
use crate::inputs::{BagArguments, CacheArguments, RobotArguments, use_threads};
use crate::output;
use anyhow::{Result, bail};
use eyebolt::dataset::{Merged, Shard, merge};
use one::Labelling;
use std::path::{Path, PathBuf};
use told::Told;

/// Options of `eyebolt label`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Recordings: folders with a recording.toml, or bags
    #[arg(required_unless_present = "merge")]
    recordings: Vec<PathBuf>,
    /// Folder of the data set; frames are added to those of a data set that is there
    #[arg(short, long, value_name = "FOLDER", required_unless_present = "merge")]
    output: Option<PathBuf>,
    /// Label by this calibration, of the same camera in the same place; otherwise each recording is
    /// calibrated from nothing, and not labelled if that is refused
    #[arg(long, value_name = "JSON")]
    calibration: Option<PathBuf>,
    /// Draw each frame that is labelled, with classes, box and keypoints, as PNG files in this folder
    #[arg(long, value_name = "FOLDER")]
    check: Option<PathBuf>,
    /// Label only shard I of N, counted from 0, of the frames of all recordings: one for each machine
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Join the shards in this folder, if all of them are there, into one data set
    #[arg(
        long,
        value_name = "FOLDER",
        conflicts_with_all = ["recordings", "output", "calibration", "check", "shard"]
    )]
    merge: Option<PathBuf>,
    #[command(flatten)]
    robot: RobotArguments,
    /// Find the arm's pixels without the recordings' masks
    #[arg(long)]
    no_masks: bool,
    /// Seed of the search; the same seed gives the same bytes on any number of threads
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Threads to use; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Say what was labelled as JSON, a line for each recording
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    cache: CacheArguments,
    #[command(flatten)]
    bag: BagArguments,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    if let Some(folder) = &arguments.merge {
        let Merged { recordings, labelled, left_out } = merge(folder)?;
        output::say(&format!(
            "{}: {labelled} labelled frames of {recordings} recordings, {left_out} left out",
            folder.display()
        ));
        return Ok(Ending::Done);
    }
    let Some(folder) = &arguments.output else { bail!("--output: name the folder of a data set") };
    check_folder(folder)?;
    let labelling = Labelling::new(arguments, folder)?;
    let mut ending = Ending::Done;
    for recording in &arguments.recordings {
        match labelling.label(recording)? {
            Told::Labelled(labelled) if arguments.json => output::say(&labelled.json()),
            Told::Labelled(labelled) => output::say(&labelled.text()),
            Told::Refused(reasons) => {
                // What of other recordings is good stays good.
                ending = Ending::Refused;
                output::complain(&told::refused(recording, &reasons));
            }
        }
    }
    Ok(ending)
}

/// Better told now than after the work: a place where no data set can be.
fn check_folder(folder: &Path) -> Result<()> {
    if !folder.exists() {
        return Ok(());
    }
    let Ok(mut entries) = std::fs::read_dir(folder) else {
        bail!("{}: --output: not a folder. Name one", folder.display());
    };
    if entries.next().is_some() && !folder.join("dataset.toml").is_file() {
        bail!(
            "{}: --output: there are other things than a data set in it. Name another folder",
            folder.display()
        );
    }
    Ok(())
}
