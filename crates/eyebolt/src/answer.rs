//! The calibration as the JSON that others read.
//!
//! Numbers have their unit in their name (intrinsics and covariance in their description); matrices
//! are rows of numbers; quaternions are `xyzw` with
//! `w >= 0`.

mod findings;
mod fixed;

pub use findings::{CameraMovedBetween, LinkLength, Part, StatedIntrinsics};
pub use fixed::Fixed;
pub(crate) use fixed::around;

use crate::calibrate::{Calibration, Deviation, ErrorEstimate, Verdict};
use crate::observations::{Background, ImageSource, Observations};
use crate::pipeline::{Outcome, Request};
use eyebolt_geometry::{CoordinateFrame, Distortion, PinholeCamera, Transform};
use eyebolt_registration::Refinement;
use eyebolt_robot::{Arm, Guessed};
use nalgebra::{Matrix6, Point3};
use serde::Serialize;
use std::collections::BTreeMap;

/// Name and version of the form of [`Answer`].
pub const SCHEMA: &str = "eyebolt.calibration/1";

/// How to read transforms.
pub(crate) const CONVENTION: &str = "a_from_b maps coordinates in b to coordinates in a; camera is the depth \
                          optical frame: x right, y down, z forward";

/// What a calibration file says.
#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Version of eyebolt that made it.
    pub version: &'static str,
    /// `trusted` or `refused`.
    pub verdict: &'static str,
    /// Why it is refused; empty if it is trusted.
    pub reasons: Vec<String>,
    /// Between which frames the answer runs.
    pub frames: Frames,
    /// Maps coordinates in the base frame to the depth optical frame; `null` if nothing was found.
    /// The base frame is the one that the recorded joints refer to: where the first joint's zero is
    /// off, it is turned with it, against the base link as it stands.
    pub camera_from_base: Option<Pose>,
    /// The other way round: the pose of the camera in the base frame.
    pub base_from_camera: Option<Pose>,
    /// Error to expect, at the middle of where the end-effector was.
    pub expected_error: Option<Size>,
    /// Error to expect of the camera's own position in the base, millimetres: farther from where the
    /// arm was seen, a wrong rotation moves more.
    pub camera_position_error_mm: Option<f64>,
    /// Where errors are measured, base frame, metres.
    pub workspace_in_base_m: Option<[f64; 3]>,
    /// What changes when one configuration is left out.
    pub leave_one_out: Option<LeaveOneOut>,
    /// Difference between what surfaces alone and outlines alone would say; `null` if no outline was
    /// seen.
    pub disagreement: Option<Size>,
    /// Covariance of `camera_from_base`: translation (m), then rotation vector (rad), both along
    /// the camera's axes; the rotation is about the base's origin.
    pub covariance: Option<[[f64; 6]; 6]>,
    /// Share of the posed arm's pixels that the camera's depth (or the masks) contradicts.
    pub contradicted_share: Option<f64>,
    /// Share of the arm's pixels that do not lie on the posed arm.
    pub unexplained_share: Option<f64>,
    /// Intersection over union of the posed arm and the masks, if the recording has masks.
    pub silhouette_iou: Option<f64>,
    /// Relative error of the depth's scale that fits best: true depth is `1 + this` times as far.
    pub depth_scale_error: Option<f64>,
    /// By how many pixels the outline seen is wider than the arm's.
    pub outline_excess_px: Option<f64>,
    /// How much farther the joints stand than they say, from the base on: zeros that are off, as far
    /// as the data tell. Empty if nothing was found.
    pub joint_offsets: Vec<JointOffset>,
    /// How far the end-effector is from where the recorded joints put it because their zeros are off:
    /// the most of all configurations, millimetres; `null` if nothing was found. Whoever commands
    /// joints, or computes poses from them, is off by this beside the calibration's own error.
    pub end_effector_off_by_joints_mm: Option<f64>,
    /// When the camera was found to have moved, in order of time: the answer is where it was last.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub camera_moved: Vec<CameraMovedBetween>,
    /// Parts that move with a link and are not in the robot description; they are left out of account.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub unknown_parts: Vec<Part>,
    /// Links that seem to be longer than described, and by how much; allowed for in the answer.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub link_lengths: Vec<LinkLength>,
    /// How far the camera's true intrinsics seem to be from those stated; absent where nothing speaks
    /// for it. Allowed for in the answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intrinsics_offset: Option<StatedIntrinsics>,
    /// One for each frame of the configurations that were used or judged, frames of one configuration
    /// together; frames that were left out, and spare configurations, are counted below.
    pub configurations: Vec<FrameOutcome>,
    /// How many frames of a bag did not take part, by reason: `moving`, `no_joint_state_near`...
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub frames_left_out: BTreeMap<&'static str, usize>,
    /// How many configurations were left out because the others differ more.
    #[serde(skip_serializing_if = "is_zero")]
    pub spare_configurations: usize,
    /// What was added to stamps of depth for the clock of the joints, seconds, if that was needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clock_offset_s: Option<f64>,
    /// What was used as image: `depth_images`; `organised_clouds`, whose grid tells the camera;
    /// `projected_clouds`, drawn with the recording's camera; `drawn_clouds`, with a made-up one.
    pub image_source: Option<&'static str>,
    /// Intrinsics of the images; `null` if their camera was made up.
    pub intrinsics: Option<Intrinsics>,
    /// How the axes of the images are turned in the frame of the points: not at all for depth
    /// images, and hardly for clouds that are in the optical frame as they should be.
    pub optical_from_image: Option<Turn>,
    /// What the recording tells of frames that never move against the camera's or the base
    /// (`/tf_static`): exports place the root of the camera's frames by it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub static_transforms: Vec<Fixed>,
    /// Joints outside the chain that the recording does not have: the links that they move took no
    /// part.
    pub unplaced_joints: Vec<String>,
    /// Positions that the caller stated for joints that the recording does not have: radians, metres
    /// for prismatic joints.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub stated_joints: BTreeMap<String, f64>,
    /// Parts of the robot description that are wrong and that the arm does not need, a sentence each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
    /// Name of the robot in its URDF.
    pub robot: String,
    /// Hash of the URDF's text.
    pub urdf_hash: String,
    /// Whether masks were used.
    pub masks: bool,
    /// What became of the recording's frames without the arm: `used`, or `of_another_scene`; absent
    /// if it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub background: Option<&'static str>,
    /// Seed of the search.
    pub seed: u64,
    /// Milliseconds spent on each stage, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub timing_ms: Option<BTreeMap<String, f64>>,
}

/// Names of the frames.
#[derive(Clone, Debug, Serialize)]
pub struct Frames {
    /// Frame of the camera as the recording names it; the depth optical frame.
    pub camera: Option<String>,
    /// The base link.
    pub base: String,
    /// The end-effector link.
    pub end_effector: String,
    /// Which of `base` and `end_effector` nobody named, so that they were guessed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub guessed: Vec<&'static str>,
    /// How to read the transforms.
    pub convention: &'static str,
}

/// A rigid transform in three spellings.
#[derive(Clone, Debug, Serialize)]
pub struct Pose {
    /// Metres.
    pub translation_m: [f64; 3],
    /// Hamilton quaternion.
    pub rotation_xyzw: [f64; 4],
    /// Homogeneous matrix, rows; metres.
    pub matrix: [[f64; 4]; 4],
}

/// A rotation.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Turn {
    /// Hamilton quaternion.
    pub rotation_xyzw: [f64; 4],
}

/// Size of a deviation.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Size {
    /// Millimetres.
    pub translation_mm: f64,
    /// Degrees.
    pub rotation_deg: f64,
}

/// How much farther a joint stands than it says.
#[derive(Clone, Debug, Serialize)]
pub struct JointOffset {
    /// Name of the joint.
    pub joint: String,
    /// Its true position is the recorded one plus this, degrees.
    pub offset_deg: f64,
    /// Standard deviation of that, degrees.
    pub sigma_deg: f64,
}

impl JointOffset {
    /// Whether the joint's zero is surely off, and by enough to be looked into.
    fn is_notable(&self) -> bool {
        self.offset_deg.abs() > NOTABLE_OFFSET_DEG.max(NOTABLE_SIGMAS * self.sigma_deg)
    }
}

/// Good arms' zeros are off by a few hundredths of a degree.
const NOTABLE_OFFSET_DEG: f64 = 0.05;
/// Surely off: one time in 370 by chance.
const NOTABLE_SIGMAS: f64 = 3.0;

/// What changes when one configuration is left out.
#[derive(Clone, Debug, Serialize)]
pub struct LeaveOneOut {
    /// The largest change.
    pub worst: Size,
    /// Root mean square of the changes.
    pub rms: Size,
}

/// What became of one frame.
#[derive(Clone, Debug, Serialize)]
pub struct FrameOutcome {
    /// The frame's name.
    pub name: String,
    /// Number of its arm configuration; frames with the same joints share one and are merged.
    pub configuration: usize,
    /// Whether nothing spoke against it; only such frames make a trusted answer.
    pub used: bool,
    /// Median distance of the arm's points from the posed arm, millimetres.
    pub residual_mm: Option<f64>,
    /// Why it did not take part.
    pub reason: Option<String>,
}

/// A pinhole camera.
#[derive(Clone, Debug, Serialize)]
pub struct Intrinsics {
    /// Pixels in a row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Focal lengths and principal point, pixels.
    pub fx: f64,
    /// See `fx`.
    pub fy: f64,
    /// See `fx`.
    pub cx: f64,
    /// See `fx`.
    pub cy: f64,
    /// As in ROS: `none`, `plumb_bob` or `rational_polynomial`.
    pub distortion_model: &'static str,
    /// Coefficients in ROS's order.
    pub distortion: Vec<f64>,
}

impl Answer {
    /// The answer to `request`.
    pub fn new(request: &Request<'_>, outcome: &Outcome) -> Self {
        let calibration = &outcome.calibration;
        let observations = outcome.observations.as_ref();
        let (verdict, reasons) = match &calibration.verdict {
            Verdict::Trusted => ("trusted", Vec::new()),
            Verdict::Refused(reasons) => {
                ("refused", reasons.iter().map(ToString::to_string).collect())
            }
        };
        let (error, agreement) = (calibration.error.as_ref(), calibration.agreement());
        let refinement = calibration.refinement.as_ref();
        let robot = request.arm.robot();
        Self {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            verdict,
            reasons,
            frames: frames(request),
            camera_from_base: calibration.camera_from_base.as_ref().map(Pose::new),
            base_from_camera: calibration.camera_from_base.map(|pose| Pose::new(&pose.inverse())),
            expected_error: error.and_then(|error| Size::new(&error.expected)),
            camera_position_error_mm: error.map(|error| 1e3 * error.camera_position_m),
            workspace_in_base_m: error.map(|error| error.workspace_in_base.coords.into()),
            leave_one_out: error.and_then(leave_one_out),
            disagreement: error.and_then(|error| Size::new(&error.disagreement?)),
            covariance: error.and_then(|error| rows(&error.covariance)),
            contradicted_share: agreement.map(|agreement| agreement.contradicted_share()),
            unexplained_share: agreement.map(|agreement| agreement.unexplained_share()),
            silhouette_iou: agreement.and_then(|agreement| agreement.silhouette_iou()),
            depth_scale_error: refinement.map(Refinement::depth_scale),
            outline_excess_px: refinement.map(Refinement::outline_px),
            joint_offsets: observations
                .map(|observations| joint_offsets(observations, calibration))
                .unwrap_or_default(),
            end_effector_off_by_joints_mm: observations
                .and_then(|observations| end_effector_off_mm(observations, calibration)),
            camera_moved: findings::camera_moved(calibration),
            unknown_parts: findings::unknown_parts(calibration),
            link_lengths: findings::link_lengths(outcome),
            intrinsics_offset: findings::intrinsics_offset(outcome),
            configurations: frame_outcomes(calibration),
            frames_left_out: left_out(request, observations),
            spare_configurations: observations
                .map_or(0, |observations| observations.spare_configurations),
            clock_offset_s: request
                .source
                .provenance()
                .clock_offset
                .filter(|offset| offset.applied)
                .map(|offset| offset.seconds),
            image_source: observations.map(|observations| source_name(&observations.source)),
            intrinsics: observations
                .filter(|observations| observations.source != ImageSource::DrawnClouds)
                .map(|observations| Intrinsics::new(&observations.camera)),
            optical_from_image: observations.map(|observations| Turn {
                rotation_xyzw: observations.optical_from_camera.rotation_xyzw(),
            }),
            static_transforms: fixed::around(
                request.source.static_transforms(),
                &[request.source.camera_frame_id().unwrap_or_default(), request.arm.base_name()],
            ),
            unplaced_joints: observations.map(|s| s.unplaced_joints.clone()).unwrap_or_default(),
            stated_joints: BTreeMap::new(),
            left_out: request.arm.left_out().iter().map(ToString::to_string).collect(),
            robot: robot.name.clone(),
            urdf_hash: robot.urdf_hash().to_owned(),
            masks: observations.is_some_and(Observations::has_masks),
            background: observations.and_then(|observations| background(&observations.background)),
            seed: request.seed,
            timing_ms: None,
        }
    }

    /// The text of the file: indented JSON with a line break at its end.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("an answer is plain data");
        text.push('\n');
        text
    }
}

impl Answer {
    /// What was found out about camera, arm and description, a sentence each.
    pub fn findings(&self) -> Vec<String> {
        let moved = self.camera_moved.iter().map(ToString::to_string);
        let parts = self.unknown_parts.iter().map(ToString::to_string);
        let lengths = self.link_lengths.iter().map(ToString::to_string);
        let intrinsics = self.intrinsics_offset.iter().map(ToString::to_string);
        moved.chain(parts).chain(lengths).chain(intrinsics).collect()
    }

    /// The joints whose zeros are surely off, from the base on.
    pub fn notable_joint_offsets(&self) -> impl Iterator<Item = &JointOffset> {
        self.joint_offsets.iter().filter(|joint| joint.is_notable())
    }
}

/// How many frames are left out, by the name of the reason.
fn left_out(
    request: &Request<'_>,
    observations: Option<&Observations>,
) -> BTreeMap<&'static str, usize> {
    let mut counts = request.source.provenance().dropped_by_reason();
    let untold = observations.map_or(0, |observations| observations.untold_frames);
    if untold > 0 {
        counts.insert("joint_not_told", untold);
    }
    counts
}

fn joint_offsets(observations: &Observations, calibration: &Calibration) -> Vec<JointOffset> {
    let (Some(refinement), Some(error)) = (&calibration.refinement, &calibration.error) else {
        return Vec::new();
    };
    let estimates = refinement.joint_offsets.rad.iter().zip(&error.joint_sigma_rad);
    let joints = observations.arm.joints().iter().zip(estimates);
    let told = joints.map(|(joint, (offset, sigma))| JointOffset {
        joint: joint.name.clone(),
        offset_deg: offset.to_degrees(),
        sigma_deg: sigma.to_degrees(),
    });
    told.filter(|joint| joint.sigma_deg.is_finite()).collect()
}

/// The most that offsets of joints move the end-effector in any configuration.
fn end_effector_off_mm(observations: &Observations, calibration: &Calibration) -> Option<f64> {
    let offsets = &calibration.refinement.as_ref()?.joint_offsets;
    let moved = observations.configurations.iter().map(|configuration| {
        let tip = Point3::from(configuration.base_from_end_effector.translation_m());
        1e3 * configuration.posture.moved_by(&observations.arm, offsets, &tip).norm()
    });
    moved.max_by(f64::total_cmp)
}

pub(crate) fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// Names of the links that were guessed.
pub(crate) fn guessed_links(arm: &Arm) -> Vec<&'static str> {
    let Guessed { base, end_effector } = arm.guessed();
    let names = [(base, "base"), (end_effector, "end_effector")];
    names.into_iter().filter_map(|(guessed, name)| guessed.then_some(name)).collect()
}

fn frames(request: &Request<'_>) -> Frames {
    Frames {
        camera: request.source.camera_frame_id().map(str::to_owned),
        base: request.arm.base_name().to_owned(),
        end_effector: request.arm.end_effector_name().to_owned(),
        guessed: guessed_links(request.arm),
        convention: CONVENTION,
    }
}

impl Pose {
    pub(crate) fn new<To: CoordinateFrame, From: CoordinateFrame>(
        pose: &Transform<To, From>,
    ) -> Self {
        let matrix = pose.matrix();
        let row = |r: usize| [0, 1, 2, 3].map(|c| matrix[(r, c)]);
        Self {
            translation_m: pose.translation_m().into(),
            rotation_xyzw: pose.rotation_xyzw(),
            matrix: [0, 1, 2, 3].map(row),
        }
    }
}

impl Size {
    /// `None` where there is no finite number to write.
    pub(crate) fn new(deviation: &Deviation) -> Option<Self> {
        let translation_mm = 1e3 * deviation.translation_m;
        let rotation_deg = deviation.rotation_rad.to_degrees();
        (translation_mm.is_finite() && rotation_deg.is_finite())
            .then_some(Self { translation_mm, rotation_deg })
    }
}

fn leave_one_out(error: &ErrorEstimate) -> Option<LeaveOneOut> {
    let (worst, rms) = (error.worst_left_out()?, error.rms_left_out()?);
    Some(LeaveOneOut { worst: Size::new(&worst)?, rms: Size::new(&rms)? })
}

pub(crate) fn rows(matrix: &Matrix6<f64>) -> Option<[[f64; 6]; 6]> {
    let row = |r: usize| [0, 1, 2, 3, 4, 5].map(|c| matrix[(r, c)]);
    matrix.iter().all(|v| v.is_finite()).then(|| [0, 1, 2, 3, 4, 5].map(row))
}

fn frame_outcomes(calibration: &Calibration) -> Vec<FrameOutcome> {
    let configurations = calibration.configurations.iter().enumerate();
    configurations
        .flat_map(|(index, configuration)| {
            configuration.frames.iter().map(move |name| FrameOutcome {
                name: name.clone(),
                configuration: index,
                used: configuration.dropped.is_none(),
                residual_mm: configuration.residual_m.map(|residual| 1e3 * residual),
                reason: configuration.dropped.as_ref().map(ToString::to_string),
            })
        })
        .collect()
}

fn source_name(source: &ImageSource) -> &'static str {
    match source {
        ImageSource::DepthImages => "depth_images",
        ImageSource::OrganisedClouds { .. } => "organised_clouds",
        ImageSource::ProjectedClouds => "projected_clouds",
        ImageSource::DrawnClouds => "drawn_clouds",
    }
}

impl Intrinsics {
    pub(crate) fn new(camera: &PinholeCamera) -> Self {
        let coefficients = camera.distortion().coefficients();
        let (distortion_model, count) = match camera.distortion() {
            Distortion::None => ("none", 0),
            Distortion::PlumbBob { .. } => ("plumb_bob", 5),
            Distortion::RationalPolynomial { .. } => ("rational_polynomial", 8),
        };
        Self {
            width: camera.width(),
            height: camera.height(),
            fx: camera.fx(),
            fy: camera.fy(),
            cx: camera.cx(),
            cy: camera.cy(),
            distortion_model,
            distortion: coefficients[..count].to_vec(),
        }
    }
}

fn background(background: &Background) -> Option<&'static str> {
    match background {
        Background::None => None,
        Background::Seen(_) => Some("used"),
        Background::OfAnotherScene => Some("of_another_scene"),
    }
}
