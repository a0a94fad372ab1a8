//! `eyebolt reproduce`.

mod arguments;
mod steps;

use crate::ending::Ending;
use crate::output;
use crate::shell::quoted;
use anyhow::{Context, Result, bail};
pub use arguments::Arguments;
use std::ffi::OsString;
use std::process::Command;
use std::time::Instant;
use steps::{Step, steps};

/// Runs the command; `program` are the words that run this program.
pub fn run(arguments: &Arguments, program: &[OsString]) -> Result<Ending> {
    let folder = &arguments.output;
    let steps = steps(arguments);
    for part in ["recordings", "datasets", "models"] {
        let path = folder.join(part);
        std::fs::create_dir_all(&path).with_context(|| {
            format!("{}: cannot make it. Name another --output", path.display())
        })?;
    }
    let (program, first) = program.split_first().context("this program cannot be found")?;
    let count = steps.len();
    for (number, step) in steps.iter().enumerate() {
        let Step { about, product, arguments } = step;
        let head = format!("{} of {count}: {about}", number + 1);
        if product.exists() {
            output::say(&format!("{head}: there already"));
            continue;
        }
        let words: Vec<String> = arguments.iter().map(|word| quoted(word)).collect();
        output::say(&format!("{head}\n  eyebolt {}", words.join(" ")));
        let begun = Instant::now();
        let status = Command::new(program).args(first).args(arguments).status();
        let status = status.with_context(|| format!("{}: cannot run it", program.display()))?;
        if !status.success() {
            bail!(
                "{about}: the command above ended with {status}. Go on with the same command when that is mended"
            );
        }
        output::say(&format!("  in {:.0} s", begun.elapsed().as_secs_f64()));
    }
    output::say(&format!("\nthe tables are in {}", folder.join(steps::REPORT).display()));
    Ok(Ending::Done)
}
