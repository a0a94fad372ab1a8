//! What holds each vertex to the surface that was there before.

use super::quadric::Quadric;
use super::surface::Surface;
use nalgebra::{Point3, Unit, Vector3, center};

/// The planes that each vertex stands for: those of the triangles that have been merged into it.
pub(super) struct Constraints {
    tolerance_m: f64,
    /// Of the triangles around, weighted by area.
    faces: Vec<Quadric>,
    /// Of the upright planes along rims. On their own, since planes that a vertex does not leave
    /// would else hide in the mean how far it leaves the others.
    rims: Vec<Quadric>,
    on_rim: Vec<bool>,
    /// The same triangles one by one, as indices into `planes`.
    standing_for: Vec<Vec<u32>>,
    planes: Vec<Option<Plane>>,
}

struct Plane {
    normal: Vector3<f64>,
    point: Point3<f64>,
}

/// How far from any one plane a vertex may be, in tolerances: a large flat face would else hide
/// in the mean that a small knob on it was lost. On a sphere the mean is the stricter one (there
/// the farthest plane is at 1.73 times the mean).
const FARTHEST: f64 = 2.0;

impl Constraints {
    pub(super) fn of(surface: &Surface, tolerance_m: f64) -> Self {
        let count = surface.points.len();
        let mut constraints = Self {
            tolerance_m,
            faces: vec![Quadric::default(); count],
            rims: vec![Quadric::default(); count],
            on_rim: vec![false; count],
            standing_for: vec![Vec::new(); count],
            planes: Vec::with_capacity(surface.triangles.len()),
        };
        for index in 0..surface.triangles.len() as u32 {
            constraints.add_face(surface, index);
        }
        constraints
    }

    fn add_face(&mut self, surface: &Surface, index: u32) {
        let triangle = surface.triangles[index as usize];
        let corners = surface.corners(index);
        let normal = surface::area_normal(&corners);
        let plane = Unit::try_new_and_get(normal, 0.0);
        self.planes.push(plane.map(|(normal, _)| Plane { normal: *normal, point: corners[0] }));
        todo!()
    }
}
