//! From a recording to a calibration: record, label, pose, refine, calibrate.
//!
//! The only file that knows the order of the stages.

use crate::calibrate::{Calibration, Jackknife, Limits, Reason, Verdict, calibrate};
use crate::label::{Labeller, before_pose};
use crate::observations::Observations;
use crate::other_unit::{self, Scaled};
use crate::pose::{GlobalSearch, PoseProposer};
use crate::progress::{Cancelled, Progress, Step};
use crate::record::{RecordError, RecordOptions, observe};
use crate::refine::refine_best;
use eyebolt_recording::FrameSource;
use eyebolt_registration::{LinkCache, Posture};
use eyebolt_robot::{Arm, KinematicsError};
use std::error::Error;

/// What to calibrate, and how.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// Where the frames come from.
    pub source: &'a dyn FrameSource,
    /// The arm in them.
    pub arm: &'a Arm,
    /// Where shapes of links are kept between runs.
    pub cache: LinkCache,
    /// What to read of the source.
    pub options: RecordOptions,
    /// Tells the arm's pixels before a pose is known; otherwise masks do, or motion.
    pub labeller: Option<&'a dyn Labeller>,
    /// Proposes poses; otherwise the global search does.
    pub proposer: Option<&'a dyn PoseProposer>,
    /// What an answer has to meet to be trusted.
    pub limits: Limits,
    /// How the answers without single configurations are found.
    pub jackknife: Jackknife,
    /// Seed of the search.
    pub seed: u64,
}

impl<'a> Request<'a> {
    /// Calibrates `arm` in the frames of `source`, by defaults in all else; nothing is kept on disk.
    pub fn new(source: &'a dyn FrameSource, arm: &'a Arm) -> Self {
        Self {
            source,
            arm,
            cache: LinkCache::disabled(),
            options: RecordOptions::default(),
            labeller: None,
            proposer: None,
            limits: Limits::default(),
            jackknife: Jackknife::default(),
            seed: 1,
        }
    }
}

/// A calibration with what it was made from.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The answer and the verdict.
    pub calibration: Calibration,
    /// What was seen; `None` if the recording is not of this robot.
    pub observations: Option<Observations>,
}

/// Why there is no outcome at all.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The recording or the robot cannot be read, or do not fit.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The labeller of the request did not label every configuration.
    #[error("the labeller told of {found} configurations, and there are {wanted}")]
    Labels {
        /// How many it labelled.
        found: usize,
        /// How many there are.
        wanted: usize,
    },
    /// The labeller failed.
    #[error("the arm's pixels cannot be told: {0}")]
    Labeller(#[source] Box<dyn Error + Send + Sync>),
    /// The proposer of poses failed.
    #[error("no pose can be proposed: {0}")]
    Proposer(#[source] Box<dyn Error + Send + Sync>),
    /// Whoever hears of the progress ended it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// An answer with a verdict, or what kept the recording or the robot from being read.
///
/// # Errors
///
/// What [`observe`] reports; but a recording with none of the robot's joints is refused.
pub fn run(request: &Request<'_>, progress: &dyn Progress) -> Result<Outcome, Failure> {
    let mut outcome = once(request, progress)?;
    if let Some(reason) = other_unit(request, &outcome, progress)? {
        // An arm of the wrong size fits nowhere: what else is said is of that.
        outcome.calibration.verdict = Verdict::Refused(vec![reason]);
    }
    Ok(outcome)
}

/// That the arm fits where depth is in another unit, if it does.
fn other_unit(
    request: &Request<'_>,
    outcome: &Outcome,
    progress: &dyn Progress,
) -> Result<Option<Reason>, Failure> {
    let Some(observations) = &outcome.observations else { return Ok(None) };
    // Labels and poses of a caller's own are of the depth as it is.
    let (Some(unit_m), None, None) =
        (request.source.integer_unit_m(), request.labeller, request.proposer)
    else {
        return Ok(None);
    };
    let verdict = &outcome.calibration.verdict;
    let factors = other_unit::candidates(request.source, observations, verdict);
    for (done, factor) in factors.iter().enumerate() {
        progress.advance(done, factors.len())?;
        let scaled = Scaled { source: request.source, factor: *factor };
        let options = other_unit::few(&request.options);
        let (source, arm): (&dyn FrameSource, _) = (&scaled, request.arm);
        let trial = Request {
            source,
            arm,
            cache: request.cache.clone(),
            options,
            limits: request.limits,
            seed: request.seed,
            ..Request::new(source, arm)
        };
        let tried = once(&trial, &());
        let fits = tried.is_ok_and(|tried| tried.calibration.verdict == Verdict::Trusted);
        tracing::debug!(factor, fits, "depth in another unit");
        if fits {
            return Ok(Some(Reason::DepthUnit { unit_m, fitting_m: factor * unit_m }));
        }
    }
    Ok(None)
}

fn once(request: &Request<'_>, progress: &dyn Progress) -> Result<Outcome, Failure> {
    let Request { source, arm, cache, options, limits, jackknife, .. } = request;

    Step::Record.begin(progress)?;
    let observations = match observe(*source, arm, cache, options) {
        Err(RecordError::Kinematics { source, .. }) if is_other_robot(arm, &source) => {
            return Ok(Outcome::of_another_robot(arm, &source));
        }
        observed => observed?,
    };

    Step::Label.begin(progress)?;
    let labeller = request.labeller.unwrap_or_else(|| before_pose(&observations));
    let labelling = labeller.label(&observations).map_err(Failure::Labeller)?;
    let (found, wanted) = (labelling.labels.len(), observations.configurations.len());
    if found != wanted {
        return Err(Failure::Labels { found, wanted });
    }

    Step::Pose.begin(progress)?;
    let search = GlobalSearch::new(request.seed);
    let proposer = request.proposer.unwrap_or(&search);
    let hypotheses = proposer.propose(&observations, &labelling).map_err(Failure::Proposer)?;

    Step::Refine.begin(progress)?;
    let found = refine_best(&observations, &labelling.labels, &hypotheses, progress)?;

    Step::Calibrate.begin(progress)?;
    let calibration = calibrate(&observations, found, limits, *jackknife, progress)?;

    Ok(Outcome { calibration, observations: Some(observations) })
}

impl Outcome {
    /// No answer, since the recording is not of `arm`.
    fn of_another_robot(arm: &Arm, problem: &KinematicsError) -> Self {
        let problem = format!("robot {:?}: {problem}", arm.robot().name);
        let verdict = Verdict::Refused(vec![Reason::OtherRobot { problem }]);
        Self { calibration: Calibration::without_pose(verdict), observations: None }
    }

    /// Where the answer has the links in each configuration: with the joint offsets that it found.
    pub fn postures(&self) -> Vec<Posture> {
        let Some(observations) = &self.observations else { return Vec::new() };
        let offsets = self.calibration.refinement.as_ref().map(|r| r.joint_offsets);
        let offsets = offsets.unwrap_or_default();
        let configurations = observations.configurations.iter();
        configurations.map(|c| c.posture.moved(&observations.arm, &offsets)).collect()
    }
}

/// Whether the recording has not a single joint of the arm.
fn is_other_robot(arm: &Arm, error: &KinematicsError) -> bool {
    let KinematicsError::MissingArmJoints { missing, .. } = error else { return false };
    missing.len() == arm.required_joints().len()
}
