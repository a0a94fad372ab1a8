//! Several arrays in one file, as `numpy.savez` writes them: a ZIP archive of NPY files, not
//! compressed.

mod read;
mod write;

pub(super) use read::Archive;
pub(super) use write::{Array, npz};

/// Signatures of the parts of an archive (APPNOTE.TXT 6.3, 4.3.7, 4.3.12, 4.3.16).
const LOCAL: u32 = 0x0403_4b50;
const CENTRAL: u32 = 0x0201_4b50;
const END: u32 = 0x0605_4b50;
/// Lengths of these parts without names and other extras.
const LOCAL_BYTES: usize = 30;
const CENTRAL_BYTES: usize = 46;
const END_BYTES: usize = 22;

#[cfg(test)]
mod tests;
