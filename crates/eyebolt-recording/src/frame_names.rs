//! Which names frames may have.

use crate::error::RecordingError;
use std::collections::BTreeSet;
use std::path::Path;

/// Whether files can be named after a frame of this name, as they are in folders.
pub(crate) fn is_fit(name: &str) -> bool {
    !name.is_empty() && !name.contains(['/', '\\', '\0'])
}

/// The files of a folder are named after its frames, so these must be names of files, each once.
pub(crate) fn check_names(path: &Path, names: &[String]) -> Result<(), RecordingError> {
    let mut known = BTreeSet::new();
    for name in names {
        if is_fit(name) && known.insert(name.as_str()) {
            continue;
        }
        let problem = format!("{name:?} cannot be part of the name of a file, or is there twice");
        let remedy = "Write the file again";
        return Err(RecordingError::invalid(path, "metadata: frame_names", problem, remedy));
    }
    Ok(())
}
