//! How a distance field is made from triangles.
//!
//! Nearest triangles are found exactly near the surface and carried outward by sweeping (after
//! Bridson's level-set construction); inside and outside are told apart by flooding from the
//! grid's border, which needs no closed or consistently oriented mesh.

use crate::distance_field::{DistanceField, bounded_grid};
use crate::triangle::{area_normal, closest_point, corners, spread_points};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};

const NONE: u32 = u32::MAX;

/// Distances are stored up to this: 8 micrometres of resolution in 16 bits.
const LARGEST_M: f32 = 0.26;

/// Grid of nearest triangles while a field is built.
struct Builder<'a> {
    triangles: &'a [[Point3<f32>; 3]],
    origin: Point3<f32>,
    voxel_m: f32,
    size: [usize; 3],
    distance: Vec<f32>,
    nearest: Vec<u32>,
}

impl DistanceField {
    /// The field of `mesh` with the given grid spacing, reaching `margin_m` beyond its box.
    ///
    /// A mesh that needs more than `most_points` grid points gets a wider spacing. Takes seconds for
    /// a detailed mesh: see [`crate::LinkCache`].
    pub fn build(mesh: &TriangleMesh, voxel_m: f32, margin_m: f32, most_points: usize) -> Self {
        build(&corners(mesh), voxel_m, margin_m, most_points)
    }
}

fn build(
    all: &[[Point3<f32>; 3]],
    voxel_m: f32,
    margin_m: f32,
    most_points: usize,
) -> DistanceField {
    let mut builder = Builder::new(all, voxel_m, margin_m, most_points);
    builder.find_nearest();
    let outside = builder.flood();
    let outer: Vec<_> = all.iter().copied().filter(|t| builder.touches(&outside, t)).collect();
    if outer.len() < all.len() && !outer.is_empty() {
        // Same grid, so that what was outside stays outside.
        let (origin, size) = (builder.origin, builder.size);
        builder = Builder::on_grid(&outer, origin, builder.voxel_m, size);
        builder.find_nearest();
        return builder.signed(&outside);
    }
    builder.signed(&outside)
}

impl<'a> Builder<'a> {
    fn new(
        triangles: &'a [[Point3<f32>; 3]],
        voxel_m: f32,
        margin_m: f32,
        most_points: usize,
    ) -> Self {
        let mut low = Point3::from(Vector3::repeat(f32::INFINITY));
        let mut high = Point3::from(Vector3::repeat(f32::NEG_INFINITY));
        for corner in triangles.iter().flatten() {
            low = low.inf(corner);
            high = high.sup(corner);
        }
        let origin = low - Vector3::repeat(margin_m);
        let span = high - low + Vector3::repeat(2.0 * margin_m);
        let (voxel_m, size) = bounded_grid(&span, voxel_m, most_points);
        Self::on_grid(triangles, origin, voxel_m, size)
    }

    fn on_grid(
        triangles: &'a [[Point3<f32>; 3]],
        origin: Point3<f32>,
        voxel_m: f32,
        size: [usize; 3],
    ) -> Self {
        let count = size.iter().product();
        let (distance, nearest) = (vec![f32::INFINITY; count], vec![NONE; count]);
        Self { triangles, origin, voxel_m, size, distance, nearest }
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.size[1] + j) * self.size[0] + i
    }

    fn position(&self, [i, j, k]: [usize; 3]) -> Point3<f32> {
        self.origin + Vector3::new(i as f32, j as f32, k as f32) * self.voxel_m
    }

    fn try_triangle(&mut self, at: usize, p: &Point3<f32>, triangle: u32) {
        let distance = (closest_point(p, &self.triangles[triangle as usize]) - p).norm();
        if distance < self.distance[at] {
            self.distance[at] = distance;
            self.nearest[at] = triangle;
        }
    }

    fn find_nearest(&mut self) {
        for triangle in 0..self.triangles.len() {
            self.splat(triangle as u32);
        }
        for _ in 0..2 {
            for direction in 0..8 {
                self.sweep([direction & 1, (direction >> 1) & 1, direction >> 2]);
            }
        }
    }

    /// Exact distances at the grid points about one triangle.
    fn splat(&mut self, triangle: u32) {
        let [a, b, c] = self.triangles[triangle as usize];
        let (low, high) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
        let range = [0, 1, 2].map(|axis| {
            let cell = |value: f32| (value - self.origin[axis]) / self.voxel_m;
            let first = (cell(low[axis]).floor() - 1.0).max(0.0) as usize;
            let last = (cell(high[axis]).ceil() + 1.0).max(0.0) as usize;
            (first, last.min(self.size[axis] - 1))
        });
        for k in range[2].0..=range[2].1 {
            for j in range[1].0..=range[1].1 {
                for i in range[0].0..=range[0].1 {
                    let p = self.position([i, j, k]);
                    self.try_triangle(self.index([i, j, k]), &p, triangle);
                }
            }
        }
    }

    /// One pass over the grid, each point trying its predecessors' triangles.
    fn sweep(&mut self, backward: [usize; 3]) {
        let [nx, ny, nz] = self.size;
        let order = |n: usize, axis: usize, step: usize| {
            if backward[axis] == 1 { n - 1 - step } else { step }
        };
        let before = |at: usize, n: usize, axis: usize| {
            let previous = if backward[axis] == 1 { at + 1 } else { at.wrapping_sub(1) };
            (previous < n).then_some(previous)
        };
        for sk in 0..nz {
            let k = order(nz, 2, sk);
            for sj in 0..ny {
                let j = order(ny, 1, sj);
                for si in 0..nx {
                    let i = order(nx, 0, si);
                    let (pi, pj, pk) = (before(i, nx, 0), before(j, ny, 1), before(k, nz, 2));
                    self.relax([i, j, k], [pi, pj, pk]);
                }
            }
        }
    }

    fn relax(&mut self, at: [usize; 3], previous: [Option<usize>; 3]) {
        let (index, p) = (self.index(at), self.position(at));
        for corner in 1..8usize {
            let mut neighbour = at;
            let inside = (0..3).all(|axis| {
                if corner >> axis & 1 == 0 {
                    return true;
                }
                previous[axis].map(|value| neighbour[axis] = value).is_some()
            });
            if !inside {
                continue;
            }
            let triangle = self.nearest[self.index(neighbour)];
            if triangle != NONE && triangle != self.nearest[index] {
                self.try_triangle(index, &p, triangle);
            }
        }
    }

    /// Grid points that can be reached from the border without crossing the surface.
    ///
    /// Between face neighbours that a surface parts, the crossing is within half a voxel of one
    /// of them, so points that near the surface block the way.
    fn flood(&self) -> Vec<bool> {
        let [nx, ny, nz] = self.size;
        let open = |at: usize| self.distance[at] > 0.501 * self.voxel_m;
        let mut reached = vec![false; self.distance.len()];
        let mut stack = Vec::new();
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let border =
                        [(i, nx), (j, ny), (k, nz)].iter().any(|&(v, n)| v == 0 || v + 1 == n);
                    let at = self.index([i, j, k]);
                    if border && open(at) {
                        reached[at] = true;
                        stack.push([i, j, k]);
                    }
                }
            }
        }
        while let Some(at) = stack.pop() {
            for axis in 0..3 {
                for forward in [false, true] {
                    let mut next = at;
                    next[axis] = if forward { at[axis] + 1 } else { at[axis].wrapping_sub(1) };
                    if next[axis] >= self.size[axis] {
                        continue;
                    }
                    let index = self.index(next);
                    if !reached[index] && open(index) {
                        reached[index] = true;
                        stack.push(next);
                    }
                }
            }
        }
        reached
    }

    fn cell(&self, p: &Point3<f32>) -> Option<[usize; 3]> {
        let mut cell = [0; 3];
        for axis in 0..3 {
            let position = ((p[axis] - self.origin[axis]) / self.voxel_m).round();
            if !(position >= 0.0 && position < self.size[axis] as f32) {
                return None;
            }
            cell[axis] = position as usize;
        }
        Some(cell)
    }

    fn is_outside(&self, outside: &[bool], p: &Point3<f32>) -> bool {
        self.cell(p).is_none_or(|cell| outside[self.index(cell)])
    }

    /// Whether some of a triangle can be seen from outside: a probe a little off either face gets
    /// there. A large one may be covered in part.
    fn touches(&self, outside: &[bool], triangle: &[Point3<f32>; 3]) -> bool {
        let Some(normal) = area_normal(triangle).try_normalize(1e-20) else { return false };
        spread_points(triangle, 2.0 * self.voxel_m).any(|p| {
            [1.2f32, -1.2, 2.0, -2.0]
                .iter()
                .any(|reach| self.is_outside(outside, &(p + normal * (reach * self.voxel_m))))
        })
    }

    fn signed(self, outside: &[bool]) -> DistanceField {
        let mut at = 0;
        DistanceField::from_fn(self.origin, self.voxel_m, self.size, LARGEST_M, |_| {
            let [nx, ny, _] = self.size;
            let cell = [at % nx, at / nx % ny, at / (nx * ny)];
            let distance = self.sign(cell, outside) * self.distance[at];
            at += 1;
            distance
        })
    }

    fn sign(&self, at: [usize; 3], outside: &[bool]) -> f32 {
        let index = self.index(at);
        let p = self.position(at);
        let Some(triangle) = self.triangles.get(self.nearest[index] as usize) else { return 1.0 };
        let away = p - closest_point(&p, triangle);
        let open = if self.distance[index] > 0.501 * self.voxel_m {
            outside[index]
        } else {
            // Too near to have been flooded: what lies further out on the same side decides.
            let Some(direction) = away.try_normalize(1e-9) else { return 1.0 };
            let reach = |n: f32| self.is_outside(outside, &(p + direction * (n * self.voxel_m)));
            reach(1.0) || reach(1.5)
        };
        if !open {
            return -1.0;
        }
        // A shell open to both sides: its own orientation says which is the inside.
        let normal = area_normal(triangle);
        let behind = away.dot(&normal) < 0.0;
        if behind && self.is_shell(outside, triangle) { -1.0 } else { 1.0 }
    }

    fn is_shell(&self, outside: &[bool], triangle: &[Point3<f32>; 3]) -> bool {
        let [a, b, c] = triangle;
        let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
        let Some(normal) = area_normal(triangle).try_normalize(1e-20) else { return false };
        [1.5f32, -1.5]
            .iter()
            .all(|reach| self.is_outside(outside, &(middle + normal * (reach * self.voxel_m))))
    }
}
