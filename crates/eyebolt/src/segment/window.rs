//! What is near an end-effector, as a network sees it.

use super::features::normal;
use super::thinned::Thinned;
use eyebolt_geometry::{DepthImage, PinholeCamera};
use nalgebra::{Point3, Rotation3, Vector3};
use std::ops::Range;

/// Names of the features of a pixel, in their order. Lengths are in halves of the window, from its middle;
/// the z-axis is the line of sight to it, so that where in the image it was no longer matters.
pub const WINDOW_FEATURES: [&str; 7] =
    ["occupancy", "x", "y", "z", "normal_x", "normal_y", "normal_z"];
/// Columns of a window at most: nearer to the camera, pixels are binned.
pub const WINDOW_COLUMNS: usize = 96;
/// How much wider a window is than the end-effector: what the arm looks like behind it helps, and a middle
/// that is only about right must do.
const ROOM: f64 = 1.6;
/// Fewer pixels are no window.
const FEWEST_PIXELS: usize = 12;

/// Half the edge of the window around an end-effector of this largest extent, metres.
pub fn window_half_m(extent_m: f64) -> f32 {
    (0.5 * ROOM * extent_m) as f32
}

/// The points of an image in a cube around a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// Row-major pixels of the image.
    pub pixels: Vec<usize>,
    /// Columns and rows of these pixels in the image.
    pub cells: Vec<[u32; 2]>,
    /// [`WINDOW_FEATURES`] of each pixel.
    pub features: Vec<f32>,
}

impl Window {
    /// The points of `image` that are within `half_m` metres of `middle`, camera frame, along each axis of a frame
    /// that looks at it; `None` if there are too few.
    pub fn new(image: &Thinned, middle: [f32; 3], half_m: f32) -> Option<Self> {
        let middle = Vector3::from(middle);
        let view_from_camera = Rotation3::rotation_between(&middle, &Vector3::z())?;
        let mut window = Self { pixels: Vec::new(), cells: Vec::new(), features: Vec::new() };
        for at in image.seen() {
            let off = Point3::from(image.point(at)).coords - middle;
            // Most pixels are far away, and a turn makes nothing longer.
            if off.norm_squared() > 3.0 * half_m * half_m {
                continue;
            }
            let [x, y, z]: [f32; 3] = (view_from_camera * off / half_m).into();
            if [x, y, z].iter().any(|value| value.abs() >= 1.0) {
                continue;
            }
            let normal = view_from_camera * Vector3::from(normal(image, at));
            window.pixels.push(at);
            window.cells.push([(at % image.width) as u32, (at / image.width) as u32]);
            window.features.extend([1.0, x, y, z, normal.x, normal.y, normal.z]);
        }
        (window.pixels.len() >= FEWEST_PIXELS).then_some(window)
    }
}

/// Columns and rows of an image.
pub type Part = [Range<usize>; 2];

/// The part of `depth` around `middle`, camera frame, metres, with its columns and rows; `None` if it is
/// outside the image.
pub fn part_around(
    depth: &DepthImage,
    camera: &PinholeCamera,
    middle: [f32; 3],
    half_m: f32,
) -> Option<(Thinned, Part)> {
    let pixel = camera.project(&Point3::from(middle).cast())?;
    let half_px = f64::from(half_m / middle[2]) * camera.fx().max(camera.fy());
    let span = |at: f64, size: u32| {
        let from = (at - half_px).max(0.0).ceil() as usize;
        from..((at + half_px).max(0.0).floor() as usize + 1).min(size as usize)
    };
    let part = [span(pixel.x, camera.width()), span(pixel.y, camera.height())];
    let step = window_step(half_px);
    let whole = part.iter().all(|range| range.start < range.end && range.len() >= step);
    whole.then(|| (Thinned::part(depth, camera, part.clone(), step), part))
}

/// Edge of a bin in pixels where half a window is so many pixels wide.
pub fn window_step(half_px: f64) -> usize {
    ((2.0 * half_px / WINDOW_COLUMNS as f64).ceil() as usize).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::Distortion;

    /// A ball before a wall, near and far, in the middle and beside it: its points are in the window, the wall's
    /// are not, and no window has more columns than it may.
    #[test]
    fn a_window_holds_what_is_near_its_middle() {
        let camera =
            PinholeCamera::new(640, 480, 570.0, 570.0, 319.5, 239.5, Distortion::None).unwrap();
        let half_m = window_half_m(0.2);
        for middle in [[0.0, 0.0, 0.5], [0.1, -0.1, 0.7], [-0.5, 0.3, 1.6_f32]] {
            let ball = |at: usize| {
                let pixel = nalgebra::Point2::new((at % 640) as f64, (at / 640) as f64);
                let ray = camera.ray(&pixel).unwrap().cast::<f32>();
                let near = ray * middle[2] - Vector3::from(middle);
                if near.norm() < 0.08 { middle[2] } else { middle[2] + 1.0 }
            };
            let depth = DepthImage::new(640, 480, (0..640 * 480).map(ball).collect()).unwrap();
            let (image, part) = part_around(&depth, &camera, middle, half_m).unwrap();
            assert!(image.width <= WINDOW_COLUMNS && image.height <= WINDOW_COLUMNS);
            assert_eq!(image.corner, [part[0].start, part[1].start]);
            let window = Window::new(&image, middle, half_m).unwrap();
            let area = window.pixels.iter().map(|at| image.depth_m[*at].powi(2)).sum::<f32>();
            let area = area * (image.step as f32 / 570.0).powi(2);
            assert!((area / (std::f32::consts::PI * 0.08 * 0.08) - 1.0).abs() < 0.1, "{area}");
            for row in window.features.chunks(WINDOW_FEATURES.len()) {
                assert!(row[1..4].iter().all(|value| value.abs() < 0.08 / half_m + 0.2), "{row:?}");
            }
        }
    }

    #[test]
    fn places_outside_the_image_have_no_window() {
        let camera = PinholeCamera::new(64, 48, 57.0, 57.0, 31.5, 23.5, Distortion::None).unwrap();
        let depth = DepthImage::new(64, 48, vec![1.0; 64 * 48]).unwrap();
        assert_eq!(part_around(&depth, &camera, [3.0, 0.0, 1.0], 0.1), None);
        assert_eq!(part_around(&depth, &camera, [0.0, 0.0, -1.0], 0.1), None);
        let (image, _) = part_around(&depth, &camera, [0.0, 0.0, 0.5], 0.05).unwrap();
        assert_eq!(Window::new(&image, [0.0, 0.0, 0.5], 0.05), None);
    }
}
