//! What one frame shows of an end-effector.

use super::view::EndEffectorView;
use crate::segment::{ARM, END_EFFECTOR, Thinned, part_around, window_half_m};
use eyebolt_geometry::{DepthImage, PinholeCamera};
use nalgebra::Point3;

/// What one frame shows of an end-effector: its points, and the part of the image around them.
#[derive(Clone, Debug)]
pub struct Observed {
    /// Points of it, evenly chosen, camera frame, metres.
    pub points: Vec<Point3<f32>>,
    /// Of each point, column and row of its patch of the frame: errors of depth and of labels go together within one.
    patch: Vec<[u32; 2]>,
    /// Its pixels in the frame.
    pub pixels: usize,
    /// The same as networks see it.
    pub view: EndEffectorView,
    /// The part of the image around it.
    pub image: Thinned,
    /// The camera of that part.
    pub camera: PinholeCamera,
    /// Of each pixel of that part, what it is of.
    pub label: Vec<u8>,
}

/// Points that a pose is fitted to at most.
const MOST_POINTS: usize = 2000;
/// Edge of a patch, pixels of the camera: windows of stereo and structured light are so large.
const PATCH_PX: usize = 8;
/// A pixel belongs to a bin if its depth differs from the bin's by less than this share.
const SAME_SURFACE: f32 = 0.01;

impl Observed {
    /// Of the pixels with that label in `depth`, of an end-effector of this largest extent; `None` if there are
    /// too few of them.
    pub fn new(
        depth: &DepthImage,
        camera: &PinholeCamera,
        label: &[u8],
        extent_m: f64,
    ) -> Option<Self> {
        let width = camera.width() as usize;
        let of_it = |at: &usize| label[*at] == END_EFFECTOR && depth.depth_m()[*at] > 0.0;
        let pixels: Vec<usize> = (0..label.len()).filter(of_it).collect();
        let point = |at: &usize| {
            let pixel = nalgebra::Point2::new((at % width) as f64, (at / width) as f64);
            let ray = camera.ray(&pixel)?.cast::<f32>();
            let patch = [at % width, at / width].map(|place| (place / PATCH_PX) as u32);
            Some((Point3::from(ray * depth.depth_m()[*at]), patch))
        };
        let all: Vec<(Point3<f32>, [u32; 2])> = pixels.iter().filter_map(point).collect();
        let coordinates: Vec<[f32; 3]> = all.iter().map(|(point, _)| (*point).into()).collect();
        let view = EndEffectorView::new(&coordinates, extent_m)?;
        let middle = view.camera_from_view.translation_m().cast::<f32>();
        let half_m = window_half_m(extent_m);
        let (image, _) = part_around(depth, camera, middle.into(), half_m)?;
        let step = all.len().div_ceil(MOST_POINTS);
        let (points, patch) = all.into_iter().step_by(step).unzip();
        Some(Self {
            points,
            patch,
            pixels: pixels.len(),
            view,
            label: labels(&image, depth, label),
            camera: camera_of(&image, camera)?,
            image,
        })
    }

    /// Of each point, which patch it is in, if patches are so many times as large along an edge.
    pub fn patches(&self, times: u32) -> Vec<u32> {
        let number = |[u, v]: &[u32; 2]| (v / times) << 16 | (u / times);
        self.patch.iter().map(number).collect()
    }

    /// Edge of a patch in pixels of the part of the image.
    pub fn patch_edge(&self) -> usize {
        PATCH_PX.div_ceil(self.image.step)
    }

    /// Median of the points, each coordinate by itself, metres.
    pub fn middle(&self) -> Point3<f64> {
        Point3::from(self.view.camera_from_view.translation_m())
    }
}

/// Label of each bin: the end-effector if one of its pixels at that depth is, else the arm, else whatever it is.
fn labels(image: &Thinned, depth: &DepthImage, label: &[u8]) -> Vec<u8> {
    let stride = depth.width() as usize;
    let [left, top] = image.corner;
    let of = |at: usize| {
        let z = image.depth_m[at];
        let (u, v) = (at % image.width * image.step, at / image.width * image.step);
        let mut found = crate::segment::BACKGROUND;
        for row in 0..image.step {
            for column in 0..image.step {
                let pixel = (top + v + row) * stride + left + u + column;
                let there = depth.depth_m()[pixel];
                if there > 0.0 && (there - z).abs() <= SAME_SURFACE * z {
                    match label[pixel] {
                        END_EFFECTOR => return END_EFFECTOR,
                        ARM => found = ARM,
                        _ => {}
                    }
                }
            }
        }
        found
    };
    (0..image.depth_m.len()).map(of).collect()
}

/// The camera of a binned part of an image.
fn camera_of(image: &Thinned, camera: &PinholeCamera) -> Option<PinholeCamera> {
    let step = image.step as f64;
    let middle =
        |principal: f64, corner: usize| (principal - corner as f64 - 0.5 * (step - 1.0)) / step;
    PinholeCamera::new(
        image.width as u32,
        image.height as u32,
        camera.fx() / step,
        camera.fy() / step,
        middle(camera.cx(), image.corner[0]),
        middle(camera.cy(), image.corner[1]),
        *camera.distortion(),
    )
    .ok()
}
