//! What eyebolt tells of itself in the bags that it writes.

use crate::error::RecordingError;
use crate::frame_names::is_fit;
use std::collections::BTreeSet;
use std::path::Path;

/// Name of the metadata record with what no message says.
pub(crate) const NAME: &str = "eyebolt";
/// Version of the record, which it tells.
pub(crate) const SCHEMA: &str = "eyebolt.recording/1";
/// Key of the topic of the backgrounds.
pub(crate) const BACKGROUND_TOPIC: &str = "background_topic";

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
