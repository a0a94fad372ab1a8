//! `eyebolt reproduce`.

mod steps;

use crate::ending::Ending;
use crate::output;
use crate::shell::quoted;
use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;
use steps::{Step, steps};

/// Options of `eyebolt reproduce`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder for all of it; what is there already is not made again
    #[arg(short, long, value_name = "FOLDER", default_value = "reproduction")]
    output: PathBuf,
    /// A robot that comes with the program, or a URDF with its meshes
    #[arg(long, value_name = "NAME|URDF", default_value = "shackle")]
    robot: String,
    /// In ten minutes instead of hours: fewer frames, and networks that have hardly learned
    #[arg(long)]
    quick: bool,
    /// Evaluate the networks of this folder, instead of recording, labelling and training
    #[arg(long, value_name = "FOLDER")]
    model: Option<PathBuf>,
    /// Also teach networks on each of the three training poses alone, and evaluate each on each test pose
    #[arg(long, conflicts_with = "model")]
    each: bool,
    /// Steps of each network [default: 20000, or 400 with --quick]
    #[arg(long, value_parser = clap::value_parser!(u64).range(1..=100_000_000), conflicts_with = "model")]
    steps: Option<u64>,
    /// Begin with the weights of another model, as far as they fit
    #[arg(long, value_name = "FOLDER", conflicts_with = "model")]
    from: Option<PathBuf>,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    let folder = &arguments.output;
    let steps = steps(arguments);
    for part in ["recordings", "datasets", "models"] {
        let path = folder.join(part);
        std::fs::create_dir_all(&path).with_context(|| {
            format!("{}: cannot make it. Name another --output", path.display())
        })?;
    }
    let program = std::env::current_exe().context("this program cannot be found")?;
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
        let status = Command::new(&program).args(arguments).status();
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
