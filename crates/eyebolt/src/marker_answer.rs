//! A calibration by a marker as the JSON that others read: of the same form as without one, where they have
//! the same to say.

use crate::answer::{
    CONVENTION, Fixed, Frames, Intrinsics, LeaveOneOut, Pose, SCHEMA, Size, around, guessed_links,
    is_zero, rows,
};
use crate::calibrate::{Deviation, Verdict};
use crate::markers::{
    Arrangement, EyeInHand, EyeToHand, MarkerCalibration, MarkerErrorEstimate, MarkerObservations,
    MarkerRequest, difference,
};
use crate::pipeline::Outcome;
use eyebolt_markers::hand_eye::{Refined, Start};
use serde::Serialize;
use std::collections::BTreeMap;

/// What a calibration file by a marker says.
#[derive(Clone, Debug, Serialize)]
pub struct MarkerAnswer {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Version of eyebolt that made it.
    pub version: &'static str,
    /// `trusted` or `refused`.
    pub verdict: &'static str,
    /// Why it is refused; empty if it is trusted.
    pub reasons: Vec<String>,
    /// `eye_to_hand` or `eye_in_hand`.
    pub arrangement: &'static str,
    /// Between which frames the answer runs.
    pub frames: Frames,
    /// Maps coordinates in the base frame to the depth optical frame; `null` if nothing was found, or the
    /// camera is on the hand.
    pub camera_from_base: Option<Pose>,
    /// The other way round.
    pub base_from_camera: Option<Pose>,
    /// The same of a camera on the hand.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera_from_end_effector: Option<Pose>,
    /// The other way round.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_effector_from_camera: Option<Pose>,
    /// Error to expect, in the middle of where the marker was seen.
    pub expected_error: Option<Size>,
    /// What adds to it, in squares.
    pub error_parts: BTreeMap<&'static str, Size>,
    /// Error to expect of the camera's own position, millimetres.
    pub camera_position_error_mm: Option<f64>,
    /// Where errors are measured, in the base frame (of a camera on the hand, in the end-effector's), metres.
    pub workspace_m: Option<[f64; 3]>,
    /// What changes when one configuration is left out (of many, a group of them).
    pub leave_one_out: Option<LeaveOneOut>,
    /// Covariance of the answer, in coordinates as without a marker.
    pub covariance: Option<[[f64; 6]; 6]>,
    /// The marker, and what was found out about it.
    pub marker: Marker,
    /// What the arm's own shape says from there on, where depth was recorded.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub markerless: Option<Markerless>,
    /// One for each frame of the configurations that were looked at.
    pub configurations: Vec<MarkerFrame>,
    /// How many frames of a bag did not take part, by reason.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub frames_left_out: BTreeMap<&'static str, usize>,
    /// How many configurations were left out because the others differ more.
    #[serde(skip_serializing_if = "is_zero")]
    pub spare_configurations: usize,
    /// Always `color_pictures`.
    pub image_source: &'static str,
    /// Intrinsics of the pictures.
    pub intrinsics: Intrinsics,
    /// As without a marker.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub static_transforms: Vec<Fixed>,
    /// Name of the robot in its URDF.
    pub robot: String,
    /// Hash of the URDF's text.
    pub urdf_hash: String,
}

/// The marker, and what was found out about it.
#[derive(Clone, Debug, Serialize)]
pub struct Marker {
    /// As it was asked for, with the number that was found.
    pub target: String,
    /// The marker on the end-effector (of a camera on the hand, in the base frame): a tag's middle, a board's
    /// upper left corner, x right, y down.
    pub pose: Option<Pose>,
    /// How much larger than said it seems to be, percent; allowed for.
    pub size_error_percent: Option<f64>,
    /// Standard deviation of that, percent.
    pub size_sigma_percent: Option<f64>,
    /// Standard deviation of a coordinate of a point in a picture, pixels.
    pub sigma_px: Option<f64>,
    /// What each closed-form solver says, by its name, before anything is refined.
    pub solvers: BTreeMap<&'static str, SolverAnswer>,
}

/// What a closed-form solver says.
#[derive(Clone, Debug, Serialize)]
pub struct SolverAnswer {
    /// How far it is from the refined answer.
    pub from_refined: Option<Size>,
    /// How many configurations took part.
    pub configurations: usize,
    /// Why it says nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub problem: Option<String>,
}

/// What the arm's own shape says.
#[derive(Clone, Debug, Serialize)]
pub struct Markerless {
    /// `trusted`, `refused`, or `failed` where it could not be tried.
    pub verdict: &'static str,
    /// Why it is refused or failed.
    pub reasons: Vec<String>,
    /// Its answer.
    pub camera_from_base: Option<Pose>,
    /// Error that it expects.
    pub expected_error: Option<Size>,
    /// How far it is from the marker's answer, in the middle of where the marker was seen.
    pub difference: Option<Size>,
}

/// What became of one frame.
#[derive(Clone, Debug, Serialize)]
pub struct MarkerFrame {
    /// The frame's name.
    pub name: String,
    /// Number of its configuration.
    pub configuration: usize,
    /// Whether it took part.
    pub used: bool,
    /// Root mean square distance of the marker's points from where the answer has them, pixels.
    pub residual_px: Option<f64>,
    /// Why it took no part.
    pub reason: Option<String>,
}

/// An arrangement that has a place in the answer.
pub trait Answered: Arrangement {
    /// Puts the camera's pose where it belongs.
    fn put(answer: &mut MarkerAnswer, calibration: &MarkerCalibration<Self>)
    where
        Self: Sized;
}

impl Answered for EyeToHand {
    fn put(answer: &mut MarkerAnswer, calibration: &MarkerCalibration<Self>) {
        answer.camera_from_base = calibration.camera_from_root.as_ref().map(Pose::new);
        answer.base_from_camera =
            calibration.camera_from_root.map(|pose| Pose::new(&pose.inverse()));
    }
}

impl Answered for EyeInHand {
    fn put(answer: &mut MarkerAnswer, calibration: &MarkerCalibration<Self>) {
        answer.camera_from_end_effector = calibration.camera_from_root.as_ref().map(Pose::new);
        answer.end_effector_from_camera =
            calibration.camera_from_root.map(|pose| Pose::new(&pose.inverse()));
    }
}

impl MarkerAnswer {
    /// The answer to `request`.
    pub fn new<A: Answered>(
        request: &MarkerRequest<'_>,
        observations: &MarkerObservations,
        calibration: &MarkerCalibration<A>,
    ) -> Self {
        let (refined, error) = (calibration.refined.as_ref(), calibration.error.as_ref());
        let robot = request.arm.robot();
        let trusted = calibration.reasons.is_empty();
        let mut answer = Self {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            verdict: if trusted { "trusted" } else { "refused" },
            reasons: calibration.reasons.iter().map(ToString::to_string).collect(),
            arrangement: A::NAME,
            frames: Frames {
                camera: request.source.camera_frame_id().map(str::to_owned),
                base: request.arm.base_name().to_owned(),
                end_effector: request.arm.end_effector_name().to_owned(),
                guessed: guessed_links(request.arm),
                convention: CONVENTION,
            },
            camera_from_base: None,
            base_from_camera: None,
            camera_from_end_effector: None,
            end_effector_from_camera: None,
            expected_error: error.and_then(|error| Size::new(&error.expected)),
            error_parts: error.map(parts).unwrap_or_default(),
            camera_position_error_mm: error.map(|error| 1e3 * error.camera_position_m),
            workspace_m: error.map(|error| error.workspace_in_root.coords.into()),
            leave_one_out: error.and_then(|error| leave_one_out(error.leave_one_out.as_ref()?)),
            covariance: error.and_then(|error| rows(&error.covariance)),
            marker: marker::<A>(&observations.target.to_string(), refined, &calibration.starts),
            markerless: None,
            configurations: frames(observations, calibration),
            frames_left_out: left_out(request, observations),
            spare_configurations: observations.spare_configurations,
            image_source: "color_pictures",
            intrinsics: Intrinsics::new(&observations.camera),
            static_transforms: around(
                request.source.static_transforms(),
                &[request.source.camera_frame_id().unwrap_or_default(), request.arm.base_name()],
            ),
            robot: robot.name.clone(),
            urdf_hash: robot.urdf_hash().to_owned(),
        };
        A::put(&mut answer, calibration);
        answer
    }

    /// The text of the file: indented JSON with a line break at its end.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("an answer is plain data");
        text.push('\n');
        text
    }
}

impl Markerless {
    /// Of `outcome`, which began at the answer of `calibration`.
    pub fn new(outcome: &Outcome, calibration: &MarkerCalibration<EyeToHand>) -> Self {
        let (verdict, reasons) = match &outcome.calibration.verdict {
            Verdict::Trusted => ("trusted", Vec::new()),
            Verdict::Refused(reasons) => {
                ("refused", reasons.iter().map(ToString::to_string).collect())
            }
        };
        let from = calibration.camera_from_root.zip(calibration.error.as_ref());
        Self {
            verdict,
            reasons,
            camera_from_base: outcome.calibration.camera_from_base.as_ref().map(Pose::new),
            expected_error: outcome.calibration.error.as_ref().and_then(|e| Size::new(&e.expected)),
            difference: from.and_then(|(pose, error)| {
                Size::new(&difference(outcome, &pose, &error.workspace_in_root)?)
            }),
        }
    }

    /// That it could not be tried.
    pub fn failed(problem: String) -> Self {
        let reasons = vec![problem];
        Self {
            verdict: "failed",
            reasons,
            camera_from_base: None,
            expected_error: None,
            difference: None,
        }
    }
}

fn parts(error: &MarkerErrorEstimate) -> BTreeMap<&'static str, Size> {
    let each = error.parts.iter();
    each.filter_map(|part| Some((part.source, Size::new(&part.expected)?))).collect()
}

fn leave_one_out(all: &[Deviation]) -> Option<LeaveOneOut> {
    let worst = all.iter().copied().fold(Deviation::default(), Deviation::larger);
    let mean = |part: &dyn Fn(&Deviation) -> f64| {
        (all.iter().map(|d| part(d).powi(2)).sum::<f64>() / all.len().max(1) as f64).sqrt()
    };
    let rms = Deviation {
        translation_m: mean(&|d| d.translation_m),
        rotation_rad: mean(&|d| d.rotation_rad),
    };
    Some(LeaveOneOut { worst: Size::new(&worst)?, rms: Size::new(&rms)? })
}

fn marker<A: Arrangement>(
    target: &str,
    refined: Option<&Refined<A::Root, A::Carrier>>,
    starts: &[Start<A::Root, A::Carrier>],
) -> Marker {
    let solver = |start: &Start<A::Root, A::Carrier>| SolverAnswer {
        from_refined: start.answer.ok().zip(refined).and_then(|(answer, refined)| {
            let (translation_m, rotation_rad) =
                answer.camera_from_root.distance_to(&refined.hand_eye.camera_from_root);
            Size::new(&Deviation { translation_m, rotation_rad })
        }),
        configurations: start.used,
        problem: start.answer.err().map(|error| error.to_string()),
    };
    Marker {
        target: target.to_owned(),
        pose: refined.map(|refined| Pose::new(&refined.hand_eye.carrier_from_marker)),
        size_error_percent: refined.map(|refined| 100.0 * refined.size_error),
        size_sigma_percent: refined.map(|r| 100.0 * r.size_sigma).filter(|sigma| sigma.is_finite()),
        sigma_px: refined.map(|refined| refined.sigma_px),
        solvers: starts.iter().map(|start| (start.solver.name(), solver(start))).collect(),
    }
}

fn frames<A: Arrangement>(
    observations: &MarkerObservations,
    calibration: &MarkerCalibration<A>,
) -> Vec<MarkerFrame> {
    let both = observations.configurations.iter().zip(&calibration.configurations).enumerate();
    both.flat_map(|(index, (configuration, outcome))| {
        configuration.frames.iter().map(move |name| MarkerFrame {
            name: name.clone(),
            configuration: index,
            used: outcome.dropped.is_none() && outcome.rms_px.is_some(),
            residual_px: outcome.rms_px.filter(|px| px.is_finite()),
            reason: outcome.dropped.as_ref().map(ToString::to_string),
        })
    })
    .collect()
}

fn left_out(
    request: &MarkerRequest<'_>,
    observations: &MarkerObservations,
) -> BTreeMap<&'static str, usize> {
    let mut counts = request.source.provenance().dropped_by_reason();
    if observations.untold_frames > 0 {
        counts.insert("joint_not_told", observations.untold_frames);
    }
    counts
}
