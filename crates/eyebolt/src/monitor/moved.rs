//! What may have moved, and what each suspect expects.
//!
//! A suspect's evidence is the likelihood of the views with that one thing free and all else as well known as it is
//! (MacKay, Neural Computation 1992): a camera that moved has six numbers to explain the views with, a joint's zero
//! one, and whoever needs fewer is believed rather.

use super::belief::Belief;
use super::detector::{Beliefs, Moment, Suspects};
use super::known::Known;
use eyebolt_registration::{ArmModel, MOST_JOINTS, SHIFTS};
use nalgebra::DMatrix;
use serde::Serialize;

/// Something that may have moved.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Suspect {
    /// The camera or the arm's base: the arm itself looks the same.
    CameraOrBase,
    /// The camera, since the scene behind the arm moved along.
    Camera,
    /// The arm's base, since the scene behind it did not.
    Base,
    /// The zero of the joint of this name.
    JointZero(String),
}

/// How likely a suspect is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Moved {
    /// What.
    pub what: Suspect,
    /// How likely, of all suspects.
    pub probability: f64,
    /// Of a joint, by how much farther it stands than it did, degrees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_deg: Option<f64>,
}

/// How far the camera or the base may have moved, as standard deviations along each axis, metres and radians: hit or hardly
/// touched. A mixture: whoever expects a large move is surprised by a small one.
pub(super) const BY: [f64; 2] = [FAR, 0.01];
/// The larger of them.
pub(super) const FAR: f64 = 0.03;
/// How far the zero of a joint may be off that slipped, as a standard deviation, radians.
const SLIPPED_RAD: f64 = 0.03;
/// Standard deviation of how far joints are off that did not slip: what calibrations know of zeros, radians.
pub(super) const KNOWN_RAD: f64 = 1e-3;

/// The joints that are suspects, by their places among the shifts. The zero of the first joint is none of its own: nothing
/// tells it from a turned base.
fn joints(arm: &ArmModel) -> impl Iterator<Item = (usize, &str)> {
    let joints = arm.joints().iter().enumerate().take(MOST_JOINTS);
    joints.filter(|(_, joint)| !joint.defines_base).map(|(place, j)| (6 + place, j.name.as_str()))
}

/// What is believed before anything is seen.
pub(super) fn beliefs(arm: &ArmModel, known: &Known) -> Beliefs {
    let mut unmoved = Belief::about_zero(&[KNOWN_RAD; SHIFTS]);
    let of_pose = DMatrix::from_fn(6, 6, |i, j| known.covariance[(i, j)]);
    unmoved.covariance.view_mut((0, 0), (6, 6)).copy_from(&of_pose);
    let camera = BY.map(|by| {
        let mut camera = unmoved.clone();
        (0..6).for_each(|i| camera.covariance[(i, i)] += by * by);
        camera
    });
    let slipped = |(place, _): (usize, &str)| {
        let mut belief = unmoved.clone();
        belief.covariance[(place, place)] += SLIPPED_RAD.powi(2);
        belief
    };
    let others = joints(arm).map(slipped).collect();
    Beliefs { suspects: Suspects { pose: camera.to_vec(), others }, unmoved }
}

/// The suspects since `moment`, likeliest first.
pub(super) fn suspects(arm: &ArmModel, moment: &Moment) -> Vec<Moved> {
    let best = moment.suspects.iter().map(|(log, _)| *log).fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = moment.suspects.iter().map(|(log, _)| (log - best).exp()).sum();
    let share = |(log, _): &(f64, Belief)| (log - best).exp() / sum;
    let Suspects { pose, others } = &moment.suspects;
    let camera = Moved {
        what: Suspect::CameraOrBase,
        probability: pose.iter().map(share).sum(),
        joint_deg: None,
    };
    let slipped = joints(arm).zip(others).map(|((place, name), suspect)| Moved {
        what: Suspect::JointZero(name.to_owned()),
        probability: share(suspect),
        joint_deg: Some(suspect.1.mean[place].to_degrees()),
    });
    let told = std::iter::once(camera).chain(slipped);
    let mut told: Vec<Moved> = told.collect();
    told.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    told
}
