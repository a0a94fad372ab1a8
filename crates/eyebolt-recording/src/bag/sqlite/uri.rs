//! How SQLite is told to leave a file and its folder alone.

use std::path::{Path, PathBuf};

/// Under which name to open the database at `path`.
///
/// A database in WAL mode, as ROS 2 writes them, would get two new files beside it even where it is
/// only read, and could not be opened in a folder that cannot be written. A URI can say that nobody
/// writes to it; where a recorder left such files, what they hold is wanted.
pub(super) fn untouched(path: &Path) -> PathBuf {
    match path.to_str() {
        Some(text) if cfg!(unix) && !has_more(path) => {
            PathBuf::from(format!("file:{}?immutable=1", escaped(text)))
        }
        _ => path.to_path_buf(),
    }
}

/// Whether a recorder left files beside the database at `path` that belong to it.
pub(super) fn has_more(path: &Path) -> bool {
    ["-wal", "-journal"].into_iter().any(|ending| {
        let mut name = path.as_os_str().to_owned();
        name.push(ending);
        std::fs::metadata(name).is_ok_and(|file| file.len() > 0)
    })
}

fn escaped(path: &str) -> String {
    let mut escaped = String::new();
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'_' | b'-' => {
                escaped.push(char::from(byte));
            }
            _ => escaped.push_str(&format!("%{byte:02x}")),
        }
    }
    escaped
}
