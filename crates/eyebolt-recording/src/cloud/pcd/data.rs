//! The points of a PCD file. Binary ones are little-endian, which is what PCL runs on.

use super::header::Header;
use super::layout::{Axis, Layout};
use crate::cloud::stored::{damaged, invalid};
use crate::cloud::text::{Lines, excerpt, words};
use crate::error::RecordingError;
use std::path::Path;

/// From text, a line for every point.
pub(super) fn ascii(path: &Path, data: &[u8], header: &Header) -> Result<Vec<f32>, RecordingError> {
    let (layout, count) = (&header.layout, header.count);
    // A word takes a byte and one that ends it, but for the last.
    let least = layout.words.checked_mul(2).and_then(|point| point.checked_mul(count));
    if least.is_none_or(|least| least > data.len().saturating_add(1)) {
        let problem = format!("{} bytes cannot hold {count} points", data.len());
        return Err(damaged(path, problem));
    }
    let mut xyz = Vec::with_capacity(count.saturating_mul(3));
    let mut lines = Lines::after(header.lines, data);
    while let Some(line) = lines.next() {
        let point = point(layout, line).map_err(|problem| {
            let remedy = "The file is damaged, or FIELDS and COUNT do not fit it: write it again";
            invalid(path, format!("line {}: {problem}", lines.number()), remedy)
        })?;
        xyz.extend(point);
    }
    let found = xyz.len() / 3;
    if found != count {
        return Err(damaged(path, format!("POINTS is {count}, but {found} follow")));
    }
    Ok(xyz)
}

/// The point of a line, or what is wrong with it.
fn point(layout: &Layout, line: &[u8]) -> Result<[f32; 3], String> {
    let mut xyz = [f32::NAN; 3];
    let mut found = 0_usize;
    for (index, word) in words(line).enumerate() {
        found += 1;
        // Another field's word fits no axis; it may be of any type.
        let axis = layout.axes.iter().zip(&mut xyz).find(|(axis, _)| axis.word == index);
        if let Some((axis, value)) = axis {
            let number = axis.float.parse(word);
            *value = number.ok_or_else(|| format!("\"{}\" is not a number", excerpt(word)))?;
        }
    }
    if found != layout.words {
        return Err(format!("found {found} numbers, expected {}", layout.words));
    }
    Ok(xyz)
}

/// From bytes, one point after the other.
pub(super) fn rows(data: &[u8], layout: &Layout, count: usize) -> Vec<f32> {
    let coordinate = |point: &[u8], axis: &Axis| {
        let bytes = point.get(axis.offset..)?;
        axis.float.read(bytes, false)
    };
    let points = data.chunks_exact(layout.stride).take(count);
    let xyz =
        |point| layout.axes.each_ref().map(|axis| coordinate(point, axis).unwrap_or(f32::NAN));
    points.flat_map(xyz).collect()
}

/// From bytes, all numbers of one field after all of another.
pub(super) fn columns(data: &[u8], layout: &Layout, count: usize) -> Vec<f32> {
    let [x, y, z] = layout.axes.each_ref().map(|axis| {
        let start = axis.offset.saturating_mul(count);
        let bytes = data.get(start..).unwrap_or(&[]).chunks_exact(axis.float.size()).take(count);
        bytes.map(|bytes| axis.float.read(bytes, false).unwrap_or(f32::NAN))
    });
    x.zip(y).zip(z).flat_map(|((x, y), z)| [x, y, z]).collect()
}
