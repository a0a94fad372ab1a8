//! Files into memory, up to a limit.

use super::error::ExportError;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The text of the file at `path`, at most `limit` bytes.
pub(crate) fn read_text(path: &Path, limit: u64) -> Result<String, ExportError> {
    let name = path.display().to_string();
    let failed = |cause| ExportError::Read { file: name.clone(), cause };
    let file = File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    // One byte more than allowed, so that a file that is too long shows.
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > limit {
        let problem = format!("larger than {} MiB", limit >> 20);
        return Err(ExportError::invalid(&name, "the file", problem, "Name the right file"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let problem = format!("byte {at} is not UTF-8");
        ExportError::invalid(&name, "the file", problem, "Name the right file, or store it as text")
    })
}
