//! Outliers by the modified z-score.

use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::UnitQuaternion;

/// Scores beyond this are outliers' (Iglewicz and Hoaglin, *How to Detect and Handle Outliers*, 1993).
const MOST_SCORE: f64 = 3.5;
/// What the median absolute deviation of a normal distribution is of its standard deviation, and the mean one.
const MEDIAN_SHARE: f64 = 0.6745;
const MEAN_SHARE: f64 = 0.7979;

/// How far each value is from the median, in standard deviations as the median of these distances tells them; by
/// their mean where more than half of the values are the same. Zero where all are.
pub fn modified_z_scores(values: &[f64]) -> Vec<f64> {
    let middle = median(values);
    let off: Vec<f64> = values.iter().map(|value| (value - middle).abs()).collect();
    let mean = off.iter().sum::<f64>() / off.len().max(1) as f64;
    let scale = match median(&off) {
        0.0 => mean / MEAN_SHARE,
        deviation => deviation / MEDIAN_SHARE,
    };
    off.iter().map(|off| if scale > 0.0 { off / scale } else { 0.0 }).collect()
}

/// Which of `poses` are no outliers along any axis, nor by their angle from the median rotation.
pub fn inliers(poses: &[Transform<Camera, Base>]) -> Vec<bool> {
    let mut kept = vec![true; poses.len()];
    for axis in 0..3 {
        let along: Vec<f64> = poses.iter().map(|pose| pose.translation_m()[axis]).collect();
        let scores = modified_z_scores(&along);
        kept.iter_mut().zip(scores).for_each(|(kept, score)| *kept &= score <= MOST_SCORE);
    }
    let rotations: Vec<_> = poses.iter().map(Transform::rotation).collect();
    let Some(middle) = median_rotation(&rotations) else { return kept };
    let angles: Vec<f64> = rotations.iter().map(|rotation| rotation.angle_to(&middle)).collect();
    let (scores, usual) = (modified_z_scores(&angles), median(&angles));
    for ((kept, score), angle) in kept.iter_mut().zip(scores).zip(angles) {
        // Nearer to the median than others is no fault.
        *kept &= score <= MOST_SCORE || angle <= usual;
    }
    kept
}

/// The rotation from which the others are least far in all (the medoid): a rotation that the mean is not drawn away
/// from, as it is by outliers.
fn median_rotation(rotations: &[UnitQuaternion<f64>]) -> Option<UnitQuaternion<f64>> {
    let far =
        |from: &UnitQuaternion<f64>| rotations.iter().map(|to| from.angle_to(to)).sum::<f64>();
    rotations.iter().min_by(|a, b| far(a).total_cmp(&far(b))).copied()
}

/// The middle value; the mean of the two in the middle of an even number.
fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let upper = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
    match sorted.len() % 2 {
        0 if !sorted.is_empty() => 0.5 * (sorted[sorted.len() / 2 - 1] + upper),
        _ => upper,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector3, Vector6};
    use proptest::prelude::*;

    /// Iglewicz and Hoaglin's own example (1993, page 12): 2.1, 2.6, 2.4, 2.5, 2.3, 2.1, 2.3, 2.6, 8.2, 8.3 has the
    /// last two as outliers, with a median of 2.45 and deviations of which the middle is 0.15 to 0.2.
    #[test]
    fn two_values_apart_are_outliers() {
        let scores = modified_z_scores(&[2.1, 2.6, 2.4, 2.5, 2.3, 2.1, 2.3, 2.6, 8.2, 8.3]);
        let found: Vec<bool> = scores.iter().map(|score| *score > MOST_SCORE).collect();
        assert_eq!(found, [[false; 8].as_slice(), &[true; 2]].concat());
    }

    #[test]
    fn the_same_value_again_and_again_is_none() {
        assert_eq!(modified_z_scores(&[0.3; 7]), [0.0; 7]);
        let mut most = vec![0.3; 9];
        most.push(0.4);
        let scores = modified_z_scores(&most);
        assert!(scores[..9].iter().all(|score| *score == 0.0) && scores[9] > MOST_SCORE);
        assert_eq!(modified_z_scores(&[]), Vec::<f64>::new());
    }

    fn pose(off: [f64; 6]) -> Transform<Camera, Base> {
        let turn = UnitQuaternion::from_euler_angles(1.0, -0.4, 2.2);
        Transform::from_parts(Vector3::new(0.1, 0.2, 1.3), turn).retract(&Vector6::from(off))
    }

    /// A rotation about any axis is seen; from the identity one about an axis across it would hardly be.
    #[test]
    fn a_turned_pose_is_an_outlier_whatever_its_axis() {
        for axis in 3..6 {
            let mut poses: Vec<_> = (0..9)
                .map(|n| {
                    let off = |k: usize| 0.002 * f64::from(((7 * n + 3 * k as i32) % 9) - 4);
                    pose([off(0), off(1), off(2), off(3), off(4), off(5)])
                })
                .collect();
            let mut turned = [0.0; 6];
            turned[axis] = 0.3;
            poses.push(pose(turned));
            let found = inliers(&poses);
            assert!(!found[9] && found[..9].iter().filter(|kept| **kept).count() >= 7, "{found:?}");
        }
    }

    proptest! {
        /// Scores do not change with where zero is or with the unit.
        #[test]
        fn scores_know_no_unit(
            values in prop::collection::vec(-1.0..1.0_f64, 1..20), by in -5.0..5.0_f64, times in 0.1..9.0_f64,
        ) {
            let moved: Vec<f64> = values.iter().map(|value| times * value + by).collect();
            for (a, b) in modified_z_scores(&values).into_iter().zip(modified_z_scores(&moved)) {
                prop_assert!((a - b).abs() < 1e-6 * (1.0 + a), "{a} {b}");
            }
        }
    }
}
