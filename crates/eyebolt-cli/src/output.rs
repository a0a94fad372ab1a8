//! Files that appear whole or not at all, and the only places that print.

mod replace;
#[cfg(test)]
mod tests;

use anyhow::{Result, anyhow, bail};
use eyebolt_recording::WriteError;
use replace::{NotReplaced, Rename, replace};
use std::fs::File;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

/// Says something on standard output. A reader that has gone away is no error.
pub fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Writes what the program was run for to standard output. A reader that has gone away is no error;
/// a full disk is.
pub fn deliver(bytes: &[u8]) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(anyhow!(
            "standard output: cannot write: {}. Make room where it leads",
            error.kind()
        )),
        _ => Ok(()),
    }
}

/// The name of standard output, where a file is asked for.
pub const STDOUT: &str = "-";

/// `word` in bold green, or in bold red, where a person reads it on a terminal and wants colours.
pub fn emphasised(word: &str, good: bool) -> String {
    let unwanted = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    if !std::io::stdout().is_terminal() || unwanted("NO_COLOR") || dumb {
        return word.to_owned();
    }
    format!("\x1b[1;{}m{word}\x1b[0m", if good { 32 } else { 31 })
}

/// Says something on standard error.
pub fn complain(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Where a calibration goes, checked before any work is done.
#[derive(Debug)]
pub struct Destination {
    trusted: PathBuf,
    rejected: PathBuf,
    force: bool,
}

impl Destination {
    /// For `path`, whose rejected sibling is `*.rejected.json`.
    pub fn new(path: &Path, force: bool) -> Result<Self> {
        if path == Path::new(STDOUT) {
            return Ok(Self { trusted: path.to_owned(), rejected: path.to_owned(), force });
        }
        let Some(stem) = path.file_stem() else {
            bail!(
                "{}: --output: not the name of a file. Give one, such as calibration.json",
                path.display()
            );
        };
        let mut name = stem.to_owned();
        name.push(".rejected.json");
        let destination =
            Self { trusted: path.to_owned(), rejected: path.with_file_name(name), force };
        for file in [&destination.trusted, &destination.rejected] {
            if file.is_dir() {
                bail!("{}: --output: this is a folder. Name a file in it", file.display());
            }
            refuse_existing(file, force)?;
        }
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        if !ending.eq_ignore_ascii_case("json") {
            bail!(
                "{}: --output: the calibration is JSON. Name a file that ends in .json; `eyebolt \
                 export` writes other forms of it",
                path.display()
            );
        }
        let folder = folder_of(path);
        if !folder.is_dir() {
            bail!("{}: --output: no such folder. Make it first", folder.display());
        }
        // Better told now than after the work.
        match tempfile::NamedTempFile::new_in(folder) {
            Ok(_) => Ok(destination),
            // The kind only: the text names a temporary file that nobody knows.
            Err(error) => bail!(
                "{}: --output: cannot write here: {}. Name a file elsewhere",
                folder.display(),
                error.kind()
            ),
        }
    }

    /// Whether a calibration may be written to `path`.
    pub fn is(&self, path: &Path) -> bool {
        path == self.trusted || path == self.rejected
    }

    /// Where a calibration of this verdict belongs.
    pub fn path(&self, trusted: bool) -> &Path {
        if trusted { &self.trusted } else { &self.rejected }
    }

    /// Writes a calibration where its verdict belongs; returns where that is.
    pub fn write(&self, trusted: bool, bytes: &[u8]) -> Result<PathBuf> {
        let path = self.path(trusted);
        if path == Path::new(STDOUT) {
            deliver(bytes)?;
            return Ok(path.to_owned());
        }
        write_whole(path, bytes, self.force)?;
        if trusted && self.force && self.rejected.exists() {
            // An earlier refusal beside the answer that replaces it would only confuse.
            if let Err(error) = std::fs::remove_file(&self.rejected) {
                complain(&format!(
                    "note: {}: still there: {}",
                    self.rejected.display(),
                    error.kind()
                ));
            }
        }
        Ok(path.to_owned())
    }
}

/// An error if there is a file at `path`, unless `force` is given.
pub fn refuse_existing(path: &Path, force: bool) -> Result<()> {
    if !force && path.exists() {
        bail!("{}: the file exists. Give --force to replace it, or another name", path.display());
    }
    Ok(())
}

/// The kind only: the text names a temporary file that nobody knows.
fn cannot_write(path: &Path, error: &std::io::Error) -> anyhow::Error {
    anyhow!(
        "{}: cannot write: {}. Make room there, or name another place",
        path.display(),
        error.kind()
    )
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes beside `path`, then renames: whoever looks sees the old file or the new one, whole.
pub fn write_whole(path: &Path, bytes: &[u8], force: bool) -> Result<()> {
    write_through(path, force, |file| Ok(file.write_all(bytes)?))
}

/// As [`write_whole`], with whatever `fill` writes into the file. If it fails, nothing is left.
pub fn write_through(
    path: &Path,
    force: bool,
    fill: impl FnOnce(&mut File) -> Result<()>,
) -> Result<()> {
    refuse_existing(path, force)?;
    let failed = |error: std::io::Error| cannot_write(path, &error);
    let folder = folder_of(path);
    std::fs::create_dir_all(folder).map_err(failed)?;
    let mut file = beside(folder).map_err(failed)?;
    fill(file.as_file_mut()).map_err(|error| match error.downcast::<std::io::Error>() {
        Ok(error) => failed(error),
        Err(error) => error,
    })?;
    file.as_file().sync_all().map_err(failed)?;
    let persisted = if force { file.persist(path) } else { file.persist_noclobber(path) };
    persisted.map(drop).map_err(|error| failed(error.error))
}

/// A folder that appears whole, with whatever `fill` writes into it. If it fails, nothing is left,
/// and what was there still is.
pub fn write_folder_whole(
    path: &Path,
    force: bool,
    fill: impl FnOnce(&Path) -> Result<()>,
) -> Result<()> {
    write_folder_with(path, force, fill, &mut |from, to| std::fs::rename(from, to))
}

/// As [`write_folder_whole`], with the operating system's way to rename.
fn write_folder_with(
    path: &Path,
    force: bool,
    fill: impl FnOnce(&Path) -> Result<()>,
    rename: &mut Rename<'_>,
) -> Result<()> {
    refuse_existing(path, force)?;
    let failed = |error: std::io::Error| cannot_write(path, &error);
    let above = folder_of(path);
    std::fs::create_dir_all(above).map_err(failed)?;
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o755));
    let new = builder.tempdir_in(above).map_err(failed)?;
    fill(new.path())?;
    // What is replaced goes last, when the new one is there.
    let old = builder.tempdir_in(above).map_err(failed)?;
    match replace(new.path(), path, &old.path().join("replaced"), rename) {
        Ok(()) => {
            // Under its new name, nothing removes it any more.
            let _ = new.keep();
            Ok(())
        }
        Err(NotReplaced { cause, left_at: None }) => Err(failed(cause)),
        Err(NotReplaced { cause, left_at: Some(left_at) }) => {
            let _ = old.keep();
            Err(anyhow!(
                "{}: cannot write: {}. What was there is in {} now: move it back",
                path.display(),
                cause.kind(),
                left_at.display()
            ))
        }
    }
}

/// A file in `folder` that others may read, as results may; temporary ones are private by default.
fn beside(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    builder.tempfile_in(folder)
}

/// The error, with the name that the user gave instead of a temporary one.
pub fn named(error: WriteError, output: &Path) -> anyhow::Error {
    match error {
        WriteError::File { cause, .. } => anyhow!(
            "{}: cannot write: {cause}. Make room there, or name another place",
            output.display()
        ),
        other => other.into(),
    }
}
