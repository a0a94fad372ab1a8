//! The 4 x 4 matrix as a file of NumPy.

use super::placement::Placement;

/// Version 1.0 of the format: magic, version, length of the header (little-endian), header. The
/// numbers start at a multiple of 64 bytes.
pub(super) fn write(placement: &Placement) -> Vec<u8> {
    const START: usize = 128;
    const BEFORE_HEADER: usize = 10;
    const HEADER_BYTES: u16 = (START - BEFORE_HEADER) as u16;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(HEADER_BYTES.to_le_bytes());
    bytes.extend(b"{'descr': '<f8', 'fortran_order': False, 'shape': (4, 4), }");
    bytes.resize(START - 1, b' ');
    bytes.push(b'\n');
    // Columns of the transpose are rows.
    bytes.extend(
        placement.parent_from_child.matrix().transpose().iter().flat_map(|v| v.to_le_bytes()),
    );
    bytes
}
