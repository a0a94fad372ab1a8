//! Which pixels belong to which keypoint.

use eyebolt_geometry::{DepthImage, RayTable};
use eyebolt_registration::Label;
use nalgebra::Point3;

/// A keypoint farther than this from every point of the end-effector is not seen, metres (the
/// paper's published program).
const SEEN_M: f32 = 0.03;
/// Points this near to the one nearest to the reference belong to the keypoint too, metres (likewise).
const TOGETHER_M: f32 = 0.006;

/// The keypoint of each pixel, from 1, where `references` are in the camera frame, not numbers where nobody
/// knows; 0 for none. Only pixels of the end-effector have one; of two that claim a pixel, the nearer has it.
pub(super) fn classes(
    references: &[Point3<f64>],
    labels: &[Label],
    depth: &DepthImage,
    rays: &RayTable,
) -> Vec<u8> {
    let seen: Vec<(usize, Point3<f32>)> = labels
        .iter()
        .enumerate()
        .filter(|(_, label)| **label == Label::EndEffector)
        .map(|(at, _)| (at, rays.point(at, depth.depth_m()[at])))
        .collect();
    let mut classes = vec![0; labels.len()];
    let mut claimed_m = vec![f32::INFINITY; labels.len()];
    let known = |at: &Point3<f64>| at.iter().all(|x| x.is_finite());
    for (class, reference) in (1..).zip(references).filter(|(_, at)| known(at)) {
        let reference: Point3<f32> = reference.cast();
        let away = |point: &Point3<f32>| (point - reference).norm();
        let nearest = seen.iter().min_by(|(_, a), (_, b)| away(a).total_cmp(&away(b)));
        let Some((_, keypoint)) = nearest.filter(|(_, point)| away(point) < SEEN_M) else {
            continue;
        };
        for (at, point) in &seen {
            let distance_m = (point - keypoint).norm();
            if distance_m <= TOGETHER_M && distance_m < claimed_m[*at] {
                (classes[*at], claimed_m[*at]) = (class, distance_m);
            }
        }
    }
    classes
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::{Distortion, PinholeCamera};

    /// A wall of the end-effector at 0.5 m, 1 mm from pixel to pixel, with a hole of background.
    #[test]
    fn points_about_the_nearest_one_have_the_class_and_what_is_far_has_none() {
        let camera =
            PinholeCamera::new(80, 60, 500.0, 500.0, 40.0, 30.0, Distortion::None).unwrap();
        let depth = DepthImage::new(80, 60, vec![0.5; 80 * 60]).unwrap();
        let rays = RayTable::new(&camera);
        let mut labels = vec![Label::EndEffector; 80 * 60];
        labels[30 * 80 + 40] = Label::Background;
        let references = [
            Point3::new(0.0, 0.0, 0.49),
            Point3::new(0.02, 0.01, 0.54),
            Point3::new(0.0, 0.0, 0.5),
            Point3::new(f64::NAN, f64::NAN, f64::NAN),
        ];
        let classes = classes(&references, &labels, &depth, &rays);
        // A disc of 6 mm about a neighbour of the hole; the third reference claims the same pixels.
        let count = |class: u8| classes.iter().filter(|c| **c == class).count();
        assert!((90..=120).contains(&count(1)), "{}", count(1));
        assert_eq!((count(2), count(3), count(4)), (0, 0, 0));
        assert_eq!(classes[30 * 80 + 40], 0);
    }
}
