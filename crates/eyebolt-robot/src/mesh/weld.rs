//! From what a file says to a mesh whose neighbouring triangles share vertices.

use super::error::{Fault, check_count};
use super::raw::RawMesh;
use super::triangles::TriangleMesh;
use nalgebra::Point3;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Twice the area, in square metres, under which a triangle is a line: half a square micrometre.
const LEAST_DOUBLE_AREA: f64 = 1e-12;

/// Moves the vertices, merges equal ones, and drops triangles without area and vertices without
/// triangles. `mirrored` turns the triangles around.
pub(super) fn weld(
    raw: &RawMesh,
    mirrored: bool,
    placed: impl Fn(Point3<f64>) -> Point3<f64>,
) -> Result<TriangleMesh, Fault> {
    check_count(raw.triangles.len())?;
    let mut welder = Welder {
        positions: &raw.positions,
        known: vec![u32::MAX; raw.positions.len()],
        by_place: HashMap::with_capacity(raw.triangles.len()),
        vertices: Vec::new(),
        placed,
    };
    let mut triangles = Vec::with_capacity(raw.triangles.len());
    for (index, [a, b, c]) in raw.triangles.iter().enumerate() {
        let at = |fault: String| Fault::invalid(format!("triangle {index}"), fault);
        let a = welder.vertex(*a).map_err(at)?;
        let b = welder.vertex(*b).map_err(at)?;
        let c = welder.vertex(*c).map_err(at)?;
        if welder.has_area(a, b, c) {
            triangles.push(if mirrored { [a, c, b] } else { [a, b, c] });
        }
    }
    Ok(without_loose_vertices(welder.vertices, triangles))
}

struct Welder<'m, P> {
    positions: &'m [Point3<f32>],
    /// Per position of the file: its vertex, or `u32::MAX`.
    known: Vec<u32>,
    by_place: HashMap<[u32; 3], u32>,
    vertices: Vec<Point3<f32>>,
    placed: P,
}

impl<P: Fn(Point3<f64>) -> Point3<f64>> Welder<'_, P> {
    fn vertex(&mut self, index: u32) -> Result<u32, String> {
        let position = usize::try_from(index).ok();
        let slot = position.and_then(|index| self.known.get_mut(index));
        let position = position.and_then(|index| self.positions.get(index));
        let (Some(slot), Some(position)) = (slot, position) else {
            let count = self.positions.len();
            return Err(format!("vertex {index} (from 0), but there are {count}"));
        };
        if *slot != u32::MAX {
            return Ok(*slot);
        }
        let place = (self.placed)(position.cast::<f64>()).cast::<f32>();
        if !place.iter().all(|v| v.is_finite()) {
            return Err(format!("vertex {index} (from 0) is not finite"));
        }
        // Adding zero makes -0 and 0 one key.
        let next =
            u32::try_from(self.vertices.len()).map_err(|_| "too many vertices".to_owned())?;
        let key = [place.x, place.y, place.z].map(|v| (v + 0.0).to_bits());
        *slot = match self.by_place.entry(key) {
            Entry::Occupied(vertex) => *vertex.get(),
            Entry::Vacant(free) => {
                self.vertices.push(place);
                *free.insert(next)
            }
        };
        Ok(*slot)
    }

    fn has_area(&self, a: u32, b: u32, c: u32) -> bool {
        let point =
            |index: u32| Some(self.vertices.get(usize::try_from(index).ok()?)?.cast::<f64>());
        let (Some(a), Some(b), Some(c)) = (point(a), point(b), point(c)) else { return false };
        (b - a).cross(&(c - a)).norm() > LEAST_DOUBLE_AREA
    }
}

fn without_loose_vertices(
    vertices: Vec<Point3<f32>>,
    mut triangles: Vec<[u32; 3]>,
) -> TriangleMesh {
    let mut renamed = vec![u32::MAX; vertices.len()];
    let mut kept = Vec::with_capacity(vertices.len());
    for corner in triangles.iter_mut().flatten() {
        let old = *corner as usize;
        if let (Some(new), Some(vertex)) = (renamed.get_mut(old), vertices.get(old)) {
            if *new == u32::MAX {
                *new = kept.len() as u32;
                kept.push(*vertex);
            }
            *corner = *new;
        }
    }
    TriangleMesh { vertices: kept, triangles }
}
