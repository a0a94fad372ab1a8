//! The points of an end-effector as a small image that a network takes.

use crate::segment::middle;
use eyebolt_geometry::{Camera, Link, Transform};
use nalgebra::{Point3, Rotation3, UnitQuaternion, Vector3};

/// Cells along an edge of the image.
pub const CELLS: usize = 64;
/// Names of the features of a cell, in their order; lengths in halves of the image.
pub const VIEW_FEATURES: [&str; 7] =
    ["occupancy", "x", "y", "z", "normal_x", "normal_y", "normal_z"];
/// How much wider the image is than the end-effector.
const ROOM: f64 = 1.25;
/// Fewer cells are no view.
const FEWEST_CELLS: usize = 12;

/// Width of the image of an end-effector of this largest extent, metres.
pub fn view_edge_m(extent_m: f64) -> f64 {
    ROOM * extent_m
}

/// What a camera saw of an end-effector, straightened: drawn parallel to the line of sight to its
/// middle, so that where in the image it was no longer matters and what is rotation is only that.
#[derive(Clone, Debug, PartialEq)]
pub struct EndEffectorView {
    /// Cells that saw something, column and row, row by row.
    pub cells: Vec<[u32; 2]>,
    /// The point of each cell, in the view's frame, metres: its origin is the middle of what was seen,
    /// its z-axis the line of sight.
    pub points_m: Vec<[f32; 3]>,
    /// [`VIEW_FEATURES`] of each cell.
    pub features: Vec<f32>,
    /// Where the view's frame is.
    pub camera_from_view: Transform<Camera, Link>,
    /// Half the width of the image, metres.
    pub half_m: f32,
}

impl EndEffectorView {
    /// Of points of the end-effector, camera frame, metres, whose largest extent is `extent_m`; `None`
    /// if there are too few.
    pub fn new(points_in_camera: &[[f32; 3]], extent_m: f64) -> Option<Self> {
        let middle = middle(points_in_camera.iter().copied()).filter(|middle| middle[2] > 0.0)?;
        let middle = Point3::from(middle).cast::<f64>();
        let sight = Rotation3::rotation_between(&Vector3::z(), &middle.coords)?;
        let camera_from_view =
            Transform::from_parts(middle.coords, UnitQuaternion::from_rotation_matrix(&sight));
        let view_from_camera = camera_from_view.inverse().isometry().cast::<f32>();
        let half_m = (0.5 * view_edge_m(extent_m)) as f32;
        let mut image = vec![[f32::NAN; 3]; CELLS * CELLS];
        for point in points_in_camera {
            let p = view_from_camera * Point3::from(*point);
            let cell = |value: f32| ((value / half_m + 1.0) * 0.5 * CELLS as f32).floor();
            let (u, v) = (cell(p.x), cell(p.y));
            let inside = |value: f32| (0.0..CELLS as f32).contains(&value);
            if !(inside(u) && inside(v) && p.z.abs() < half_m) {
                continue;
            }
            let held = &mut image[v as usize * CELLS + u as usize];
            // The nearest of a cell: what is behind it shines through between pixels.
            if held[2].is_nan() || p.z < held[2] {
                *held = [p.x, p.y, p.z];
            }
        }
        let seen: Vec<usize> = (0..image.len()).filter(|at| !image[*at][2].is_nan()).collect();
        if seen.len() < FEWEST_CELLS {
            return None;
        }
        let mut features = Vec::with_capacity(seen.len() * VIEW_FEATURES.len());
        for at in &seen {
            let [nx, ny, nz] = normal(&image, *at);
            let [x, y, z] = image[*at].map(|value| value / half_m);
            features.extend([1.0, x, y, z, nx, ny, nz]);
        }
        let cells = seen.iter().map(|at| [(at % CELLS) as u32, (at / CELLS) as u32]).collect();
        let points_m = seen.iter().map(|at| image[*at]).collect();
        Some(Self { cells, points_m, features, camera_from_view, half_m })
    }
}

/// Unit normal toward the camera from the cells around; zero where there are none. Beyond a step in depth
/// it is another surface, or one too steep to tell.
fn normal(image: &[[f32; 3]], at: usize) -> [f32; 3] {
    let (u, v) = (at % CELLS, at / CELLS);
    const STEP_M: f32 = 0.02;
    const LEAST_SINE: f32 = 0.2;
    let seen = |u: i64, v: i64| -> Option<[f32; 3]> {
        let inside = |value: i64| (0..CELLS as i64).contains(&value);
        let found = (inside(u) && inside(v)).then(|| image[v as usize * CELLS + u as usize])?;
        ((found[2] - image[at][2]).abs() < STEP_M).then_some(found)
    };
    let along = |du: i64, dv: i64| {
        // Cells may be missing between pixels that lie far apart.
        let reach = |sign: i64| {
            (1..=2).find_map(|by| seen(u as i64 + sign * by * du, v as i64 + sign * by * dv))
        };
        let (a, b) = (reach(-1).unwrap_or(image[at]), reach(1).unwrap_or(image[at]));
        (a != b).then(|| Vector3::new(b[0] - a[0], b[1] - a[1], b[2] - a[2]))
    };
    let (Some(across), Some(down)) = (along(1, 0), along(0, 1)) else { return [0.0; 3] };
    let normal = down.cross(&across);
    // Points may lie anywhere in their cells, and three of them on a line.
    if normal.norm() < LEAST_SINE * across.norm() * down.norm() {
        return [0.0; 3];
    }
    normal.normalize().into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tilted square plate wherever it is: its points keep their places, its normals look at the camera.
    #[test]
    fn a_plate_looks_the_same_wherever_it_is() {
        let tilt = UnitQuaternion::from_euler_angles(0.4, -0.3, 0.2);
        let plate = |at: Vector3<f64>, sight: UnitQuaternion<f64>| -> Vec<[f32; 3]> {
            let grid = |n: i32| f64::from(n) * 0.0025;
            let points = (-30..=30).flat_map(|x| (-30..=30).map(move |y| (grid(x), grid(y))));
            points
                .map(|(x, y)| (at + sight * (tilt * Vector3::new(x, y, 0.0))).cast::<f32>().into())
                .collect()
        };
        let ahead = plate(Vector3::new(0.0, 0.0, 0.9), UnitQuaternion::identity());
        let aside = Vector3::new(0.4, -0.3, 1.2);
        let sight = UnitQuaternion::rotation_between(&Vector3::z(), &aside).unwrap();
        let views =
            [ahead, plate(aside, sight)].map(|points| EndEffectorView::new(&points, 0.25).unwrap());
        let n = tilt * Vector3::new(0.0, 0.0, -1.0);
        let mut known = 0;
        for view in &views {
            for (cell, (row, point)) in
                view.cells.iter().zip(view.features.chunks(7).zip(&view.points_m))
            {
                let middle = |c: u32| (2.0 * (c as f32 + 0.5) / CELLS as f32 - 1.0) * view.half_m;
                assert!((middle(cell[0]) - point[0]).abs() <= view.half_m / CELLS as f32 * 1.01);
                let found = Vector3::new(row[4], row[5], row[6]).cast::<f64>();
                if found.norm() > 0.5 {
                    known += 1;
                    assert!(found.angle(&n) < 1e-2, "{found} {n}");
                }
            }
        }
        assert!(known > 1500, "{known}");
        // Cells at the rim of a raster may differ; nothing else does.
        let same = views[0].cells.iter().filter(|cell| views[1].cells.contains(cell)).count();
        assert!(same as f64 > 0.95 * views[0].cells.len() as f64);
    }

    #[test]
    fn too_few_points_are_no_view() {
        assert_eq!(EndEffectorView::new(&[], 0.2), None);
        assert_eq!(EndEffectorView::new(&[[0.0, 0.0, 1.0]; 100], 0.2), None);
        assert_eq!(EndEffectorView::new(&[[0.0, 0.0, -1.0]; 100], 0.2), None);
    }
}
