//! The configuration that would tell most.

use super::unit::Unit;
use eyebolt::pipeline::Outcome;
use eyebolt::plan::{
    Calibrated, MovableArm, PlanDocument, PlanRequest, Recorded, RoughCamera, Speed, plan_next,
    told_range_m,
};
use eyebolt_robot::JointPositions;
use serde::Serialize;

/// The configuration that would tell most, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Next {
    /// Of how many configurations what was known is.
    pub after: usize,
    /// Whether the pose of the camera that it goes by is trusted.
    pub trusted: bool,
    /// Where the joints of the chain are in it; empty if there is none.
    pub joints: Vec<NextJoint>,
    /// Error to expect with it, millimetres and degrees.
    pub expected_mm_deg: Option<[f64; 2]>,
    /// What was checked, and what was not, a sentence each.
    pub rules: Vec<String>,
    /// Why there is none.
    pub why_none: Option<String>,
}

/// A joint of the configuration to be taken.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NextJoint {
    /// Its name.
    pub joint: String,
    /// In degrees, or millimetres of one that slides.
    pub at: f64,
}

/// As `eyebolt plan` moves joints by default, radians and metres a second.
const TURNING_RAD_S: f64 = 0.2;
const SLIDING_M_S: f64 = 0.05;
const REST_S: f64 = 3.0;

impl Next {
    /// None, and why.
    pub(super) fn none(why: String) -> Self {
        Self { why_none: Some(why), ..Self::default() }
    }

    /// After `outcome`, for an arm whose joints are at `joints` now; with the positions of all joints in it, if there is one.
    pub(super) fn plan(
        outcome: &Outcome,
        arm: &MovableArm,
        joints: &JointPositions,
        seed: u64,
    ) -> (Self, Option<JointPositions>) {
        let calibration = &outcome.calibration;
        let parts = outcome.observations.as_ref().zip(calibration.refinement.as_ref());
        let Some((observations, refinement)) = parts else {
            return (Self::none("the pose of the camera is not known yet".to_owned()), None);
        };
        let at = refinement.end();
        let cameras = [RoughCamera {
            camera: observations.camera.clone(),
            camera_from_base: at.camera_from_base,
            range_m: told_range_m(observations),
        }];
        let calibrated = calibration.error.as_ref().map(|error| Calibrated {
            expected: error.expected,
            covariance: error.covariance,
            workspace_in_base: error.workspace_in_base,
        });
        let request = PlanRequest {
            arm,
            cameras: &cameras,
            recorded: Some(Recorded { observations, at }),
            calibrated,
            start: arm.positions_of(joints),
            count: 1,
            table: true,
            seen_only: false,
            speed: Speed::new(arm.joints(), TURNING_RAD_S, SLIDING_M_S),
            rest_s: REST_S,
            seed,
        };
        let plan = plan_next(&request);
        let document = PlanDocument::new(&request, &plan);
        let first = plan.configurations.first();
        let positions = first.map(|first| arm.all_joints(&first.positions));
        let planned = first.map(|first| arm.joints().iter().zip(&first.positions));
        let joints = planned.into_iter().flatten().map(|(joint, at)| NextJoint {
            joint: joint.name.clone(),
            at: Unit::of(joint.kind).shown(*at),
        });
        let size = document.configurations.first().and_then(|first| first.expected_error_after);
        let next = Self {
            after: observations.configurations.len(),
            trusted: calibration.verdict == eyebolt::calibrate::Verdict::Trusted,
            joints: joints.collect(),
            expected_mm_deg: size.map(|size| [size.translation_mm, size.rotation_deg]),
            rules: document.rules,
            why_none: document.why_fewer,
        };
        (next, positions)
    }
}
