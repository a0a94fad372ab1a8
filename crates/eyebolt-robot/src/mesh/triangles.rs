//! A surface of triangles.

use nalgebra::Point3;

/// Most triangles of one body.
pub const MAX_TRIANGLES: usize = 5_000_000;

/// A surface of triangles. Vertices are finite and shared by neighbours; every triangle has area.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Vertices, metres, in the link's frame.
    pub vertices: Vec<Point3<f32>>,
    /// Indices of the corners, counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Adds `other`, whose vertices are in the same frame.
    ///
    /// `None`, and nothing added, if the vertices no longer fit 32-bit indices.
    pub fn append(&mut self, other: &Self) -> Option<()> {
        let first = u32::try_from(self.vertices.len()).ok()?;
        let last = u32::try_from(other.vertices.len()).ok()?;
        first.checked_add(last)?;
        self.vertices.extend_from_slice(&other.vertices);
        self.triangles.extend(other.triangles.iter().map(|corners| corners.map(|i| first + i)));
        Some(())
    }

    /// Least and greatest coordinates, metres; `None` without vertices.
    pub fn bounds(&self) -> Option<(Point3<f32>, Point3<f32>)> {
        let first = *self.vertices.first()?;
        Some(
            self.vertices
                .iter()
                .fold((first, first), |(low, high), vertex| (low.inf(vertex), high.sup(vertex))),
        )
    }
}
