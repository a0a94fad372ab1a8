//! The pose of the base on which most configurations agree.

use eyebolt_geometry::{Base, Camera, Transform, mean_transform};
use nalgebra::Point3;

/// Where the base may be by one configuration.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// Which configuration says so; one may say several.
    pub configuration: usize,
    /// Where it says the base is.
    pub camera_from_base: Transform<Camera, Base>,
}

/// Where some configurations agree that the base is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Consensus {
    /// The mean of what they say.
    pub camera_from_base: Transform<Camera, Base>,
    /// How many they are.
    pub configurations: usize,
}

/// Candidates agree that are no farther apart than this at the middle of the workspace, and turned by no more:
/// twice what single images of a good network leave.
const SAME_M: f64 = 0.03;
const SAME_RAD: f64 = 0.12;

/// The poses on which most configurations agree, at a point of the base frame: at most `most`, that of most
/// configurations first, none of them made of the same candidates.
pub fn consensus(
    mut candidates: Vec<Candidate>,
    at_in_base: &Point3<f64>,
    most: usize,
) -> Vec<Consensus> {
    let mut found = Vec::new();
    while found.len() < most {
        let supporters = |of: &Candidate| supporters(&candidates, of, at_in_base);
        let sets = candidates.iter().map(supporters);
        // Of equals the one whose supporters are nearest, then the first.
        let best = sets.reduce(|a, b| {
            let better = b.0.len() > a.0.len() || (b.0.len() == a.0.len() && b.1 < a.1);
            if better { b } else { a }
        });
        let Some((supporters, _)) = best else { break };
        let poses: Vec<_> = supporters.iter().map(|at| candidates[*at].camera_from_base).collect();
        if let Ok(camera_from_base) = mean_transform(&poses, None) {
            found.push(Consensus { camera_from_base, configurations: poses.len() });
        }
        let mut index = 0;
        candidates.retain(|_| {
            index += 1;
            !supporters.contains(&(index - 1))
        });
    }
    found
}

/// Of each configuration the candidate nearest to `of`, if it agrees; and how far they are from it in all.
fn supporters(
    candidates: &[Candidate],
    of: &Candidate,
    at_in_base: &Point3<f64>,
) -> (Vec<usize>, f64) {
    let mut nearest: Vec<(usize, usize, f64)> = Vec::new();
    for (index, other) in candidates.iter().enumerate() {
        let (a, b) = (&of.camera_from_base, &other.camera_from_base);
        let metres = (a.point(at_in_base) - b.point(at_in_base)).norm() / SAME_M;
        let radians = a.rotation().angle_to(&b.rotation()) / SAME_RAD;
        if metres > 1.0 || radians > 1.0 {
            continue;
        }
        let apart = metres + radians;
        match nearest.iter_mut().find(|(configuration, ..)| *configuration == other.configuration) {
            Some(known) if known.2 <= apart => {}
            Some(known) => (known.1, known.2) = (index, apart),
            None => nearest.push((other.configuration, index, apart)),
        }
    }
    let apart = nearest.iter().map(|(.., apart)| apart).sum();
    (nearest.into_iter().map(|(_, index, _)| index).collect(), apart)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{UnitQuaternion, Vector3, Vector6};
    use std::f64::consts::PI;

    /// Five configurations that each also name a half turn of the end-effector: what all agree on comes first, though
    /// the wrong ones are named first.
    #[test]
    fn half_turns_do_not_agree() {
        let truth = Transform::<Camera, Base>::from_parts(
            Vector3::new(0.2, -0.1, 1.4),
            UnitQuaternion::from_euler_angles(2.0, 0.3, -0.4),
        );
        let half = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), PI);
        let candidates = (0..5).flat_map(|configuration| {
            let angle = f64::from(configuration);
            let reach = Vector3::new(0.4 + 0.05 * angle, 0.1 * angle, 0.5);
            let base_from_end_effector = Transform::<Base, Base>::from_parts(
                reach,
                UnitQuaternion::from_euler_angles(0.3 * angle, 2.0 + 0.2 * angle, 0.5 * angle),
            );
            let noise =
                0.004 * Vector6::new(angle.sin(), 1.0 - angle / 2.0, 0.3, 0.5, -angle.cos(), 0.2);
            let right = truth.retract(&noise);
            let turned = base_from_end_effector
                * Transform::<Base, Base>::from_parts(Vector3::zeros(), half)
                * base_from_end_effector.inverse();
            let candidate = |camera_from_base| Candidate {
                configuration: configuration as usize,
                camera_from_base,
            };
            [candidate(right * turned), candidate(right)]
        });
        let found = consensus(candidates.collect(), &Point3::new(0.5, 0.2, 0.5), 2);
        let (metres, radians) = found[0].camera_from_base.distance_to(&truth);
        assert_eq!(found[0].configurations, 5);
        assert!(metres < 0.004 && radians < 0.004, "{metres} {radians}");
        assert!(found[1].configurations < 3);
    }

    #[test]
    fn nothing_agrees_on_nothing() {
        assert_eq!(consensus(Vec::new(), &Point3::origin(), 3), Vec::new());
    }
}
