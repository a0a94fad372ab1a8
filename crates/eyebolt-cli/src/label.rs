//! `eyebolt label`.

mod arguments;
mod calibrated;
mod one;
mod told;

use crate::ending::Ending;
use crate::front::{Front, Terminal};
use crate::inputs::use_threads;
use crate::output;
use anyhow::{Result, bail};
pub use arguments::Arguments;
use eyebolt::dataset::{Merged, merge};
use one::Labelling;
use std::path::Path;
pub(crate) use told::Told;

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
    let mut ending = Ending::Done;
    each(arguments, None, &Terminal, &mut |recording, told| match told {
        Told::Labelled(labelled) if arguments.json => output::say(&labelled.json()),
        Told::Labelled(labelled) => output::say(&labelled.text()),
        Told::Refused(reasons) => {
            // What of other recordings is good stays good.
            ending = Ending::Refused;
            output::complain(&told::refused(recording, &reasons));
        }
    })?;
    Ok(ending)
}

/// Labels the recordings that `arguments` name, by `calibration` (name and text) in place of the one that they do; what
/// became of each is told to `each`.
pub(crate) fn each(
    arguments: &Arguments,
    calibration: Option<(String, String)>,
    front: &dyn Front,
    each: &mut dyn FnMut(&Path, Told),
) -> Result<()> {
    let Some(folder) = &arguments.output else { bail!("--output: name the folder of a data set") };
    check_folder(folder)?;
    let labelling = Labelling::new(arguments, folder, calibration, front)?;
    for recording in &arguments.recordings {
        each(recording, labelling.label(recording)?);
    }
    Ok(())
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
