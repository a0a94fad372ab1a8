//! `eyebolt study`.

mod lines;
mod table;

use crate::ending::Ending;
use crate::inputs::{CacheArguments, use_threads};
use crate::output;
use crate::progress::Counting;
use anyhow::Result;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use eyebolt::study::{self, Kind, SessionResult, Study};
use std::time::Instant;

/// Options of `eyebolt study`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// How many sessions
    #[arg(long, value_name = "COUNT", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    sessions: u32,
    /// Number of the first session: what a session is follows from seed and number, so that one can be run by itself, and many on
    /// several machines
    #[arg(long, value_name = "NUMBER", default_value_t = 0, value_parser = clap::value_parser!(u32))]
    first: u32,
    /// Seed of all random choices; but for times, the same seed gives the same lines on any number of
    /// threads
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Only sessions with this the matter, of which plain ones have nothing
    #[arg(long, value_name = "KIND", value_parser = kind())]
    only: Option<Kind>,
    /// One JSON line for each session, as it ends, then one for all
    #[arg(long)]
    json: bool,
    /// Threads to use, each for a session of its own; otherwise one for each core
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    cache: CacheArguments,
}

fn kind() -> impl TypedValueParser<Value = Kind> {
    let names = Kind::ALL.iter().map(|kind| kind.name());
    PossibleValuesParser::new(names).try_map(|name| Kind::named(&name).ok_or("not a kind"))
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    use_threads(arguments.threads)?;
    let study = Study {
        first: u64::from(arguments.first),
        sessions: u64::from(arguments.sessions),
        seed: arguments.seed,
        only: arguments.only,
        threads: rayon::current_num_threads(),
    };
    let begun = Instant::now();
    let clock = || begun.elapsed().as_secs_f64();
    let bar = Counting::new()?;
    let mut told = Ok(());
    let tell = |result: &SessionResult| {
        if arguments.json && told.is_ok() {
            told = lines::session(result).and_then(|line| output::deliver(line.as_bytes()));
        }
    };
    let summary = study::run(&study, &arguments.cache.open(), &clock, &bar, tell)?;
    told?;
    drop(bar);
    if arguments.json {
        output::deliver(lines::summary(&study, &summary)?.as_bytes())?;
    } else {
        output::say(&table::text(&summary));
    }
    Ok(Ending::Done)
}
