//! `eyebolt completions`.

use crate::ending::Ending;
use crate::output;
use anyhow::Result;
use clap::Command;
use clap_complete::{Shell, generate};

/// Options of `eyebolt completions`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Shell that completes
    #[arg(value_enum)]
    shell: Shell,
}

/// Runs the command; `program` is all of eyebolt.
pub fn run(arguments: &Arguments, mut program: Command) -> Result<Ending> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut program, "eyebolt", &mut script);
    output::deliver(&script)?;
    Ok(Ending::Done)
}
