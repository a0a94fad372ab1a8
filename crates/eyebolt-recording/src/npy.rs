//! Arrays in NumPy's NPY format, versions 1 to 3.

mod header;
mod number;

use crate::error::RecordingError;
use crate::file::{DATA_LIMIT, read_bytes};
use header::Header;
pub use number::{Dtype, Number};
use std::path::Path;

/// An array whose type and length have been checked, its numbers still as stored.
pub struct Npy {
    bytes: Vec<u8>,
    header: Header,
    dtype: Dtype,
}

impl Npy {
    /// Reads the file at `path`, which is `field` to the recording and may be of types `accepted`.
    pub(crate) fn read(
        path: &Path,
        field: &str,
        accepted: &[Dtype],
    ) -> Result<Self, RecordingError> {
        Self::parse(path, field, read_bytes(path, field, DATA_LIMIT)?, accepted)
    }

    /// From the bytes of a file at `path`, which is `field` to whoever reads it and may be of types
    /// `accepted`.
    ///
    /// # Errors
    ///
    /// Not an NPY file of such numbers, or one that is damaged.
    pub fn parse(
        path: &Path,
        field: &str,
        bytes: Vec<u8>,
        accepted: &[Dtype],
    ) -> Result<Self, RecordingError> {
        let header = Header::parse(&bytes).map_err(|problem| {
            RecordingError::invalid(path, field, problem, "Write the file with numpy.save")
        })?;
        let code = header.descr.trim_start_matches(['<', '>', '=', '|']);
        let Some(dtype) = Dtype::from_code(code).filter(|d| accepted.contains(d)) else {
            let names: Vec<_> = accepted.iter().map(|d| d.name()).collect();
            return Err(RecordingError::invalid(
                path,
                field,
                format!("its numbers are of type '{}'", header.descr),
                format!("Store one of {}", names.join(", ")),
            ));
        };
        let stored = bytes.len().saturating_sub(header.length);
        if header.count().and_then(|n| n.checked_mul(dtype.size())) != Some(stored) {
            return Err(RecordingError::invalid(
                path,
                field,
                format!(
                    "shape {:?} of {} does not take the {stored} bytes that follow the header",
                    header.shape,
                    dtype.name()
                ),
                "The file is damaged or cut short: copy or write it again",
            ));
        }
        Ok(Self { bytes, header, dtype })
    }

    /// Length of every axis.
    pub fn shape(&self) -> &[usize] {
        &self.header.shape
    }

    /// Type of the numbers as stored.
    pub fn dtype(&self) -> Dtype {
        self.dtype
    }

    /// All numbers, last axis fastest whatever the order in the file.
    pub fn values<T: Number>(&self) -> Vec<T> {
        let data = self.bytes.get(self.header.length..).unwrap_or(&[]);
        let big = self.header.descr.starts_with('>');
        let stored = match (self.dtype, big) {
            (Dtype::Float32, false) => convert(data, |b| T::from_f32(f32::from_le_bytes(b))),
            (Dtype::Float32, true) => convert(data, |b| T::from_f32(f32::from_be_bytes(b))),
            (Dtype::Float64, false) => convert(data, |b| T::from_f64(f64::from_le_bytes(b))),
            (Dtype::Float64, true) => convert(data, |b| T::from_f64(f64::from_be_bytes(b))),
            (Dtype::Uint8, _) => convert(data, |[b]: [u8; 1]| T::from_u16(u16::from(b))),
            (Dtype::Uint16, false) => convert(data, |b| T::from_u16(u16::from_le_bytes(b))),
            (Dtype::Uint16, true) => convert(data, |b| T::from_u16(u16::from_be_bytes(b))),
        };
        if self.header.fortran { last_axis_fastest(&stored, self.shape()) } else { stored }
    }
}

fn convert<const N: usize, T>(data: &[u8], number: impl Fn([u8; N]) -> T) -> Vec<T> {
    let (chunks, _) = data.as_chunks::<N>();
    chunks.iter().map(|bytes| number(*bytes)).collect()
}

/// Reorders numbers stored with the first axis fastest.
fn last_axis_fastest<T: Copy + Default>(stored: &[T], shape: &[usize]) -> Vec<T> {
    let mut index = vec![0_usize; shape.len()];
    let mut ordered = Vec::with_capacity(stored.len());
    for _ in 0..stored.len() {
        // Horner's rule from the slowest axis of the file, its last, to the fastest.
        let at = index.iter().zip(shape).rev().fold(0, |at, (i, length)| at * length + i);
        ordered.push(stored.get(at).copied().unwrap_or_default());
        for (i, length) in index.iter_mut().zip(shape).rev() {
            *i += 1;
            if *i < *length {
                break;
            }
            *i = 0;
        }
    }
    ordered
}
