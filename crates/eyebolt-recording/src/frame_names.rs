//! Which names frames may have.

/// Whether files can be named after a frame of this name, as they are in folders.
pub(crate) fn is_fit(name: &str) -> bool {
    !name.is_empty() && !name.contains(['/', '\\', '\0'])
}
