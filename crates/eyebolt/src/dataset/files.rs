//! Whole files in and out.

use super::error::DatasetError;
use std::fs::File;
use std::io::{ErrorKind, Read, Write};
use std::path::{Component, Path};
use tempfile::NamedTempFile;

/// Largest frame, bytes: depth and labels of 50 million pixels.
pub(super) const MOST_FRAME_BYTES: u64 = 512 << 20;
/// Largest text, bytes: an index of a million frames.
pub(super) const MOST_TEXT_BYTES: u64 = 512 << 20;

/// All bytes of the file at `path`.
pub(super) fn read(path: &Path, most: u64, remedy: &str) -> Result<Vec<u8>, DatasetError> {
    let failed = |cause| DatasetError::Read {
        file: path.display().to_string(),
        cause,
        remedy: remedy.to_owned(),
    };
    let file = File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    file.take(most + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > most {
        let problem = format!("the file is larger than {} MiB", most >> 20);
        return Err(DatasetError::invalid(path, "size", problem, remedy));
    }
    Ok(bytes)
}

/// The text of the file at `path`.
pub(super) fn read_text(path: &Path, remedy: &str) -> Result<String, DatasetError> {
    String::from_utf8(read(path, MOST_TEXT_BYTES, remedy)?).map_err(|error| {
        let problem = format!("byte {} is not UTF-8", error.utf8_error().valid_up_to());
        DatasetError::invalid(path, "text", problem, remedy)
    })
}

/// Writes beside `path`, then renames: readers see the old file or the new one, whole. The folder is
/// made if need be.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), DatasetError> {
    let written = beside(path, bytes).and_then(|file| Ok(file.persist(path).map(drop)?));
    written.map_err(|error| DatasetError::write(path, &error))
}

/// As [`write_whole`], unless there is a file: of several machines that write at the same time, one
/// does. What is there afterwards.
pub(super) fn write_once(path: &Path, bytes: &[u8]) -> Result<Vec<u8>, DatasetError> {
    if !path.exists() {
        let file = beside(path, bytes).map_err(|error| DatasetError::write(path, &error))?;
        match file.persist_noclobber(path).map_err(|error| error.error) {
            Ok(_) => return Ok(bytes.to_vec()),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(DatasetError::write(path, &error)),
        }
    }
    read(path, MOST_TEXT_BYTES, "Check that the file may be read")
}

/// A temporary file of these bytes in the folder of `path`.
fn beside(path: &Path, bytes: &[u8]) -> std::io::Result<NamedTempFile> {
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)?;
    let mut builder = tempfile::Builder::new();
    // Temporary files are private by default, and data sets are for others.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    Ok(file)
}

/// Refuses a `file`, named by the one at `path`, that does not lie in the data set.
pub(super) fn check_place(path: &Path, file: &str) -> Result<(), DatasetError> {
    let mut parts = Path::new(file).components();
    if !file.is_empty() && parts.all(|part| matches!(part, Component::Normal(_))) {
        return Ok(());
    }
    let problem = format!("{file:?} does not lie in the data set");
    Err(DatasetError::invalid(path, "file", problem, "Keep the files where they were written"))
}
