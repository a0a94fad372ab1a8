//! Arrays in NumPy's NPY format, version 1.0.

/// A file of an array of this shape, the last axis fastest. `descr` is NumPy's code of the type with its
/// byte order, as in `<f4`, and `data` the numbers' bytes.
pub fn write_npy(descr: &str, shape: &[usize], data: impl IntoIterator<Item = u8>) -> Vec<u8> {
    let axes: String = shape.iter().map(|axis| format!("{axis}, ")).collect();
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({axes}), }}");
    // Magic, version and length take ten bytes, a line break the last; numbers start at 64.
    let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    // Some dozens of characters.
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(format!("{header:<width$}\n", width = length - 1).bytes());
    bytes.extend(data);
    bytes
}

/// A file of `values`.
pub(super) fn npy(shape: &[usize], values: impl Iterator<Item = f32>) -> Vec<u8> {
    write_npy("<f4", shape, values.flat_map(f32::to_le_bytes))
}
