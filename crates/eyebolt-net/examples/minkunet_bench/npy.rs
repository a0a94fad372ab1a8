//! The two arrays of a benchmark.

use crate::Failure;
use eyebolt_net::Matrix;

/// Shape and bytes of a C-ordered array of 32-bit numbers.
fn read(path: &str, kind: &str) -> Result<(usize, usize, Vec<[u8; 4]>), Failure> {
    let bytes = std::fs::read(path)?;
    let bad = || format!("{path}: not a C-ordered array of {kind} in NPY version 1");
    let length = bytes.get(8..10).ok_or_else(bad)?;
    let start = 10 + usize::from(u16::from_le_bytes([length[0], length[1]]));
    let header = std::str::from_utf8(bytes.get(10..start).ok_or_else(bad)?)?;
    if !header.contains(kind) || !header.contains("'fortran_order': False") {
        return Err(bad().into());
    }
    let shape = header.split('(').nth(1).and_then(|rest| rest.split(')').next());
    let shape = shape.ok_or_else(bad)?.split(',').map(|number| number.trim().parse::<usize>());
    let [Ok(rows), Ok(columns)] = shape.collect::<Vec<_>>()[..] else { return Err(bad().into()) };
    let values = bytes[start..].as_chunks::<4>().0.to_vec();
    if rows.checked_mul(columns) != Some(values.len()) {
        return Err(bad().into());
    }
    Ok((rows, columns, values))
}

#[allow(dead_code, reason = "one of two examples reads coordinates")]
/// `[item, x, y, z]` of an `N x 3` array.
pub fn coordinates(path: &str) -> Result<Vec<[i32; 4]>, Failure> {
    let (_, columns, values) = read(path, "<i4")?;
    if columns != 3 {
        return Err(format!("{path}: {columns} columns, not 3").into());
    }
    let values: Vec<i32> = values.into_iter().map(i32::from_le_bytes).collect();
    Ok(values.chunks_exact(3).map(|row| [0, row[0], row[1], row[2]]).collect())
}

/// An `N x channels` array.
pub fn features(path: &str) -> Result<Matrix, Failure> {
    let (rows, columns, values) = read(path, "<f4")?;
    Ok(Matrix::new(rows, columns, values.into_iter().map(f32::from_le_bytes).collect())?)
}
