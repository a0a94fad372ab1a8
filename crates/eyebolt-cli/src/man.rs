//! `eyebolt man`.

use crate::ending::Ending;
use crate::output;
use anyhow::{Result, bail};
use clap::Command;
use clap_mangen::Man;
use std::path::PathBuf;

/// Options of `eyebolt man`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Command whose page is printed; otherwise that of the whole program
    command: Option<String>,
    /// Write the pages of program and commands to this folder, such as ~/.local/share/man/man1
    #[arg(short, long, value_name = "FOLDER", conflicts_with = "command")]
    output: Option<PathBuf>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
}

/// Runs the command; `program` is all of eyebolt.
pub fn run(arguments: &Arguments, program: Command) -> Result<Ending> {
    let mut program = program.disable_help_subcommand(true);
    // Full names of commands are known after that.
    program.build();
    if let Some(folder) = &arguments.output {
        let pages: Vec<&Command> =
            std::iter::once(&program).chain(program.get_subcommands()).collect();
        let paths = pages.iter().map(|page| folder.join(format!("{}.1", name(page))));
        let paths: Vec<PathBuf> = paths.collect();
        paths.iter().try_for_each(|path| output::refuse_existing(path, arguments.force))?;
        for (page, path) in pages.iter().zip(&paths) {
            output::write_whole(path, &render(page)?, arguments.force)?;
        }
        output::say(&format!("{} pages in {}", paths.len(), folder.display()));
        return Ok(Ending::Done);
    }
    let page = match &arguments.command {
        None => &program,
        Some(wanted) => match program.find_subcommand(wanted) {
            Some(command) => command,
            None => bail!("{wanted}: no such command. `eyebolt --help` names all"),
        },
    };
    output::deliver(&render(page)?)?;
    Ok(Ending::Done)
}

/// "eyebolt-calibrate" of `calibrate`.
fn name(page: &Command) -> &str {
    page.get_display_name().unwrap_or(page.get_name())
}

/// The page in roff.
fn render(page: &Command) -> Result<Vec<u8>> {
    let mut text = Vec::new();
    Man::new(page.clone()).render(&mut text)?;
    Ok(text)
}
