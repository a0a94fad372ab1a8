//! An archive out.

use super::parts::{CENTRAL, END, LOCAL};
use eyebolt_recording::write_npy;

/// An array by its name.
pub(in crate::dataset) struct Array<'a> {
    pub(in crate::dataset) name: &'a str,
    npy: Vec<u8>,
}

impl<'a> Array<'a> {
    pub(in crate::dataset) fn float32(
        name: &'a str,
        shape: &[usize],
        values: impl IntoIterator<Item = f32>,
    ) -> Self {
        Self { name, npy: write_npy("<f4", shape, values.into_iter().flat_map(f32::to_le_bytes)) }
    }

    pub(in crate::dataset) fn float64(
        name: &'a str,
        shape: &[usize],
        values: impl IntoIterator<Item = f64>,
    ) -> Self {
        Self { name, npy: write_npy("<f8", shape, values.into_iter().flat_map(f64::to_le_bytes)) }
    }

    pub(in crate::dataset) fn uint8(
        name: &'a str,
        shape: &[usize],
        values: impl IntoIterator<Item = u8>,
    ) -> Self {
        Self { name, npy: write_npy("|u1", shape, values) }
    }
}

/// Midnight of the first of January 1980, the first moment that ZIP knows: files of the same numbers
/// have the same bytes.
const TIME: u16 = 0;
const DATE: u16 = 0x21;
/// Version 2.0 of the format is needed to read it.
const VERSION: u16 = 20;

/// A file of `arrays`, of less than 4 GiB in all.
pub(in crate::dataset) fn npz(arrays: &[Array<'_>]) -> Vec<u8> {
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for Array { name, npy } in arrays {
        let name = format!("{name}.npy");
        let offset = file.len() as u32;
        // The same in both places: no flags, stored, time, checksum, lengths.
        let mut common = Vec::new();
        for number in [VERSION, 0, 0, TIME, DATE] {
            common.extend(number.to_le_bytes());
        }
        for number in [crc32fast::hash(npy), npy.len() as u32, npy.len() as u32] {
            common.extend(number.to_le_bytes());
        }
        common.extend((name.len() as u16).to_le_bytes());
        file.extend(LOCAL.to_le_bytes());
        file.extend(&common);
        file.extend([0; 2]);
        file.extend(name.as_bytes());
        file.extend(npy);
        directory.extend(CENTRAL.to_le_bytes());
        directory.extend(VERSION.to_le_bytes());
        directory.extend(&common);
        // No extras, no comment, first disk, no attributes.
        directory.extend([0; 12]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let (offset, count) = (file.len() as u32, arrays.len() as u16);
    file.extend(&directory);
    file.extend(END.to_le_bytes());
    file.extend([0; 4]);
    file.extend(count.to_le_bytes());
    file.extend(count.to_le_bytes());
    file.extend((directory.len() as u32).to_le_bytes());
    file.extend(offset.to_le_bytes());
    file.extend([0; 2]);
    file
}
