//! Arrays in NumPy's NPY format, version 1.0.

/// A file of `values` with the last axis fastest.
pub(super) fn npy(shape: &[usize], values: impl Iterator<Item = f32>) -> Vec<u8> {
    let axes: String = shape.iter().map(|axis| format!("{axis}, ")).collect();
    let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({axes}), }}");
    // Magic, version and length take ten bytes, a line break the last; numbers start at 64.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    // Some dozens of characters.
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(format!("{header:<width$}\n", width = length - 1).bytes());
    bytes.extend(values.flat_map(f32::to_le_bytes));
    bytes
}
