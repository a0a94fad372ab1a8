//! Files that appear whole or not at all, and the only places that print.

use anyhow::{Result, anyhow, bail};
use std::io::Write;
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
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(anyhow!("standard output: cannot write: {}", error.kind()))
        }
        _ => Ok(()),
    }
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

    /// Writes a calibration where its verdict belongs; returns where that is.
    pub fn write(&self, trusted: bool, bytes: &[u8]) -> Result<PathBuf> {
        let path = if trusted { &self.trusted } else { &self.rejected };
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
        Ok(path.clone())
    }
}

/// An error if there is a file at `path`, unless `force` is given.
pub fn refuse_existing(path: &Path, force: bool) -> Result<()> {
    if !force && path.exists() {
        bail!("{}: the file exists. Give --force to replace it, or another name", path.display());
    }
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes beside `path`, then renames: whoever looks sees the old file or the new one, whole.
pub fn write_whole(path: &Path, bytes: &[u8], force: bool) -> Result<()> {
    refuse_existing(path, force)?;
    let folder = folder_of(path);
    let write = || -> std::io::Result<()> {
        std::fs::create_dir_all(folder)?;
        let mut file = beside(folder)?;
        file.write_all(bytes)?;
        file.as_file().sync_all()?;
        if force {
            file.persist(path)?
        } else {
            file.persist_noclobber(path)?
        };
        Ok(())
    };
    write().map_err(|error| anyhow!("{}: cannot write: {}", path.display(), error.kind()))
}

/// A file in `folder` that others may read, as results may; temporary ones are private by default.
fn beside(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    builder.tempfile_in(folder)
}
