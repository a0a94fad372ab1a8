//! Signed distance to the outside of a mesh, on a regular grid.

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
    /// The least distance on the border of the grid, metres.
    border_m: f32,
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
    /// The field with `steps` of `step_m` metres at the points of a grid, x fastest.
    ///
    /// # Panics
    ///
    /// If there are not as many steps as grid points, or fewer than two points along an axis.
    pub(crate) fn new(
        origin: Point3<f32>,
        voxel_m: f32,
        size: [usize; 3],
        steps: Vec<i16>,
        step_m: f32,
    ) -> Self {
        assert!(size.iter().all(|n| *n >= 2), "a grid of {size:?} points");
        assert_eq!(steps.len(), size.iter().product::<usize>(), "one value a grid point");
        let border_m = f32::from(least_on_border(size, &steps)) * step_m;
        Self { origin, voxel_m, size, steps, step_m, border_m }
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
        Self::new(origin, voxel_m, size, steps, step_m)
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
    #[inline]
    pub fn sample(&self, point: &Point3<f32>) -> DistanceSample {
        let (base, part, beyond) = self.locate(point);
        self.sample_at(base, part, beyond)
    }

    /// As [`Self::sample`], or `None` where the grid's border alone is farther than `limit_m`.
    #[inline]
    pub(crate) fn sample_within(
        &self,
        point: &Point3<f32>,
        limit_m: f32,
    ) -> Option<DistanceSample> {
        let (base, part, beyond) = self.locate(point);
        let outside = beyond.norm_squared();
        // A hair more than the rounding of the sum.
        let short = limit_m - self.border_m + 1e-5;
        if outside > 0.0 && (short < 0.0 || outside > short * short) {
            return None;
        }
        Some(self.sample_at(base, part, beyond))
    }

    /// The cell of `point`, where in the cell it is, and how far beyond the grid, metres.
    #[inline]
    fn locate(&self, point: &Point3<f32>) -> ([usize; 3], [f32; 3], Vector3<f32>) {
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
        (base, part, beyond)
    }

    #[inline]
    fn sample_at(&self, base: [usize; 3], part: [f32; 3], beyond: Vector3<f32>) -> DistanceSample {
        let mut sample = self.interpolate(base, part, 1.0 / self.voxel_m);
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

    /// As [`Self::sample`], the distance alone: the same number in less time.
    #[inline]
    pub(crate) fn distance(&self, point: &Point3<f32>) -> f32 {
        let ([i, j, k], [x, y, z], beyond) = self.locate(point);
        let [nx, ny, _] = self.size;
        let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
        let along_x = |dj: usize, dk: usize| {
            let at = ((k + dk) * ny + (j + dj)) * nx + i;
            let pair = &self.steps[at..at + 2];
            mix(f32::from(pair[0]), f32::from(pair[1]), x)
        };
        let v0 = mix(along_x(0, 0), along_x(1, 0), y);
        let v1 = mix(along_x(0, 1), along_x(1, 1), y);
        let distance = mix(v0, v1, z) * self.step_m;
        let outside = beyond.norm_squared();
        if outside > 0.0 { distance + outside.sqrt() } else { distance }
    }

    #[inline]
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

/// The least of `steps` on the six sides of a grid of `size` points.
fn least_on_border([nx, ny, nz]: [usize; 3], steps: &[i16]) -> i16 {
    let mut least = i16::MAX;
    for (row, values) in steps.chunks_exact(nx).enumerate() {
        let (j, k) = (row % ny, row / ny);
        let side = j == 0 || j + 1 == ny || k == 0 || k + 1 == nz;
        let ends = [values[0], values[nx - 1]];
        let values = if side { values } else { &ends };
        least = values.iter().fold(least, |least, value| least.min(*value));
    }
    least
}

/// Spacing and number of points of a grid over `span` metres: of `voxel_m`, or as much wider as keeps
/// it to `most_points` (at least 2 along each axis).
///
/// What a description or a recording says must not decide how much memory is taken.
pub(crate) fn bounded_grid(
    span: &Vector3<f32>,
    voxel_m: f32,
    most_points: usize,
) -> (f32, [usize; 3]) {
    let points = |voxel: f32| [0, 1, 2].map(|axis| (span[axis] / voxel).ceil().max(1.0) + 1.0);
    let product = |voxel: f32| points(voxel).map(f64::from).iter().product::<f64>();
    // The least grid has two points along each axis.
    let most_points = most_points.max(8);
    let mut voxel_m = voxel_m;
    while product(voxel_m) > most_points as f64 {
        let ratio = (product(voxel_m) / most_points as f64).cbrt() as f32;
        voxel_m *= ratio.max(1.02);
    }
    (voxel_m, points(voxel_m).map(|n| n as usize))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_grid_covers_its_span_and_keeps_to_its_bound(
            span in proptest::array::uniform3(1e-3..2e6_f32), most in 1_000_usize..100_000,
        ) {
            let (voxel_m, size) = bounded_grid(&Vector3::from(span), 0.005, most);
            prop_assert!(size.iter().product::<usize>() <= most && voxel_m >= 0.005);
            for (points, span) in size.iter().zip(span) {
                prop_assert!(*points >= 2 && (points - 1) as f32 * voxel_m >= 0.999 * span);
            }
        }

        /// What is passed over is farther than asked for, whatever is in the grid.
        #[test]
        fn a_limit_hides_nothing_nearer(
            values in proptest::collection::vec(-0.2..0.26_f32, 27),
            point in proptest::array::uniform3(-0.5..0.8_f32), limit in 0.0..0.6_f32,
        ) {
            let mut next = values.iter();
            let field = DistanceField::from_fn(Point3::origin(), 0.1, [3; 3], 0.26, |_| {
                *next.next().expect("27 values")
            });
            let point = Point3::from(point);
            let all = field.sample(&point);
            prop_assert_eq!(field.distance(&point), all.distance_m);
            match field.sample_within(&point, limit) {
                Some(found) => prop_assert_eq!(found, all),
                None => prop_assert!(all.distance_m > limit),
            }
        }
    }
}
