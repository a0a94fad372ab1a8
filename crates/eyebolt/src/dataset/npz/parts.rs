//! Parts of a ZIP archive.

/// Signatures of the parts of an archive (APPNOTE.TXT 6.3, 4.3.7, 4.3.12, 4.3.16).
pub(super) const LOCAL: u32 = 0x0403_4b50;
pub(super) const CENTRAL: u32 = 0x0201_4b50;
pub(super) const END: u32 = 0x0605_4b50;
/// Lengths of these parts without names and other extras.
pub(super) const LOCAL_BYTES: usize = 30;
pub(super) const CENTRAL_BYTES: usize = 46;
pub(super) const END_BYTES: usize = 22;
