//! One folder in the place of another, so that one of them is always there whole.

use std::io;
use std::path::{Path, PathBuf};

/// Gives a folder another name on the same disk.
pub type Rename<'a> = dyn FnMut(&Path, &Path) -> io::Result<()> + 'a;

/// Why one folder is not in the place of another.
#[derive(Debug)]
pub struct NotReplaced {
    /// What the operating system said.
    pub cause: io::Error,
    /// Where the old folder is, if it could not go back to its place.
    pub left_at: Option<PathBuf>,
}

/// Puts the folder `new` in the place `path`. What is there goes to `aside`, a name that is free on
/// the same disk; if `new` cannot follow, it comes back.
pub fn replace(
    new: &Path,
    path: &Path,
    aside: &Path,
    rename: &mut Rename<'_>,
) -> Result<(), NotReplaced> {
    let in_place = |cause| NotReplaced { cause, left_at: None };
    if !path.exists() {
        return rename(new, path).map_err(in_place);
    }
    rename(path, aside).map_err(in_place)?;
    rename(new, path).map_err(|cause| {
        let left_at = rename(aside, path).is_err().then(|| aside.to_path_buf());
        NotReplaced { cause, left_at }
    })
}
