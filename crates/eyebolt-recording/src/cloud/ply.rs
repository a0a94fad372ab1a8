//! Clouds in PLY, the Stanford polygon format: the vertices; what else is there is skipped.
//!
//! Read by hand: `ply-rs-bw` (4.0) refuses the NaN of ASCII clouds, merges properties of one name
//! and so takes coordinates from the wrong place, and counts elements without properties as far
//! as the header says.

mod header;
mod records;
mod scalar;

use super::stored::{Stored, check_count, damaged};
use crate::error::RecordingError;
use header::{Element, Encoding, Header};
use records::{Ascii, Binary, Records};
use std::path::Path;

/// Reads a whole file; `path` is for messages.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Stored, RecordingError> {
    let header = Header::parse(path, bytes)?;
    check_count(path, header.vertex.count)?;
    let data = bytes.get(header.length..).unwrap_or(&[]);
    let xyz = match header.encoding {
        Encoding::Ascii => vertices(&mut Ascii::after(header.lines, data), &header),
        Encoding::LittleEndian => vertices(&mut Binary::new(data, false), &header),
        Encoding::BigEndian => vertices(&mut Binary::new(data, true), &header),
    };
    Ok(Stored { xyz: xyz.map_err(|problem| damaged(path, problem))?, grid: header.grid })
}

/// The coordinates of all vertices, or what is wrong.
fn vertices<R: Records>(records: &mut R, header: &Header) -> Result<Vec<f32>, String> {
    for element in &header.before {
        // Of such there may be any number in no bytes at all.
        if element.properties.is_empty() {
            continue;
        }
        for index in 0..element.count {
            record(records, element, index)?;
        }
    }
    let vertex = &header.vertex;
    let needed = records.least_size(vertex).checked_mul(vertex.count);
    if needed.is_none_or(|needed| needed > records.size()) {
        let (count, size) = (vertex.count, records.size());
        return Err(format!("the {size} bytes that are left cannot hold {count} vertices"));
    }
    let mut xyz = Vec::with_capacity(vertex.count.saturating_mul(3));
    for index in 0..vertex.count {
        xyz.extend(record(records, vertex, index)?);
    }
    Ok(xyz)
}

/// The coordinates among the properties of the next record, which is number `index` of `element`.
fn record<R: Records>(
    records: &mut R,
    element: &Element,
    index: usize,
) -> Result<[f32; 3], String> {
    let read = |records: &mut R| {
        let mut xyz = [f32::NAN; 3];
        records.begin()?;
        for property in &element.properties {
            let axis = property.axis.and_then(|(axis, float)| Some((xyz.get_mut(axis)?, float)));
            match (axis, property.length) {
                (Some((value, float)), _) => *value = records.float(float)?,
                (None, None) => records.skip(property.scalar, 1)?,
                (None, Some(scalar)) => {
                    let length = records.length(scalar)?;
                    records.skip(property.scalar, length)?;
                }
            }
        }
        records.end().map(|()| xyz)
    };
    read(records)
        .map_err(|problem| format!("{}{} {index}: {problem}", records.place(), element.name))
}
