//! What the text of a path says, without a look at the disk.

use std::path::{Component, Path, PathBuf};

/// Whether the last folder of `directory` is `name`.
pub(super) fn is_called(directory: &Path, name: &str) -> bool {
    directory.file_name().is_some_and(|last| last == name)
}

/// Whether no prefix of the relative path climbs above where it starts.
pub(crate) fn stays_inside(path: &str) -> bool {
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

/// How many folders the path climbs before it goes down.
pub(super) fn climbed(path: &str) -> usize {
    let leading = Path::new(path).components().filter(|part| *part != Component::CurDir);
    leading.take_while(|part| *part == Component::ParentDir).count()
}

/// The path without the `..` that it begins with.
pub(super) fn without_climbing(path: &str) -> String {
    let parts = Path::new(path).components().filter(|part| *part != Component::CurDir);
    let below: PathBuf = parts.skip_while(|part| *part == Component::ParentDir).collect();
    below.display().to_string()
}

/// Folders of an absolute path that may be packages, deepest first: whether it lies in `share`, as
/// installed packages do, its name, and the path from there on.
pub(super) fn packages_in(path: &Path) -> Vec<(bool, String, PathBuf)> {
    let parts: Vec<Component<'_>> = path.components().collect();
    // A path that climbs may leave the package again.
    if parts.contains(&Component::ParentDir) {
        return Vec::new();
    }
    let name = |at: usize| match parts.get(at) {
        Some(Component::Normal(name)) => name.to_str(),
        _ => None,
    };
    let folders = (1..parts.len().saturating_sub(1)).rev();
    let package = folders.filter_map(|at| {
        let rest: PathBuf = parts.get(at + 1..)?.iter().collect();
        Some((name(at - 1) == Some("share"), name(at)?.to_owned(), rest))
    });
    package.collect()
}

/// `text` with its `%` escapes resolved; `None` if one is bad, or the result is not UTF-8.
pub(crate) fn percent_decoded(text: &str) -> Option<String> {
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
