//! Wavefront OBJ: positions and faces; normals, texture and materials don't matter here.

use super::error::{Fault, check_count};
use super::raw::RawMesh;
use nalgebra::Point3;

/// Positions and faces of all groups. Faces of more than three corners are cut into fans, which is
/// right for convex ones.
pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, Fault> {
    // Names may be in any encoding; numbers are ASCII.
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = RawMesh::default();
    for (number, line) in text.lines().enumerate() {
        let mut words = line.split_ascii_whitespace();
        let read = match words.next() {
            Some("v") => position(words).map(|position| mesh.positions.push(position)),
            Some("f") => face(words, &mut mesh),
            _ => Ok(()),
        };
        read.map_err(|problem| Fault::invalid(format!("line {}", number + 1), problem))?;
        check_count(mesh.triangles.len())?;
    }
    Ok(mesh)
}

fn position<'a>(mut words: impl Iterator<Item = &'a str>) -> Result<Point3<f32>, String> {
    let mut number = || {
        let word = words.next().unwrap_or_default();
        word.parse::<f32>().map_err(|_| format!("`{word}` is not a coordinate"))
    };
    let position = Point3::new(number()?, number()?, number()?);
    if position.iter().all(|v| v.is_finite()) {
        Ok(position)
    } else {
        Err("a coordinate is not finite".to_owned())
    }
}

fn face<'a>(words: impl Iterator<Item = &'a str>, mesh: &mut RawMesh) -> Result<(), String> {
    let mut corners = words.map(|word| corner(word, mesh.positions.len()));
    let mut next = || corners.next().transpose();
    let (Some(first), Some(mut second)) = (next()?, next()?) else {
        return Err("a face with fewer than 3 corners".to_owned());
    };
    let mut fan = Vec::new();
    while let Some(third) = next()? {
        fan.push([first, second, third]);
        second = third;
    }
    if fan.is_empty() {
        return Err("a face with fewer than 3 corners".to_owned());
    }
    mesh.triangles.extend(fan);
    Ok(())
}

/// Index from 0 of the position of a corner `position/texture/normal`, which counts from 1, or
/// back from the newest position if negative.
fn corner(word: &str, positions: usize) -> Result<u32, String> {
    let number = word.split('/').next().unwrap_or_default();
    let index = number.parse::<i64>().map_err(|_| format!("`{word}` is not a corner"))?;
    let count = i64::try_from(positions).unwrap_or(i64::MAX);
    let from_zero = if index < 0 { index.saturating_add(count) } else { index - 1 };
    if (0..count).contains(&from_zero)
        && let Ok(from_zero) = u32::try_from(from_zero)
    {
        return Ok(from_zero);
    }
    Err(format!("vertex {index} (from 1), but there are {count} so far"))
}
