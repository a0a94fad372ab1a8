//! Hands whose box and keypoints were published.

use super::bounding_box::BoundingBox;
use eyebolt_robot::{Arm, JointPositions};
use nalgebra::Point3;

/// A hand whose box and keypoints were published.
#[derive(Debug)]
pub(super) struct Preset {
    /// Name of the end-effector link.
    link: &'static str,
    /// Positions of the fingers that the keypoints were measured at.
    joints: &'static [(&'static str, f64)],
    /// Low and high corner of the box, end-effector frame, metres; for points known to be robot.
    corners: [[f64; 3]; 2],
    /// Name of the link that carries each keypoint, and where it is, end-effector frame, metres.
    keypoints: &'static [(&'static str, [f64; 3])],
}

const LEFT: &str = "panda_leftfinger";
const RIGHT: &str = "panda_rightfinger";

const PRESETS: &[Preset] = &[Preset {
    // Sefercik and Akgun 2022, and their published program.
    link: "panda_hand",
    joints: &[("panda_finger_joint1", 0.04), ("panda_finger_joint2", 0.04)],
    corners: [[-0.05, -0.14, 0.0], [0.05, 0.14, 0.13]],
    keypoints: &[
        ("panda_hand", [0.0198, 0.0809, 0.0032]),
        ("panda_hand", [0.0217, -0.0899, 0.0039]),
        ("panda_hand", [0.0129, 0.0910, 0.0613]),
        ("panda_hand", [0.0208, -0.0979, 0.0561]),
        (LEFT, [-0.0019, 0.0465, 0.1156]),
        (RIGHT, [0.0024, -0.0426, 0.1156]),
    ],
}];

impl Preset {
    /// That of the end-effector of `arm`, if it has all of its links.
    pub(super) fn of(arm: &Arm) -> Option<&'static Self> {
        let has = |link: &str| {
            let index = arm.robot().link_index(link);
            index.is_some_and(|index| arm.end_effector_links().contains(&index))
        };
        PRESETS.iter().find(|preset| {
            preset.link == arm.end_effector_name()
                && preset.keypoints.iter().all(|(link, _)| has(link))
        })
    }

    pub(super) fn joints(&self) -> JointPositions {
        self.joints.iter().map(|(name, position)| ((*name).to_owned(), *position)).collect()
    }

    pub(super) fn bounding_box(&self) -> BoundingBox {
        let [low, high] = self.corners.map(Point3::from);
        BoundingBox { low, high }
    }

    /// The link that carries each keypoint, and where it is in the end-effector frame.
    pub(super) fn keypoints(&self, arm: &Arm) -> Vec<(usize, Point3<f64>)> {
        let of_arm = |(link, point): &(&str, [f64; 3])| {
            Some((arm.robot().link_index(link)?, Point3::from(*point)))
        };
        self.keypoints.iter().filter_map(of_arm).collect()
    }
}
