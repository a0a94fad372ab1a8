//! `eyebolt train`.

mod arguments;
mod folder;
mod lessons;

pub use arguments::Arguments;

use crate::ending::Ending;
use crate::inputs::use_threads;
use crate::output;
use crate::progress::Counting;
use crate::shell::quoted;
use anyhow::Result;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let kinds = arguments.kinds()?;
    let bar = Counting::new()?;
    for kind in kinds {
        lessons::teach(arguments, *kind, &bar)?;
    }
    drop(bar);
    let path = quoted(&arguments.output.display().to_string());
    output::say(&format!("\nuse it:\n  eyebolt segment RECORDING --model {path} -o labels/"));
    Ok(Ending::Done)
}
