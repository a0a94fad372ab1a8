//! What the text of a path says, without a look at the disk.

use std::path::{Component, Path};

/// Whether the last folder of `directory` is `name`.
pub(super) fn is_called(directory: &Path, name: &str) -> bool {
    directory.file_name().is_some_and(|last| last == name)
}

/// Whether no prefix of the relative path climbs above where it starts.
pub(super) fn stays_inside(path: &str) -> bool {
    let mut depth = 0_i64;
    Path::new(path).components().all(|component| {
        match component {
            Component::Normal(_) => depth += 1,
            Component::ParentDir => depth -= 1,
            Component::CurDir => {}
            Component::RootDir | Component::Prefix(_) => depth = -1,
        }
        depth >= 0
    })
}

/// `text` with its `%` escapes resolved; `None` if one is bad, or the result is not UTF-8.
pub(super) fn percent_decoded(text: &str) -> Option<String> {
    let mut bytes = text.bytes();
    let mut decoded = Vec::with_capacity(text.len());
    while let Some(byte) = bytes.next() {
        decoded.push(if byte == b'%' {
            let high = char::from(bytes.next()?).to_digit(16)?;
            let low = char::from(bytes.next()?).to_digit(16)?;
            u8::try_from(high * 16 + low).ok()?
        } else {
            byte
        });
    }
    String::from_utf8(decoded).ok()
}
