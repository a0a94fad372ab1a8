//! Triangles that know their neighbours while edges collapse.

use super::weld::welded;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};

/// A soup of triangles with shared vertices.
pub(super) struct Surface {
    /// Vertices, metres; those that have gone stay in place, unused.
    pub(super) points: Vec<Point3<f64>>,
    /// Corners; of those that have gone, as they were last.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The triangles at each vertex: what is in no list has gone.
    around: Vec<Vec<u32>>,
}

/// Least cosine between the normals of a triangle before and after: 60 degrees. Those that turn
/// more are about to fold over.
const LEAST_COSINE: f64 = 0.5;
/// Height over longest side below which a triangle counts as a line. Its normal is noise of the
/// single-precision file.
const THINNEST: f64 = 1e-5;
/// Least share of the area around an edge that is left when seen from its mean normal.
const ONE_SIDED: f64 = 0.5;
/// Twice the area, square metres, under which a triangle is not drawn, as meshes are read.
const LEAST_DOUBLE_AREA: f64 = 1e-12;

impl Surface {
    /// The triangles of `mesh`, welded.
    pub(super) fn of(mesh: &TriangleMesh) -> Self {
        let (points, triangles) = welded(mesh);
        let mut around = vec![Vec::new(); points.len()];
        for (triangle, index) in triangles.iter().zip(0..) {
            for corner in triangle {
                around[*corner as usize].push(index);
            }
        }
        Self { points, triangles, around }
    }

    /// Every edge once, in order, the lower end first.
    pub(super) fn edges(&self) -> Vec<[u32; 2]> {
        let above = |vertex: u32| {
            let ends = self.ring(vertex).into_iter().map(move |other| [vertex, other]);
            ends.filter(|[lower, upper]| lower < upper)
        };
        (0..self.points.len() as u32).flat_map(above).collect()
    }

    /// The vertices that share an edge with `vertex`, in order.
    pub(super) fn ring(&self, vertex: u32) -> Vec<u32> {
        let corners = self.triangles_at(vertex).flatten();
        let mut ring: Vec<u32> = corners.filter(|corner| *corner != vertex).collect();
        ring.sort_unstable();
        ring.dedup();
        ring
    }

    /// Whether the surface ends, branches or meets another part at the edge.
    pub(super) fn is_rim(&self, u: u32, v: u32) -> bool {
        self.triangles_with(u, v).count() != 2
    }

    /// Whether the edge from `kept` to `gone` may become a point at `target`: nothing is pinched
    /// together, no triangle folds over or becomes a line. `on_rims` tells that both ends are on
    /// rims.
    pub(super) fn stays_sound(
        &self,
        kept: u32,
        gone: u32,
        on_rims: bool,
        target: &Point3<f64>,
    ) -> bool {
        // Between two rims the sheet would be pinched to a point.
        if on_rims && !self.is_rim(kept, gone) {
            return false;
        }
        self.links_agree(kept, gone)
            && self.turns_little(kept, gone, target)
            && self.turns_little(gone, kept, target)
    }

    /// The link condition (Dey et al., 1999): the ends have no neighbours in common but across
    /// the triangles that go, and no triangle comes to lie on another.
    fn links_agree(&self, u: u32, v: u32) -> bool {
        // Looking from the end with fewer triangles: the hub of a fan may have thousands.
        let [few, many] = if self.around[u as usize].len() < self.around[v as usize].len() {
            [u, v]
        } else {
            [v, u]
        };
        let across: Vec<u32> = self.triangles_with(few, many).flatten().collect();
        self.triangles_at(few).filter(|triangle| !triangle.contains(&many)).all(|triangle| {
            let common = |corner: &u32| self.triangles_with(*corner, many).next().is_some();
            let [a, b] = others(triangle, few);
            let apart = [a, b].iter().all(|corner| across.contains(corner) || !common(corner));
            apart && !self.triangles_with(a, b).any(|other| other.contains(&many))
        })
    }

    /// Whether the triangles at `vertex` that do not have `other` keep their sides when `vertex`
    /// moves to `target`.
    fn turns_little(&self, vertex: u32, other: u32, target: &Point3<f64>) -> bool {
        self.triangles_at(vertex).filter(|triangle| !triangle.contains(&other)).all(|triangle| {
            let before = self.corners(triangle);
            if is_line(&before) {
                return true;
            }
            let at =
                |corner: u32| if corner == vertex { *target } else { self.points[corner as usize] };
            let after = triangle.map(at);
            let (old, new) = (area_normal(&before), area_normal(&after));
            !is_line(&after) && old.dot(&new) > LEAST_COSINE * old.norm() * new.norm()
        })
    }

    /// The plane on which the edge between `u` and `v` collapses without change of the volume
    /// below the surface (Lindstrom and Turk, 1998), as a normal and a point. The least error
    /// alone lies inside of what bends outward: a ball would shrink by a third of the tolerance.
    pub(super) fn same_volume(&self, u: u32, v: u32) -> Option<(Vector3<f64>, Point3<f64>)> {
        let origin = self.points[u as usize];
        let only_v = self.triangles_at(v).filter(|triangle| !triangle.contains(&u));
        let (mut normals, mut areas, mut height) = (Vector3::zeros(), 0.0, 0.0);
        for triangle in self.triangles_at(u).chain(only_v) {
            let corners = self.corners(triangle);
            let normal = area_normal(&corners);
            normals += normal;
            areas += normal.norm();
            height += normal.dot(&(corners[0] - origin));
        }
        let square = normals.norm_squared();
        // Triangles that face anyhow, or a fin: there is no volume to speak of.
        let one_sided = square > (ONE_SIDED * areas).powi(2);
        one_sided.then(|| (normals, origin + normals * (height / square)))
    }

    /// Makes the edge a point, called `kept`, at `target`.
    pub(super) fn collapse(&mut self, kept: u32, gone: u32, target: Point3<f64>) {
        self.points[kept as usize] = target;
        for index in std::mem::take(&mut self.around[gone as usize]) {
            let triangle = self.triangles[index as usize];
            if triangle.contains(&kept) {
                for corner in triangle {
                    self.around[corner as usize].retain(|other| *other != index);
                }
                continue;
            }
            let renamed = triangle.map(|corner| if corner == gone { kept } else { corner });
            self.triangles[index as usize] = renamed;
            self.around[kept as usize].push(index);
        }
    }

    /// What is left, without the triangles that are lines and the vertices of none.
    pub(super) fn into_mesh(self) -> TriangleMesh {
        let vertices: Vec<Point3<f32>> = self.points.iter().map(|point| point.cast()).collect();
        let mut left: Vec<u32> = self.around.into_iter().flatten().collect();
        left.sort_unstable();
        left.dedup();
        let mut triangles: Vec<[u32; 3]> =
            left.iter().map(|index| self.triangles[*index as usize]).collect();
        triangles.retain(|triangle| {
            let corners = triangle.map(|corner| vertices[corner as usize].cast::<f64>());
            area_normal(&corners).norm() > LEAST_DOUBLE_AREA
        });
        let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let renumbered = |corner: u32| used.partition_point(|other| *other < corner) as u32;
        TriangleMesh {
            vertices: used.iter().map(|corner| vertices[*corner as usize]).collect(),
            triangles: triangles.iter().map(|triangle| triangle.map(renumbered)).collect(),
        }
    }

    /// Where the corners of the triangle are, metres.
    pub(super) fn corners(&self, triangle: [u32; 3]) -> [Point3<f64>; 3] {
        triangle.map(|corner| self.points[corner as usize])
    }

    /// The triangles on the edge between `u` and `v`.
    fn triangles_with(&self, u: u32, v: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        let [at_u, at_v] = [u, v].map(|end| self.around[end as usize].len());
        let [few, many] = if at_u < at_v { [u, v] } else { [v, u] };
        self.triangles_at(few).filter(move |triangle| triangle.contains(&many))
    }

    fn triangles_at(&self, vertex: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.around[vertex as usize].iter().map(|index| self.triangles[*index as usize])
    }
}

/// The two corners besides `corner`.
fn others([a, b, c]: [u32; 3], corner: u32) -> [u32; 2] {
    match corner {
        _ if corner == a => [b, c],
        _ if corner == b => [c, a],
        _ => [a, b],
    }
}

/// Whether the triangle is so thin that its normal says nothing.
fn is_line(corners: &[Point3<f64>; 3]) -> bool {
    let [a, b, c] = corners;
    let longest = (b - a).norm_squared().max((c - b).norm_squared()).max((a - c).norm_squared());
    // Neither what is not a number nor what has no extent is thick.
    let is_thick = area_normal(corners).norm() > THINNEST * longest;
    !is_thick
}

/// Twice the area times the unit normal.
pub(super) fn area_normal([a, b, c]: &[Point3<f64>; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a))
}
