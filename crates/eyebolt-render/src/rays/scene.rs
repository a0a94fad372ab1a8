//! Meshes in one frame, ready for rays.

use super::bounds::Corners;
use super::build::build;
use super::bvh::{Bvh, LANES};
use super::eye::Eye;
use eyebolt_geometry::{Base, Link, Transform};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Matrix3, Point3, Vector3};

/// A mesh of a scene and where it is.
#[derive(Clone, Copy, Debug)]
pub struct SceneMesh<'a> {
    /// The mesh, metres, in a frame of its own.
    pub mesh: &'a TriangleMesh,
    /// Where it is.
    pub base_from_mesh: Transform<Base, Link>,
}

/// The triangles of some meshes, sorted into boxes: what rays are cast into.
///
/// Both sides of a triangle are hit. Triangles without an area, or with a corner that is not
/// finite, never are.
#[derive(Clone, Debug)]
pub struct RayScene {
    pub(super) bvh: Bvh,
    /// Of each triangle: its mesh, and which one it is there.
    pub(super) sources: Vec<(u16, u32)>,
    /// Middle of the scene in the base frame, metres: where its coordinates are zero.
    centre: Vector3<f64>,
    /// A power of two, so that all coordinates are within -1 and 1 and none of their products
    /// leaves the range of a float.
    units_per_metre: f64,
}

impl RayScene {
    /// The scene of `meshes`, at most `u16::MAX` of them: those beyond are not seen. Their
    /// order is what [`IdealView::surface`](crate::IdealView::surface) counts in.
    pub fn new(meshes: &[SceneMesh<'_>]) -> Self {
        let triangles: Vec<Triangle> = meshes.iter().zip(0..u16::MAX).flat_map(triangles).collect();
        let (centre, units_per_metre) = frame(&triangles);
        let in_scene = |p: Vector3<f64>| ((p - centre) * units_per_metre).map(|v| v as f32).into();
        let solid = |triangle: &Triangle| {
            let corners: Corners = triangle.corners.map(in_scene);
            let source = (triangle.mesh, triangle.index);
            (normal(&corners).norm_squared() > 0.0).then_some((corners, source))
        };
        let (corners, sources): (Vec<_>, _) = triangles.iter().filter_map(solid).unzip();
        Self { bvh: build(&corners), sources, centre, units_per_metre }
    }

    /// The eye at a point of the base frame, its axes the rows of `eye_from_base`.
    pub(super) fn eye(&self, origin_in_base: &Point3<f64>, eye_from_base: &Matrix3<f64>) -> Eye {
        let origin = (origin_in_base.coords - self.centre) * self.units_per_metre;
        Eye::new(&origin, eye_from_base)
    }

    /// Metres per unit of the scene.
    pub(super) fn metres(&self) -> f64 {
        1.0 / self.units_per_metre
    }

    /// A unit normal of the triangle at `place`, base frame, on either side.
    pub(super) fn normal(&self, place: u32) -> Vector3<f64> {
        let (leaf, lane) = (place as usize / LANES, place as usize % LANES);
        let corners = self.bvh.leaves[leaf].corners.map(|axes| axes.map(|axis| axis[lane]));
        normal(&corners).normalize()
    }

    /// Mesh of the triangle at `place`, and its index there.
    pub(super) fn source(&self, place: u32) -> (u16, u32) {
        let triangle = self.bvh.triangles[place as usize / LANES][place as usize % LANES];
        self.sources[triangle as usize]
    }
}

/// A triangle of a mesh, corners in the base frame, metres.
struct Triangle {
    corners: [Vector3<f64>; 3],
    mesh: u16,
    index: u32,
}

/// The triangles whose corners exist and are finite.
fn triangles((posed, mesh): (&SceneMesh<'_>, u16)) -> impl Iterator<Item = Triangle> {
    let in_base = |v: &Point3<f32>| posed.base_from_mesh.point(&v.cast()).coords;
    let vertices: Vec<Vector3<f64>> = posed.mesh.vertices.iter().map(in_base).collect();
    let triangle = move |(corners, index): (&[u32; 3], u32)| {
        let [a, b, c] = corners.map(|i| vertices.get(i as usize).copied());
        let corners = [a?, b?, c?];
        let finite = corners.iter().flatten().all(|v| v.is_finite());
        finite.then_some(Triangle { corners, mesh, index })
    };
    posed.mesh.triangles.iter().zip(0..).filter_map(triangle)
}

/// Normal of a triangle, as long as twice its area.
fn normal(corners: &Corners) -> Vector3<f64> {
    let [a, b, c] = corners.map(|corner| Vector3::from(corner.map(f64::from)));
    (b - a).cross(&(c - a))
}

/// Middle of the box around all corners, and the scale at which it reaches from -1 to 1 at most.
fn frame(triangles: &[Triangle]) -> (Vector3<f64>, f64) {
    let mut corners = triangles.iter().flat_map(|triangle| triangle.corners);
    let Some(first) = corners.next() else { return (Vector3::zeros(), 1.0) };
    let (low, high) = corners.fold((first, first), |(l, h), p| (l.inf(&p), h.sup(&p)));
    let half = (high - low).amax() * 0.5;
    // A scene that is one point keeps its metres.
    let exponent = if half > 0.0 { half.log2().ceil() } else { 0.0 };
    ((low + high) * 0.5, (-exponent).exp2())
}
