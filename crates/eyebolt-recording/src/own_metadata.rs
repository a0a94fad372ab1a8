//! What eyebolt tells of itself in the bags that it writes.

use crate::error::RecordingError;
use crate::frame_names::is_fit;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Name of the metadata record with what no message says.
pub(crate) const NAME: &str = "eyebolt";
/// Version of the record, which it tells.
pub(crate) const SCHEMA: &str = "eyebolt.recording/1";
/// Key that says how the file came to be, and what it says of sessions.
const WRITTEN: &str = "written";
const LIVE: &str = "live";
/// Key of the topic of the backgrounds.
pub(crate) const BACKGROUND_TOPIC: &str = "background_topic";

/// What a session tells of itself that is recorded while it happens.
pub(crate) fn of_session() -> BTreeMap<String, String> {
    let told = [("schema", SCHEMA), (WRITTEN, LIVE)];
    told.map(|(key, value)| (key.to_owned(), value.to_owned())).into()
}

/// Whether the file is such a session, which may have been killed: all that is in it counts.
pub(crate) fn is_session(metadata: Option<&BTreeMap<String, String>>) -> bool {
    metadata.and_then(|told| told.get(WRITTEN)).is_some_and(|written| written == LIVE)
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
