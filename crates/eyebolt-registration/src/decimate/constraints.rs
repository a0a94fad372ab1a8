//! What holds each vertex to the surface that was there before.

use super::quadric::{Optimum, Quadric};
use super::surface::{Surface, area_normal};
use nalgebra::{Point3, Vector3, center};

/// The planes that each vertex stands for: those of all triangles that were merged into it.
pub(super) struct Constraints {
    tolerance_m: f64,
    /// Planes of the triangles, weighted by area.
    faces: Vec<Quadric>,
    /// Upright planes along rims. On their own, since planes that a vertex does not leave would
    /// else hide in the mean how far it leaves the others.
    rims: Vec<Quadric>,
    on_rim: Vec<bool>,
    planes: Vec<Plane>,
    /// The planes that each vertex stands for one by one, as indices.
    held_by: Vec<Vec<u32>>,
}

/// A plane by its unit normal and one of its points, metres.
struct Plane {
    normal: Vector3<f64>,
    point: Point3<f64>,
}

/// How far from any one plane a vertex may be, in tolerances: a wide face would else hide in the
/// mean that a small knob on it was lost. On a sphere, where the farthest plane is 1.7 times the
/// mean away, the mean still decides.
const FARTHEST: f64 = 2.0;

/// Below this error, in tolerances, a place is as good as where the surface was.
const EXACT: f64 = 1e-3;

impl Constraints {
    /// Each vertex stands for the triangles and rims around it.
    pub(super) fn of(surface: &Surface, tolerance_m: f64) -> Self {
        let count = surface.points.len();
        let mut constraints = Self {
            tolerance_m,
            faces: vec![Quadric::default(); count],
            rims: vec![Quadric::default(); count],
            on_rim: vec![false; count],
            planes: Vec::new(),
            held_by: vec![Vec::new(); count],
        };
        for triangle in &surface.triangles {
            let corners = surface.corners(*triangle);
            let across = area_normal(&corners);
            // A triangle without area has no plane; its neighbours' planes hold its corners.
            if let Some(normal) = across.try_normalize(0.0) {
                constraints.add_face(triangle, normal, &corners, 0.5 * across.norm());
                constraints.add_rims(surface, triangle, &normal);
            }
        }
        constraints
    }

    fn add_face(
        &mut self,
        triangle: &[u32; 3],
        normal: Vector3<f64>,
        corners: &[Point3<f64>; 3],
        area: f64,
    ) {
        let quadric = Quadric::plane(&normal, &corners[0], area);
        for corner in triangle {
            self.faces[*corner as usize] += quadric;
            self.held_by[*corner as usize].push(self.planes.len() as u32);
        }
        self.planes.push(Plane { normal, point: corners[0] });
    }

    /// Stands a plane on each side of the triangle that is a rim.
    fn add_rims(&mut self, surface: &Surface, triangle: &[u32; 3], normal: &Vector3<f64>) {
        let [a, b, c] = *triangle;
        for [from, to] in [[a, b], [b, c], [c, a]] {
            if !surface.is_rim(from, to) {
                continue;
            }
            let [start, end] = [from, to].map(|corner| surface.points[corner as usize]);
            let Some(upright) = (end - start).cross(normal).try_normalize(0.0) else { continue };
            let quadric = Quadric::plane(&upright, &start, (end - start).norm_squared());
            for corner in [from, to] {
                self.rims[corner as usize] += quadric;
                self.on_rim[corner as usize] = true;
                self.held_by[corner as usize].push(self.planes.len() as u32);
            }
            self.planes.push(Plane { normal: upright, point: start });
        }
    }

    /// Where the edge between `ends` is best collapsed to, and the error there, metres; `None` if
    /// the error is beyond the tolerance everywhere.
    pub(super) fn best_target(
        &self,
        surface: &Surface,
        ends: [u32; 2],
    ) -> Option<(Point3<f64>, f64)> {
        let [u, v] = ends.map(|end| end as usize);
        let points = [surface.points[u], surface.points[v]];
        let middle = center(&points[0], &points[1]);
        let faces = self.faces[u] + self.faces[v];
        let rims = self.rims[u] + self.rims[v];
        let error = |point: &Point3<f64>| faces.mean_square(point).max(rims.mean_square(point));
        let better = |best: (Point3<f64>, f64), point| {
            let square = error(&point);
            if square < best.1 { (point, square) } else { best }
        };
        let optimum = (faces + rims).optimum(&middle);
        let start = optimum.as_ref().map_or(middle, Optimum::point);
        let (mut point, mut square) = points.into_iter().fold((start, error(&start)), better);
        // What is exact, as a corner is, keeps the volume as well as anything.
        if square > (EXACT * self.tolerance_m).powi(2) {
            let level = optimum.zip(surface.same_volume(ends[0], ends[1]));
            let level = level.and_then(|(optimum, plane)| optimum.on(&plane));
            let level = level.map(|level| (level, error(&level)));
            let within = |(_, square): &(_, f64)| square.sqrt() < self.tolerance_m;
            (point, square) = level.filter(within).unwrap_or((point, square));
        }
        let error_m = square.sqrt();
        (error_m < self.tolerance_m).then_some((point, error_m))
    }

    /// Whether a vertex at `target` is near every plane that the two vertices stand for.
    pub(super) fn keep_near(&self, u: u32, v: u32, target: &Point3<f64>) -> bool {
        let mut held_by = [u, v].into_iter().flat_map(|vertex| &self.held_by[vertex as usize]);
        held_by.all(|index| {
            let plane = &self.planes[*index as usize];
            plane.normal.dot(&(target - plane.point)).abs() < FARTHEST * self.tolerance_m
        })
    }

    /// Whether the surface ended or branched where the two vertices are.
    pub(super) fn both_on_rims(&self, u: u32, v: u32) -> bool {
        self.on_rim[u as usize] && self.on_rim[v as usize]
    }

    /// `kept` stands for what `gone` stood for, too.
    pub(super) fn merge(&mut self, kept: u32, gone: u32) {
        let [k, g] = [kept as usize, gone as usize];
        let (faces, rims) = (self.faces[g], self.rims[g]);
        self.faces[k] += faces;
        self.rims[k] += rims;
        self.on_rim[k] |= self.on_rim[g];
        let moved = std::mem::take(&mut self.held_by[g]);
        self.held_by[k].extend(moved);
        self.held_by[k].sort_unstable();
        self.held_by[k].dedup();
    }
}
