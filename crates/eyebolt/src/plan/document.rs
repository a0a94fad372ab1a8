//! A plan as the JSON that others read. Numbers have their unit in their name.

use super::movable::MovableArm;
use super::next::{Plan, Planned};
use super::request::PlanRequest;
use crate::answer::{Pose, Size};
use eyebolt_robot::JointKind;
use serde::Serialize;

/// Name and version of the form of [`PlanDocument`].
pub const SCHEMA: &str = "eyebolt.plan/1";

/// What a plan's file says.
#[derive(Clone, Debug, Serialize)]
pub struct PlanDocument {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Version of eyebolt that made it.
    pub version: &'static str,
    /// Name of the robot in its URDF.
    pub robot: String,
    /// The base link.
    pub base: String,
    /// The end-effector link.
    pub end_effector: String,
    /// What the plan is made for.
    pub camera: PlannedFor,
    /// How many configurations were asked for.
    pub asked: usize,
    /// Why there are fewer; absent if there are as many.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why_fewer: Option<String>,
    /// Error to expect with what was recorded before; `null` if nothing was.
    pub expected_error_before: Option<Size>,
    /// Error to expect with all of these recorded besides, at `workspace_in_base_m`.
    pub expected_error_after: Option<Size>,
    /// Where errors are measured, base frame, metres.
    pub workspace_in_base_m: [f64; 3],
    /// In the order in which the arm takes them.
    pub configurations: Vec<PlannedConfiguration>,
    /// Where joints that are not planned are taken to stay.
    pub held_joints: Vec<JointValue>,
    /// How long the way through all of them takes with its rests, seconds.
    pub duration_s: f64,
    /// What was checked and what was not, a sentence each.
    pub rules: Vec<String>,
    /// Seed of all random choices.
    pub seed: u64,
}

/// Which camera a plan is made for.
#[derive(Clone, Debug, Serialize)]
pub struct PlannedFor {
    /// Whether nobody knows it: then the plan is for `places` places where people put cameras.
    pub assumed: bool,
    /// How many places there are.
    pub places: usize,
    /// Where it is expected; `null` if it is assumed.
    pub camera_from_base: Option<Pose>,
}

/// A configuration to be recorded.
#[derive(Clone, Debug, Serialize)]
pub struct PlannedConfiguration {
    /// What it is called in other forms of the plan.
    pub name: String,
    /// Positions of the joints, from the base on.
    pub joints: Vec<JointValue>,
    /// Error to expect when this one and all before it are recorded.
    pub expected_error_after: Option<Size>,
    /// Share of the moving links' surface that is within the image and in range.
    pub in_view_share: f64,
    /// Share of the assumed cameras that see it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seen_by_share: Option<f64>,
    /// Share of the moving links' surface where the camera has never seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unseen_share: Option<f64>,
    /// How many places the checked way to it goes through; `null` where its beginning is not known.
    pub way_via: Option<usize>,
}

/// The position of a joint: one of the two numbers.
#[derive(Clone, Debug, Serialize)]
pub struct JointValue {
    /// Name of the joint.
    pub joint: String,
    /// Of one that turns, radians.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_rad: Option<f64>,
    /// Of one that slides, metres.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position_m: Option<f64>,
}

/// What configuration `index`, from 0, is called.
pub(super) fn name(index: usize) -> String {
    format!("eyebolt_{}", index + 1)
}

impl PlanDocument {
    /// Of `plan`, which is the answer to `request`.
    pub fn new(request: &PlanRequest<'_>, plan: &Plan) -> Self {
        let arm = request.arm;
        let assumed = request.cameras.len() > 1;
        let last = plan.configurations.last().map(|last| last.expected).or(plan.before);
        let only = request.cameras.first().filter(|_| !assumed);
        let optical = request.recorded.map(|recorded| {
            recorded.observations.optical_from_camera * recorded.at.camera_from_base
        });
        let configurations = plan.configurations.iter().enumerate();
        Self {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            robot: arm.arm().robot().name.clone(),
            base: arm.arm().base_name().to_owned(),
            end_effector: arm.arm().end_effector_name().to_owned(),
            camera: PlannedFor {
                assumed,
                places: request.cameras.len(),
                camera_from_base: only
                    .map(|only| Pose::new(&optical.unwrap_or(only.camera_from_base))),
            },
            asked: request.count,
            why_fewer: why_fewer(request, plan),
            expected_error_before: plan.before.as_ref().and_then(Size::new),
            expected_error_after: last.as_ref().and_then(Size::new),
            workspace_in_base_m: plan.workspace_in_base.coords.into(),
            configurations: configurations
                .map(|(index, planned)| configuration(arm, index, planned, assumed))
                .collect(),
            held_joints: arm.held().iter().map(|(name, at)| held(arm, name, at)).collect(),
            duration_s: plan.trajectory.last().map_or(0.0, |last| last.at_s),
            rules: rules(request, plan),
            seed: request.seed,
        }
    }

    /// The text of the file: indented JSON with a line break at its end.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data with string keys") + "\n"
    }
}

fn configuration(
    arm: &MovableArm,
    index: usize,
    planned: &Planned,
    assumed: bool,
) -> PlannedConfiguration {
    let joints = arm.joints().iter().zip(&planned.positions);
    PlannedConfiguration {
        name: name(index),
        joints: joints.map(|(joint, at)| value(&joint.name, joint.kind, *at)).collect(),
        expected_error_after: Size::new(&planned.expected),
        in_view_share: planned.in_view_share,
        seen_by_share: assumed.then_some(planned.seen_by),
        unseen_share: planned.unseen_share,
        way_via: planned.via,
    }
}

fn held(arm: &MovableArm, name: &str, at: f64) -> JointValue {
    let robot = arm.arm().robot();
    let kind =
        robot.joint_index(name).map_or(JointKind::Revolute, |index| robot.joints[index].kind);
    value(name, kind, at)
}

fn value(joint: &str, kind: JointKind, at: f64) -> JointValue {
    let slides = kind == JointKind::Prismatic;
    JointValue {
        joint: joint.to_owned(),
        position_rad: (!slides).then_some(at),
        position_m: slides.then_some(at),
    }
}

/// Why there are fewer configurations than asked for.
fn why_fewer(request: &PlanRequest<'_>, plan: &Plan) -> Option<String> {
    let found = plan.configurations.len();
    if found >= request.count {
        return None;
    }
    let mut why = format!("{found} of {}: ", request.count);
    if plan.candidates > found {
        why += &format!(
            "{} configurations are free and in view, but no free way was found to {} of them that were tried. ",
            plan.candidates, plan.unreachable
        );
    } else {
        why += &format!("only {} configurations were found. ", plan.candidates);
    }
    Some(why + &plan.drawn.to_string())
}

/// What the plan keeps to, and what it does not know.
fn rules(request: &PlanRequest<'_>, plan: &Plan) -> Vec<String> {
    let mut rules = vec![
        "eyebolt moves nothing: look at each configuration and at the way before an arm takes it"
            .to_owned(),
        "checked: limits of the joints less 3 %, links 12 mm from each other, all along the way"
            .to_owned(),
    ];
    rules.push(match request.table {
        true => "checked: 12 mm above a table where the lowest part of the base is".to_owned(),
        false => "no table was taken to be there".to_owned(),
    });
    rules.push(match (&request.recorded, request.seen_only) {
        (Some(_), true) => "checked: only where the camera saw through, or where the arm was".to_owned(),
        (Some(_), false) => "checked: at least 30 mm before whatever the camera saw in every view, taken for solid \
             behind; what lies beyond the image, has no depth, or was behind the arm in every view is taken for free"
            .to_owned(),
        (None, _) => "nothing was recorded: of things about the arm, nothing is known".to_owned(),
    });
    if !plan.from_start {
        rules.push("the way to the first configuration is not checked: nobody said where the arm is, or it has no \
             room there".to_owned());
    }
    if request.cameras.len() > 1 {
        rules.push(
            "nobody said where the camera is: record these, then plan the next from that recording"
                .to_owned(),
        );
    }
    rules
}
