//! From a recording to a calibration as the paper has it.

use super::average::{Averaged, FramePose, Group, average};
use super::error::PaperError;
use super::frame::{FrameEstimator, Insane};
use crate::calibrate::{
    Calibration, Deviation, ErrorEstimate, Limits, Reason, Verdict, expected_at,
};
use crate::end_effector::EndEffector;
use crate::label::{FrameLabeller, class_of};
use crate::observations::{Configuration, Observations};
use crate::pipeline::{Outcome, Request};
use crate::pose::{EndEffectorShape, Recognizer};
use crate::progress::{Progress, Step};
use crate::record::{SingleFrame, SingleFrames, observe};
use crate::refine::{ConfigurationOutcome, Dropped};
use eyebolt_geometry::{Base, Camera, PinholeCamera, Transform, mean_transform};
use eyebolt_registration::{Posture, Start};
use nalgebra::{Matrix6, Point3, Vector6};
use std::slice;

/// Who tells which pixels are the end-effector.
#[derive(Debug)]
pub enum FrameLabels {
    /// Networks, and the pose that explains what they say.
    Predicted(Box<Recognizer>),
    /// The arm posed where it is known to be, as the paper's table has it for comparison.
    True(Box<Start>),
}

/// The paper's chain.
#[derive(Debug)]
pub struct Paper {
    /// Tells pixels.
    pub labels: FrameLabels,
    /// Tells poses.
    pub estimator: FrameEstimator,
}

/// Calibrates as the paper does.
///
/// # Errors
///
/// What cannot be read or does not fit; cancelled.
pub fn calibrate(
    request: &Request<'_>,
    paper: &mut Paper,
    progress: &dyn Progress,
) -> Result<Outcome, PaperError> {
    Step::Record.begin(progress)?;
    let observations = observe(request.source, request.arm, &request.cache, &request.options)?;
    Step::Pose.begin(progress)?;
    let seen = frame_poses(request, &observations, paper, progress)?;
    Step::Calibrate.begin(progress)?;
    let frames: Vec<usize> = observations.configurations.iter().map(|c| c.frames.len()).collect();
    let averaged = average(&seen.poses, &frames);
    let calibration = judged(&observations, &averaged, &seen, &request.limits);
    Ok(Outcome { calibration, observations: Some(observations) })
}

/// What the frames say.
#[derive(Debug, Default)]
struct Seen {
    poses: Vec<FramePose>,
    /// Of each configuration, why its last frame that says nothing does not.
    insane: Vec<Option<Insane>>,
}

fn frame_poses(
    request: &Request<'_>,
    observations: &Observations,
    paper: &mut Paper,
    progress: &dyn Progress,
) -> Result<Seen, PaperError> {
    let source = request.source;
    let frames = SingleFrames::new(source, observations, &request.options);
    let end_effector = EndEffector::of(request.arm)?;
    let Paper { labels, estimator } = paper;
    let mut labeller = Labelled::new(labels, observations, request, &end_effector);
    let mut seen = Seen::default();
    let place = |name: &String| {
        let at = source.frame_names().iter().position(|other| other == name)?;
        Some((name.clone(), at))
    };
    for (index, configuration) in observations.configurations.iter().enumerate() {
        progress.advance(index, observations.configurations.len())?;
        let posture = posture(estimator.shape(), observations, configuration);
        let mut insane = None;
        for (name, frame) in configuration.frames.iter().filter_map(place) {
            let frame = match frames.read(frame) {
                Err(crate::record::RecordError::Recording(error))
                    if source.may_leave_out(&error) =>
                {
                    continue;
                }
                read => read?,
            };
            let (label, camera) = labeller.label(&name, &frame, &posture)?;
            let found = estimator.poses(&frame.depth, camera, &label, &posture)?;
            let end_effector_from_base = configuration.base_from_end_effector.inverse();
            match found {
                Ok(found) => seen.poses.extend(found.all().map(|pose| FramePose {
                    configuration: index,
                    camera_from_base: pose * end_effector_from_base,
                })),
                Err(problem) => insane = Some(problem),
            }
        }
        seen.insane.push(insane);
    }
    Ok(seen)
}

/// Where the links of the end-effector are; as without joint states if the arm's model has them otherwise.
fn posture(
    shape: &EndEffectorShape,
    observations: &Observations,
    configuration: &Configuration,
) -> Posture {
    let known = shape.posture_of(&observations.arm, configuration);
    known.unwrap_or_else(|| shape.posture(&eyebolt_robot::JointPositions::default()))
}

/// Labels of single frames.
enum Labelled<'a> {
    Predicted(&'a mut Recognizer, &'a PinholeCamera),
    True(Box<FrameLabeller<'a>>),
}

impl<'a> Labelled<'a> {
    fn new(
        labels: &'a mut FrameLabels,
        observations: &'a Observations,
        request: &Request<'a>,
        end_effector: &'a EndEffector,
    ) -> Self {
        match labels {
            FrameLabels::Predicted(recognizer) => Self::Predicted(recognizer, &observations.camera),
            FrameLabels::True(at) => {
                let labeller = FrameLabeller::new(observations, request.arm, end_effector, **at);
                Self::True(Box::new(labeller))
            }
        }
    }

    /// Labels of a frame, and the camera that they are of.
    fn label(
        &mut self,
        name: &str,
        frame: &SingleFrame,
        posture: &Posture,
    ) -> Result<(Vec<u8>, &PinholeCamera), PaperError> {
        match self {
            Self::Predicted(recognizer, camera) => {
                let found = recognizer.recognize(&frame.depth, camera, slice::from_ref(posture))?;
                Ok((found.segmentation.label, camera))
            }
            Self::True(labeller) => {
                let found = labeller.label(&frame.depth, frame.mask.as_ref(), &frame.joints);
                let source = |source| crate::record::RecordError::Kinematics {
                    frame: name.to_owned(),
                    source,
                };
                let labels = found.map_err(source)?.map(|found| found.labels).unwrap_or_default();
                Ok((labels.into_iter().map(class_of).collect(), labeller.camera()))
            }
        }
    }
}

/// Fewer configurations show nothing of how far their mean is off.
const FEWEST: usize = 3;

fn judged(
    observations: &Observations,
    averaged: &Averaged,
    seen: &Seen,
    limits: &Limits,
) -> Calibration {
    let outcomes = outcomes(observations, averaged, seen);
    let means = averaged.means();
    let mut reasons = Vec::new();
    let needed = limits.configurations.max(FEWEST);
    if means.len() < needed {
        reasons.push(Reason::FewConfigurations { used: means.len(), needed });
    }
    let Some(camera_from_base) = averaged.camera_from_base else {
        reasons.push(Reason::NothingFound);
        let verdict = Verdict::Refused(reasons);
        return Calibration { configurations: outcomes, ..Calibration::without_pose(verdict) };
    };
    let error = (means.len() >= FEWEST)
        .then(|| error(&camera_from_base, &means, &observations.workspace()));
    if let Some(error) = &error {
        reasons.extend(limits.exceeded_by(&error.expected));
    }
    let verdict = if reasons.is_empty() { Verdict::Trusted } else { Verdict::Refused(reasons) };
    Calibration {
        camera_from_base: Some(observations.optical_from_camera * camera_from_base),
        configurations: outcomes,
        error,
        ..Calibration::without_pose(verdict)
    }
}

fn outcomes(
    observations: &Observations,
    averaged: &Averaged,
    seen: &Seen,
) -> Vec<ConfigurationOutcome> {
    let pairs = observations.configurations.iter().zip(&averaged.groups).zip(&seen.insane);
    let outcome =
        |((configuration, group), insane): ((&Configuration, &Group), &Option<Insane>)| {
            let dropped = match (group.camera_from_base, insane) {
                (Some(_), _) if group.is_outlier => Some(Dropped::Outlier),
                (Some(_), _) => None,
                (None, Some(insane)) => Some(Dropped::Insane(insane.to_string())),
                (None, None) => Some(Dropped::FewPoses { poses: group.poses }),
            };
            ConfigurationOutcome {
                frames: configuration.frames.clone(),
                dropped,
                residual_m: None,
                agreement: None,
            }
        };
    pairs.map(outcome).collect()
}

/// How far off the mean is, as far as the configurations disagree, with what surfaces alone are off by.
fn error(
    pose: &Transform<Camera, Base>,
    means: &[Transform<Camera, Base>],
    workspace: &Point3<f64>,
) -> ErrorEstimate {
    let count = means.len() as f64;
    let off: Vec<Vector6<f64>> = means.iter().map(|mean| pose.local(mean)).collect();
    let squares: Matrix6<f64> = off.iter().map(|off| off * off.transpose()).sum();
    let scatter = squares / (count * (count - 1.0));
    let without = |index: usize| {
        let mut rest = means.to_vec();
        rest.remove(index);
        mean_transform(&rest, None).ok().map(|mean| Deviation::between(pose, &mean, workspace))
    };
    let leave_one_out = (0..means.len()).map(without).collect();
    ErrorEstimate { leave_one_out, ..expected_at(pose, scatter, workspace) }
}
