//! A recording that comes by standard input.

use anyhow::{Context as _, Result, bail};
use std::fs::File;
use std::io::{self, IsTerminal as _};
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use tempfile::TempDir;

/// What came so far, in a file that is read while it grows; it is removed in the end.
pub(super) struct StandardInput {
    folder: TempDir,
    copied: Arc<OnceLock<io::Result<u64>>>,
}

/// What the file is called, for errors.
const FILE: &str = "standard-input.mcap";

impl StandardInput {
    /// Whether a recording of that name is one.
    pub fn is_named(recording: &Path) -> bool {
        recording == Path::new("-")
    }

    /// Begins to read it.
    pub fn new() -> Result<Self> {
        if io::stdin().is_terminal() {
            bail!("-: standard input is a terminal. Pipe an MCAP into it, or name a recording");
        }
        let folder = tempfile::tempdir().with_context(no_room)?;
        let mut file = File::create(folder.path().join(FILE)).with_context(no_room)?;
        let copied = Arc::new(OnceLock::new());
        let told = Arc::clone(&copied);
        std::thread::spawn(move || told.set(io::copy(&mut io::stdin().lock(), &mut file)));
        Ok(Self { folder, copied })
    }

    /// The file.
    pub fn path(&self) -> PathBuf {
        self.folder.path().join(FILE)
    }

    /// Whether all that comes is in the file.
    pub fn has_ended(&self) -> Result<bool> {
        match self.copied.get() {
            None => Ok(false),
            Some(Ok(_)) => Ok(true),
            Some(Err(error)) => bail!("standard input: {error}. {}", no_room()),
        }
    }
}

fn no_room() -> String {
    let folder = std::env::temp_dir();
    format!(
        "What comes by standard input is kept in {}; TMPDIR names another folder with more room",
        folder.display()
    )
}
