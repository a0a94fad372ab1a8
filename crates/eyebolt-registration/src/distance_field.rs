//! Signed distance to the outside of a mesh, on a regular grid.

use crate::distance_build;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, Vector3};

/// Signed distance (metres, negative inside) and its gradient around one link, in the link's frame.
///
/// Values live on a regular grid and are interpolated trilinearly; the gradient is the exact
/// gradient of the interpolant, so least squares on it converges as on a smooth function.
/// Surfaces that cannot be reached from outside (motors, screws inside a shell) do not count.
#[derive(Clone, Debug, PartialEq)]
pub struct DistanceField {
    pub(crate) origin: Point3<f32>,
    pub(crate) voxel_m: f32,
    pub(crate) size: [usize; 3],
    /// Distance in steps of `step_m`, x fastest.
    pub(crate) steps: Vec<i16>,
    pub(crate) step_m: f32,
}

/// What [`DistanceField::sample`] finds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistanceSample {
    /// Signed distance, metres; negative inside.
    pub distance_m: f32,
    /// Gradient of the distance; near the surface its outward normal, of about unit length.
    pub gradient: Vector3<f32>,
}

impl DistanceField {
    /// The field of `mesh` with the given grid spacing, reaching `margin_m` beyond its box.
    ///
    /// Takes seconds for a detailed mesh: see [`crate::LinkCache`].
    pub fn build(mesh: &TriangleMesh, voxel_m: f32, margin_m: f32) -> Self {
        distance_build::build(mesh, voxel_m, margin_m)
    }

    /// The field whose value at each grid point is `distance_m(point)`.
    ///
    /// `size` counts grid points along x, y and z (at least 2 each); distances beyond
    /// `largest_m` are stored as that.
    pub fn from_fn(
        origin: Point3<f32>,
        voxel_m: f32,
        size: [usize; 3],
        largest_m: f32,
        mut distance_m: impl FnMut(&Point3<f32>) -> f32,
    ) -> Self {
        let size = size.map(|n| n.max(2));
        let step_m = largest_m / f32::from(i16::MAX);
        let mut steps = Vec::with_capacity(size.iter().product());
        for k in 0..size[2] {
            for j in 0..size[1] {
                for i in 0..size[0] {
                    let cell = Vector3::new(i as f32, j as f32, k as f32);
                    let distance = distance_m(&(origin + cell * voxel_m));
                    // `as` saturates: far away is as far as 16 bits can say.
                    steps.push((distance / step_m).round() as i16);
                }
            }
        }
        Self { origin, voxel_m, size, steps, step_m }
    }

    /// Grid spacing, metres.
    pub fn voxel_m(&self) -> f32 {
        self.voxel_m
    }

    /// Number of grid points along x, y and z.
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Distance and gradient at `point` (link frame, metres), anywhere.
    ///
    /// Beyond the grid the distance to the grid's box is added: never less than the true distance,
    /// and over by no more than the distance at the box, so it keeps growing.
    pub fn sample(&self, point: &Point3<f32>) -> DistanceSample {
        let inverse = 1.0 / self.voxel_m;
        let mut base = [0usize; 3];
        let mut part = [0f32; 3];
        let mut beyond = Vector3::zeros();
        for axis in 0..3 {
            let position = (point[axis] - self.origin[axis]) * inverse;
            let limit = (self.size[axis] - 1) as f32;
            let clamped = position.clamp(0.0, limit);
            beyond[axis] = (position - clamped) * self.voxel_m;
            base[axis] = (clamped as usize).min(self.size[axis] - 2);
            part[axis] = clamped - base[axis] as f32;
        }
        let mut sample = self.interpolate(base, part, inverse);
        let outside = beyond.norm_squared();
        if outside > 0.0 {
            let outside = outside.sqrt();
            sample.distance_m += outside;
            sample.gradient = beyond / outside;
        }
        sample
    }

    /// Distance at the grid point nearest to `point`, or `None` beyond the grid.
    pub fn nearest(&self, point: &Point3<f32>) -> Option<f32> {
        let inverse = 1.0 / self.voxel_m;
        let mut index = [0usize; 3];
        for axis in 0..3 {
            let position = (point[axis] - self.origin[axis]) * inverse + 0.5;
            if !(position >= 0.0 && position < self.size[axis] as f32) {
                return None;
            }
            index[axis] = position as usize;
        }
        let [nx, ny, _] = self.size;
        let step = self.steps[(index[2] * ny + index[1]) * nx + index[0]];
        Some(f32::from(step) * self.step_m)
    }

    fn interpolate(&self, [i, j, k]: [usize; 3], part: [f32; 3], inverse: f32) -> DistanceSample {
        let [nx, ny, _] = self.size;
        let [x, y, z] = part;
        let row = |dj: usize, dk: usize| {
            let at = ((k + dk) * ny + (j + dj)) * nx + i;
            let pair = &self.steps[at..at + 2];
            (f32::from(pair[0]), f32::from(pair[1]))
        };
        let along_x = |(a, b): (f32, f32)| (a + (b - a) * x, b - a);
        let (v00, g00) = along_x(row(0, 0));
        let (v10, g10) = along_x(row(1, 0));
        let (v01, g01) = along_x(row(0, 1));
        let (v11, g11) = along_x(row(1, 1));
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let (v0, v1) = (mix(v00, v10, y), mix(v01, v11, y));
        let gradient = Vector3::new(
            mix(mix(g00, g10, y), mix(g01, g11, y), z),
            mix(v10 - v00, v11 - v01, z),
            v1 - v0,
        );
        DistanceSample {
            distance_m: mix(v0, v1, z) * self.step_m,
            gradient: gradient * (self.step_m * inverse),
        }
    }

    /// Corner of the grid with the smallest coordinates and the opposite one, metres.
    pub fn bounds(&self) -> (Point3<f32>, Point3<f32>) {
        let [nx, ny, nz] = self.size.map(|n| (n - 1) as f32 * self.voxel_m);
        (self.origin, self.origin + Vector3::new(nx, ny, nz))
    }
}
