//! The folder of a batch: see [`eyebolt::batch`] for what is in it.

use super::options::{Options, difference};
use crate::output::{self, write_whole};
use anyhow::{Context, Result, bail};
use eyebolt::batch::{Line, Listed, SCHEMA, listed};
use eyebolt::report::batch_page;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A folder that several runs may fill, one after the other or at once.
pub struct Folder(PathBuf);

/// What `batch.json` says.
#[derive(Debug, Deserialize, Serialize)]
struct Description {
    schema: String,
    version: String,
    options: Options,
}

/// The lines of a batch, in order, with their text.
pub type Lines = Vec<(Line, String)>;

/// The lines of all recordings, or what is missing.
pub enum Joined {
    All(Lines),
    /// Path of a recording without a line, and how many there are.
    Missing {
        first: String,
        count: usize,
    },
}

const DESCRIPTION: &str = "batch.json";

impl Folder {
    /// The folder at `path`, new or of a batch with the same options.
    pub fn open(path: &Path, options: &Options) -> Result<Self> {
        let folder = Self(path.to_owned());
        folder.refuse_others()?;
        let own = Description {
            schema: SCHEMA.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            options: options.clone(),
        };
        let file = path.join(DESCRIPTION);
        let text = format!("{}\n", serde_json::to_string_pretty(&own)?);
        // Of several that begin at once one is the first; the others find its file.
        if let Err(error) = write_whole(&file, text.as_bytes(), false)
            && !file.is_file()
        {
            return Err(error);
        }
        let before = folder.description()?;
        let other_options = || difference(&before.options, &own.options);
        let differs = match before.version == own.version {
            true => other_options(),
            false => Some(format!("it was begun by version {}", before.version)),
        };
        match differs {
            None => Ok(folder),
            Some(differs) => bail!(
                "{}: options: {differs}. Give the same ones to go on, or another --output",
                file.display()
            ),
        }
    }

    /// The folder at `path`, which other runs filled.
    pub fn of_others(path: &Path) -> Result<Self> {
        let folder = Self(path.to_owned());
        folder.description()?;
        Ok(folder)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Better told now than after the work: a place where no batch can be.
    fn refuse_others(&self) -> Result<()> {
        let path = &self.0;
        if !path.exists() || path.join(DESCRIPTION).is_file() {
            return Ok(());
        }
        let Ok(entries) = std::fs::read_dir(path) else {
            bail!("{}: --output: not a folder. Name one", path.display());
        };
        // Another run may be about to begin.
        let hidden = |name: &std::ffi::OsStr| name.as_encoded_bytes().starts_with(b".");
        if entries.flatten().any(|entry| !hidden(&entry.file_name())) {
            bail!(
                "{}: --output: there are other things than a batch in it. Name another folder",
                path.display()
            );
        }
        Ok(())
    }

    fn description(&self) -> Result<Description> {
        let file = self.0.join(DESCRIPTION);
        let remedy = || format!("{}: not of a batch. Name the folder of one", file.display());
        let text = std::fs::read_to_string(&file).with_context(remedy)?;
        let description: Description = serde_json::from_str(&text).with_context(remedy)?;
        if description.schema != SCHEMA {
            bail!(
                "{}: schema: {:?} is not known; {SCHEMA:?} is. Use the eyebolt that made it",
                file.display(),
                description.schema
            );
        }
        Ok(description)
    }

    /// Remembers which recordings there are, so that none is forgotten when lines are joined.
    pub fn keep_list(&self, all: &[Listed]) -> Result<()> {
        let text: String = all.iter().map(|it| format!("{}\n", it.recording)).collect();
        let name = eyebolt::batch::name_of(&text);
        let digits = name.rsplit('-').next().unwrap_or_default();
        let path = self.0.join("lists").join(format!("{digits}.txt"));
        match path.is_file() {
            true => Ok(()),
            false => write_whole(&path, text.as_bytes(), true),
        }
    }

    /// The line of a recording that is done.
    pub fn line(&self, listed: &Listed) -> Result<Option<Line>> {
        let line = self.line_text(listed)?;
        // Files that somebody removed are made again.
        let is_whole = |line: &Line| {
            let files = [&line.calibration, &line.report];
            files.into_iter().flatten().all(|name| self.0.join(name).is_file())
        };
        Ok(line.map(|(line, _)| line).filter(is_whole))
    }

    fn line_path(&self, listed: &Listed) -> PathBuf {
        self.0.join("lines").join(format!("{}.json", listed.name))
    }

    fn line_text(&self, listed: &Listed) -> Result<Option<(Line, String)>> {
        let path = self.line_path(listed);
        let text = match std::fs::read_to_string(&path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            text => text.with_context(|| format!("{}: cannot be read", path.display()))?,
        };
        let remedy =
            || format!("{}: not a line of a batch. Remove the file and go on", path.display());
        let line: Line = serde_json::from_str(&text).with_context(remedy)?;
        if line.recording != listed.recording {
            bail!(
                "{}: recording: {} is another one. Remove the file",
                path.display(),
                line.recording
            );
        }
        Ok(Some((line, text)))
    }

    /// Writes a file of a recording; its name.
    pub fn write(&self, name: String, bytes: &[u8]) -> Result<String> {
        // What a run that was killed left may be there, with the same bytes.
        write_whole(&self.0.join(&name), bytes, true)?;
        Ok(name)
    }

    /// Writes the line of a recording, whose files are there.
    pub fn finish(&self, listed: &Listed, line: &Line) -> Result<()> {
        write_whole(&self.line_path(listed), line.to_json().as_bytes(), true)
    }

    /// Writes the lines of all recordings of all lists into one file, and the page, if none is missing.
    pub fn join(&self) -> Result<Joined> {
        let (mut lines, mut missing) = (Lines::new(), Vec::new());
        for listed in self.all()? {
            match self.line_text(&listed)? {
                Some(line) => lines.push(line),
                None => missing.push(listed.recording),
            }
        }
        if let Some(first) = missing.first() {
            return Ok(Joined::Missing { first: first.clone(), count: missing.len() });
        }
        let (read, texts): (Vec<Line>, Vec<&str>) =
            lines.iter().map(|(line, text)| (line.clone(), text.as_str())).unzip();
        output::write_whole(&self.0.join("batch.jsonl"), texts.concat().as_bytes(), true)?;
        output::write_whole(&self.0.join("index.html"), batch_page(&read).as_bytes(), true)?;
        Ok(Joined::All(lines))
    }

    /// The recordings of all lists, in order.
    fn all(&self) -> Result<Vec<Listed>> {
        let folder = self.0.join("lists");
        let failed = || format!("{}: cannot be read. Run the batch again", folder.display());
        let mut recordings = BTreeSet::new();
        for entry in std::fs::read_dir(&folder).with_context(failed)? {
            let path = entry.with_context(failed)?.path();
            if path.extension().is_some_and(|ending| ending == "txt") {
                let text = std::fs::read_to_string(&path).with_context(failed)?;
                recordings.extend(text.lines().map(str::to_owned));
            }
        }
        listed(recordings.iter().map(String::as_str)).map_err(|[one, other]| {
            anyhow::anyhow!("{one} and {other} have the same name. Calibrate one in another folder")
        })
    }
}
