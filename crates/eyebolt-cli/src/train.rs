//! `eyebolt train`.

mod arguments;
mod folder;
mod lessons;

pub use arguments::Arguments;

use crate::ending::Ending;
use crate::front::{Front, Terminal};
use crate::inputs::use_threads;
use crate::output;
use crate::shell::quoted;
use anyhow::Result;

/// Teaches all networks that `arguments` ask for; their names.
pub(crate) fn taught(arguments: &Arguments, front: &dyn Front) -> Result<Vec<&'static str>> {
    let kinds = arguments.kinds()?;
    let parts = front.parts()?;
    for kind in kinds {
        lessons::teach(arguments, *kind, front, parts.as_ref())?;
    }
    Ok(kinds.iter().map(|kind| kind.name()).collect())
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    taught(arguments, &Terminal)?;
    let path = quoted(&arguments.output.display().to_string());
    output::say(&format!("\nuse it:\n  eyebolt segment RECORDING --model {path} -o labels/"));
    Ok(Ending::Done)
}
