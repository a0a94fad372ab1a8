//! Several arrays in one file, as `numpy.savez` writes them: a ZIP archive of NPY files, not
//! compressed.

mod parts;
mod read;
mod write;

pub(super) use read::Archive;
pub(super) use write::{Array, npz};

#[cfg(test)]
mod tests;
