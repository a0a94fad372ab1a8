//! `eyebolt batch`.

mod arguments;
mod folder;
mod list;
mod one;
mod options;
mod told;

use crate::calibrate::learned;
use crate::ending::Ending;
use crate::inputs::use_threads;
use crate::output;
use crate::progress::leaves;
use anyhow::{Result, bail};
pub use arguments::Arguments;
use clap::ArgMatches;
use eyebolt::batch::{self, Listed};
use eyebolt::dataset::Shard;
use folder::{Folder, Joined};

/// Runs the command, of whose flags `matches` knows.
pub fn run(arguments: &Arguments, matches: &ArgMatches) -> Result<Ending> {
    use_threads(arguments.threads)?;
    if let Some(path) = &arguments.merge {
        let folder = Folder::of_others(path)?;
        return match folder.join()? {
            Joined::All(lines) => {
                output::say(&told::summary(&lines, &folder));
                Ok(Ending::Done)
            }
            Joined::Missing { first, count } => bail!(
                "{}: lines: of {} there is none yet. Run the same batch without --shard, or every shard, to \
                 the end",
                path.display(),
                others(&first, count)
            ),
        };
    }
    let Some(path) = &arguments.output else { bail!("--output: name a folder") };
    let listed = list::read(arguments)?;
    arguments.robot.check_named()?;
    learned::check(&arguments.way.learned)?;
    let folder = Folder::open(path, &options::given(matches))?;
    folder.keep_list(&listed)?;
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    // In turn, so that shards are alike in size whatever the recordings are called.
    let mine: Vec<&Listed> = listed
        .iter()
        .enumerate()
        .filter(|(number, _)| *number as u64 % u64::from(shard.count()) == u64::from(shard.index()))
        .map(|(_, listed)| listed)
        .collect();
    calibrate(arguments, &folder, &mine)?;
    end(arguments, &folder)?;
    Ok(Ending::Done)
}

/// Gives each of these recordings its line, if it has none.
fn calibrate(arguments: &Arguments, folder: &Folder, mine: &[&Listed]) -> Result<()> {
    for (done, listed) in mine.iter().enumerate() {
        leaves(format!(
            "{done} of {} recordings are done, in {}. Run the same command to go on",
            mine.len(),
            folder.path().display()
        ))?;
        let known = folder.line(listed)?;
        let known = known.filter(|line| !(arguments.retry && line.ending == batch::Ending::Failed));
        let (line, is_new) = match known {
            Some(line) => (line, false),
            None => (one::calibrate(arguments, folder, listed)?, true),
        };
        if arguments.json {
            output::deliver(line.to_json().as_bytes())?;
        } else if is_new {
            output::say(&told::line(&line));
        }
    }
    Ok(())
}

/// Sums up, if every recording has its line.
fn end(arguments: &Arguments, folder: &Folder) -> Result<()> {
    let said = match folder.join()? {
        Joined::All(lines) => told::summary(&lines, folder),
        Joined::Missing { first, count } => format!(
            "still to be done, by other shards or another list: {}. The last one sums up",
            others(&first, count)
        ),
    };
    if !arguments.json {
        output::say(&said);
    }
    Ok(())
}

/// One recording, and how many more.
fn others(first: &str, count: usize) -> String {
    match count {
        0 | 1 => first.to_owned(),
        count => format!("{first} and {} more", count - 1),
    }
}
