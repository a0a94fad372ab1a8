//! One recording, looked at in all ways.

use super::calibration::Evaluation;
use super::pose_errors::PoseErrors;
use super::scores::{BEST, Calibrated, METHODS, NOTHING, OURS, OURS_ICP, Scores, TRUE_ICP};
use crate::end_effector::{EndEffector, EndEffectorError};
use crate::label::{FrameLabeller, class_of};
use crate::markers::MarkerFailure;
use crate::model_files::ModelFiles;
use crate::networks::{Networks, NetworksError};
use crate::observations::Observations;
use crate::paper::{self, FrameEstimator, FrameLabels, Paper, PaperError};
use crate::pipeline::{self, Failure, Outcome, Request};
use crate::pose::{
    EndEffectorShape, PoseError, PoseEstimator, PoseMethod, RecognizeError, Recognizer,
};
use crate::progress::{Cancelled, Progress};
use crate::record::{RecordError, SingleFrames, observe};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::Start;

/// What a recording is held against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Where the camera is: the truth of a simulation, or another calibration.
    pub camera_from_base: Transform<Camera, Base>,
}

/// The networks of a model.
#[derive(Clone, Debug)]
pub struct Model {
    /// What it is called in tables.
    pub name: String,
    /// Its networks.
    pub files: ModelFiles,
}

/// What keeps a recording from being evaluated.
#[derive(Debug, thiserror::Error)]
pub enum EvaluateError {
    /// Of a calibration.
    #[error(transparent)]
    Paper(#[from] PaperError),
    /// Of one by a marker.
    #[error(transparent)]
    Marker(#[from] MarkerFailure),
    /// The recording cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The end-effector has no shape.
    #[error(transparent)]
    EndEffector(#[from] EndEffectorError),
    /// The networks cannot be read, or cannot look at a frame.
    #[error(transparent)]
    Recognize(#[from] RecognizeError),
    /// Those for poses.
    #[error(transparent)]
    Pose(#[from] PoseError),
    /// The networks of a calibration.
    #[error(transparent)]
    Networks(#[from] NetworksError),
    /// Ended.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<Failure> for EvaluateError {
    fn from(failure: Failure) -> Self {
        Self::Paper(failure.into())
    }
}

/// Evaluates what `model` makes of the recording of `request`: labels and poses of every frame at rest, and calibrations.
///
/// True labels are those of the arm drawn where `reference` has it; pixels of which nobody can say what they show count
/// nowhere.
///
/// # Errors
///
/// What cannot be read or does not fit; cancelled.
pub fn session(
    request: &Request<'_>,
    reference: &Reference,
    model: &Model,
    progress: &dyn Progress,
) -> Result<Scores, EvaluateError> {
    let observations = observe(request.source, request.arm, &request.cache, &request.options)?;
    let pose = observations.optical_from_camera.inverse() * reference.camera_from_base;
    let mut scores = frames(request, &observations, &pose, model, progress)?;
    let off = |outcome: &Outcome| {
        let pose = outcome.calibration.camera_from_base.as_ref()?;
        Some(Evaluation::of(pose, &reference.camera_from_base))
    };
    for (method, outcome) in calibrations(request, &pose, model, progress)? {
        let trusted = outcome.calibration.verdict == crate::calibrate::Verdict::Trusted;
        scores.calibrations.push(Calibrated { method, off: off(&outcome), trusted });
    }
    Ok(scores)
}

fn frames(
    request: &Request<'_>,
    observations: &Observations,
    camera_from_base: &Transform<Camera, Base>,
    model: &Model,
    progress: &dyn Progress,
) -> Result<Scores, EvaluateError> {
    let source = request.source;
    let end_effector = EndEffector::of(request.arm)?;
    let truth = FrameLabeller::new(
        observations,
        request.arm,
        &end_effector,
        Start::from(*camera_from_base),
    );
    let frames = SingleFrames::new(source, observations, &request.options);
    let shape = EndEffectorShape::of(request.arm, &request.cache)?;
    let mut recognizer = Recognizer::open(&model.files, shape)?;
    let mut estimators = Estimators::open(request, &model.files)?;
    let mut scores = Scores::default();
    let count = source.frame_names().len();
    for index in 0..count {
        progress.advance(index, count)?;
        let frame = match frames.read(index) {
            Err(RecordError::Recording(error)) if source.may_leave_out(&error) => continue,
            read => read?,
        };
        let name = || source.frame_names().get(index).cloned().unwrap_or_default();
        let labelled = truth.label(&frame.depth, frame.mask.as_ref(), &frame.joints);
        let labelled =
            labelled.map_err(|source| RecordError::Kinematics { frame: name(), source })?;
        let Some(labelled) = labelled else { continue };
        let true_label: Vec<u8> = labelled.labels.iter().copied().map(class_of).collect();
        let found = recognizer.recognize(&frame.depth, &observations.camera, &[])?;
        let (found_label, answer) = (found.segmentation.label, found.answer);
        scores.labels.add(&true_label, &found_label);
        for (label, answer, errors) in [
            (&true_label, None, &mut scores.by_true_labels),
            (&found_label, Some(answer), &mut scores.by_found_labels),
        ] {
            for ((_, method, refines), errors) in METHODS.iter().zip(errors.iter_mut()) {
                let Some(estimator) = estimators.of(*method, *refines) else { continue };
                let (depth, camera) = (&frame.depth, &observations.camera);
                let found = match (method, &answer) {
                    // What the program answers, labels and all.
                    (PoseMethod::Fused, Some(answer)) => answer.clone(),
                    _ => estimator.estimate(depth, camera, label, None)?,
                };
                let pose = &labelled.camera_from_end_effector;
                errors.add(estimator.shape(), &frame.joints, found.as_ref(), pose);
            }
        }
    }
    Ok(scores)
}

/// Estimators of one model: a method whose networks it lacks has none.
struct Estimators(Vec<PoseEstimator>);

impl Estimators {
    fn open(request: &Request<'_>, model: &ModelFiles) -> Result<Self, EvaluateError> {
        let shape = EndEffectorShape::of(request.arm, &request.cache)?;
        let open = |(_, method): &(&str, PoseMethod)| match PoseEstimator::open(
            model,
            shape.clone(),
            *method,
        ) {
            Err(PoseError::NoNetwork { .. }) => None,
            opened => Some(opened),
        };
        Ok(Self(PoseMethod::ALL.iter().filter_map(open).collect::<Result<_, _>>()?))
    }

    fn of(&mut self, method: PoseMethod, refines: bool) -> Option<&mut PoseEstimator> {
        let estimator = self.0.iter_mut().find(|estimator| estimator.method == method)?;
        estimator.refines = refines;
        Some(estimator)
    }
}

fn calibrations(
    request: &Request<'_>,
    camera_from_base: &Transform<Camera, Base>,
    model: &Model,
    progress: &dyn Progress,
) -> Result<Vec<(&'static str, Outcome)>, EvaluateError> {
    let files = &model.files;
    let shape = EndEffectorShape::of(request.arm, &request.cache)?;
    let open = || PoseEstimator::open(files, shape.clone(), PoseMethod::Fused);
    let predicted = || {
        let recognizer = Recognizer::open(files, shape.clone())?;
        Ok::<_, EvaluateError>(FrameLabels::Predicted(Box::new(recognizer)))
    };
    let known = FrameLabels::True(Box::new(Start::from(*camera_from_base)));
    let mut outcomes = Vec::new();
    for (method, labels, refines) in
        [(OURS, predicted()?, false), (OURS_ICP, predicted()?, true), (TRUE_ICP, known, true)]
    {
        let estimator = FrameEstimator::new(open()?, refines);
        outcomes
            .push((method, paper::calibrate(request, &mut Paper { labels, estimator }, progress)?));
    }
    let networks = Networks::open(files, request)?;
    outcomes.push((BEST, pipeline::run(&networks.request(request), progress)?));
    outcomes.push((NOTHING, pipeline::run(request, progress)?));
    Ok(outcomes)
}

impl PoseErrors {
    /// Whether no frame was looked at.
    pub(super) fn is_empty(&self) -> bool {
        self.frames == 0
    }
}
