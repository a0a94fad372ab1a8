//! A labelled frame as a picture, for people to check.

use super::backdrop;
use super::picture::{Picture, Rgb};
use crate::dataset::DatasetFrame;
use crate::end_effector::EndEffector;
use crate::segment;
use eyebolt_geometry::DepthImage;
use eyebolt_registration::Label;
use nalgebra::{Point2, Point3};

const ARM: Rgb = [60, 140, 255];
const END_EFFECTOR: Rgb = [255, 190, 40];
const IGNORE: Rgb = [255, 60, 160];
const BOX: Rgb = [40, 255, 70];
/// Of keypoints in turn.
const KEYPOINTS: [Rgb; 8] = [
    [255, 0, 0],
    [0, 255, 255],
    [255, 0, 255],
    [0, 255, 0],
    [255, 255, 0],
    [255, 255, 255],
    [130, 60, 255],
    [0, 160, 90],
];
const LABEL_OPACITY: f32 = 0.45;
/// Half the width of the cross at a keypoint, pixels.
const CROSS_PX: i64 = 4;
/// Corners of a box by the numbers of [`BoundingBox::corners`](crate::end_effector::BoundingBox::corners):
/// those that differ in one bit share an edge.
const EDGES: [[usize; 2]; 12] = [
    [0, 1],
    [2, 3],
    [4, 5],
    [6, 7],
    [0, 2],
    [1, 3],
    [4, 6],
    [5, 7],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];

/// `depth` in grey, with the pixels in blue that a network has for the arm, and in yellow those of its end-effector.
pub fn classes(depth: &DepthImage, label: &[u8]) -> Picture {
    let mut picture = backdrop::from_depth(depth);
    for (at, label) in label.iter().enumerate().take(depth.depth_m().len()) {
        match *label {
            segment::ARM => picture.blend(at, ARM, LABEL_OPACITY),
            segment::END_EFFECTOR => picture.blend(at, END_EFFECTOR, LABEL_OPACITY),
            _ => {}
        }
    }
    picture
}

/// `frame` as grey depth with the arm in blue, the end-effector in yellow and what is ignored in pink;
/// the end-effector's box in green, and pixels of each keypoint in a colour of its own about a cross
/// where the keypoint is.
pub fn labelled(frame: &DatasetFrame, end_effector: &EndEffector) -> Picture {
    let mut picture = backdrop::from_depth(&frame.depth);
    for (at, (label, keypoint)) in frame.labels.iter().zip(&frame.keypoints).enumerate() {
        let color = match label {
            Label::Background => continue,
            // Without depth there is nothing to say anything of.
            _ if frame.depth.depth_m()[at] <= 0.0 => continue,
            Label::Arm => ARM,
            Label::EndEffector => END_EFFECTOR,
            Label::Ignore => IGNORE,
        };
        picture.blend(at, color, LABEL_OPACITY);
        if *keypoint > 0 {
            picture.blend(at, keypoint_color(usize::from(*keypoint) - 1), 1.0);
        }
    }
    let corners = end_effector.bounding_box(&frame.joints).corners();
    let corners =
        corners.map(|corner| pixel(frame, &frame.camera_from_end_effector.point(&corner)));
    for [from, to] in EDGES {
        if let (Some(from), Some(to)) = (corners[from], corners[to]) {
            line(&mut picture, from, to, BOX);
        }
    }
    for (index, keypoint) in frame.keypoints_in_camera.iter().enumerate() {
        // On a finger that was not recorded it is nowhere.
        let known = keypoint.iter().all(|x| x.is_finite());
        let Some(at) = pixel(frame, keypoint).filter(|_| known) else { continue };
        for step in -CROSS_PX..=CROSS_PX {
            dot(&mut picture, [at.x as i64 + step, at.y as i64], keypoint_color(index));
            dot(&mut picture, [at.x as i64, at.y as i64 + step], keypoint_color(index));
        }
    }
    picture
}

fn keypoint_color(index: usize) -> Rgb {
    KEYPOINTS[index % KEYPOINTS.len()]
}

/// Farther off the image than this, in its sizes, lines are not drawn.
const FARTHEST: f64 = 4.0;

/// Where the camera has `point`, if that is near the image.
fn pixel(frame: &DatasetFrame, point: &Point3<f64>) -> Option<Point2<f64>> {
    let size = f64::from(frame.camera.width().max(frame.camera.height()));
    let pixel = frame.camera.project(point)?;
    (pixel.coords.amax() < FARTHEST * size).then_some(pixel)
}

fn line(picture: &mut Picture, from: Point2<f64>, to: Point2<f64>, color: Rgb) {
    let steps = (to - from).amax().ceil().max(1.0) as usize;
    for step in 0..=steps {
        let at = from + (to - from) * (step as f64 / steps as f64);
        dot(picture, [at.x.round() as i64, at.y.round() as i64], color);
    }
}

fn dot(picture: &mut Picture, [u, v]: [i64; 2], color: Rgb) {
    let (width, height) = (i64::from(picture.width()), i64::from(picture.height()));
    if (0..width).contains(&u) && (0..height).contains(&v) {
        picture.blend((v * width + u) as usize, color, 0.9);
    }
}
