//! STL, binary and text: three corners per triangle, nothing shared, no unit (metres in URDF).

use super::error::{Fault, check_count};
use super::raw::RawMesh;
use nalgebra::Point3;

const HEADER: usize = 80;
const TRIANGLE: usize = 50;

/// Triangles with three positions of their own each.
pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, Fault> {
    // Binary files may start with the word "solid" too, so the length decides first.
    let announced = announced_triangles(bytes);
    let expected = announced.map(file_length);
    if expected != Some(bytes.len() as u64) && looks_like_text(bytes) {
        return read_text(bytes);
    }
    match (announced, expected) {
        (Some(count), Some(expected)) if expected == bytes.len() as u64 => {
            check_count(count as usize)?;
            read_binary(bytes)
        }
        (Some(count), Some(expected)) => Err(Fault::invalid(
            "triangle count",
            format!(
                "the header announces {count} triangles in {expected} bytes, but the file has {}",
                bytes.len()
            ),
        )),
        _ => Err(Fault::invalid(
            "header",
            format!("{} bytes are fewer than the {} of an STL header", bytes.len(), HEADER + 4),
        )),
    }
}

/// Bytes that [`check_header`] looks at.
pub(super) const HEADER_AND_COUNT: u64 = HEADER as u64 + 4;

/// Refuses a binary file of `length` bytes by its first ones, before time and memory are spent on
/// the rest.
pub(super) fn check_header(first: &[u8], length: u64) -> Result<(), Fault> {
    match announced_triangles(first) {
        Some(count) if file_length(count) == length => check_count(count as usize),
        // Text, or a file that `read` has something to say about.
        _ => Ok(()),
    }
}

/// Bytes of a binary file of `count` triangles.
fn file_length(count: u32) -> u64 {
    u64::from(count) * TRIANGLE as u64 + HEADER_AND_COUNT
}

fn announced_triangles(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER..HEADER + 4)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

fn looks_like_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
        && !start.iter().take(512).any(|byte| *byte == 0)
}

fn read_binary(bytes: &[u8]) -> Result<RawMesh, Fault> {
    let records = bytes.get(HEADER + 4..).unwrap_or_default();
    let mut mesh = RawMesh::default();
    mesh.positions.reserve(records.len() / TRIANGLE * 3);
    for record in records.chunks_exact(TRIANGLE) {
        // The normal comes first; what it says follows from the corners.
        let corners = record.get(12..48).unwrap_or_default();
        let mut numbers = corners
            .chunks_exact(4)
            .filter_map(|number| Some(f32::from_le_bytes(number.try_into().ok()?)));
        while let (Some(x), Some(y), Some(z)) = (numbers.next(), numbers.next(), numbers.next()) {
            mesh.positions.push(Point3::new(x, y, z));
        }
    }
    number_corners(mesh)
}

fn read_text(bytes: &[u8]) -> Result<RawMesh, Fault> {
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = RawMesh::default();
    let mut corners_of_facet = None;
    for (number, line) in text.lines().enumerate() {
        let at = |problem: String| Fault::invalid(format!("line {}", number + 1), problem);
        let mut words = line.split_ascii_whitespace();
        let word = words.next().unwrap_or_default();
        if word.eq_ignore_ascii_case("facet") {
            corners_of_facet = Some(0);
        } else if word.eq_ignore_ascii_case("vertex") {
            let count =
                corners_of_facet.as_mut().ok_or_else(|| at("vertex outside a facet".into()))?;
            *count += 1;
            let position =
                point(words).ok_or_else(|| at(format!("`{}` is not a vertex", line.trim())))?;
            mesh.positions.push(position);
        } else if word.eq_ignore_ascii_case("endfacet") {
            match corners_of_facet.take() {
                Some(3) => check_count(mesh.positions.len() / 3)?,
                count => {
                    let count = count.unwrap_or(0);
                    return Err(at(format!("a facet with {count} vertices instead of 3")));
                }
            }
        }
    }
    if corners_of_facet.is_some() {
        return Err(Fault::invalid("end of file", "the last facet is cut off"));
    }
    number_corners(mesh)
}

fn point<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<Point3<f32>> {
    let mut number = || words.next()?.parse().ok();
    Some(Point3::new(number()?, number()?, number()?))
}

fn number_corners(mut mesh: RawMesh) -> Result<RawMesh, Fault> {
    let count = u32::try_from(mesh.positions.len()).map_err(|_| Fault::TooManyTriangles)?;
    mesh.triangles = (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Ok(mesh)
}
