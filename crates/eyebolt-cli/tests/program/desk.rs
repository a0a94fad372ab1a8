//! Folders to write to.

use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// An empty folder of this name below the build folder: what lay there is gone.
pub fn fresh(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

pub fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A folder to write to.
pub struct Desk {
    path: PathBuf,
    /// Removes the folder with the desk.
    _own: Option<TempDir>,
}

impl Desk {
    /// A folder of one's own.
    pub fn new() -> Self {
        let own = tempfile::tempdir().unwrap();
        Self { path: own.path().to_owned(), _own: Some(own) }
    }

    /// A folder that is left behind, since nothing static is ever dropped.
    pub fn shared(name: &str) -> Self {
        Self { path: fresh(name), _own: None }
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.path().join(name)
    }

    /// Names of what lies in it, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.path()).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}
