//! From a recording to a calibration.

use crate::calibrate::{Calibration, Limits, Reason, Verdict, calibrate};
use crate::progress::{Progress, Step};
use crate::record::{self, RecordError, RecordOptions};
use crate::session::Session;
use eyebolt_recording::Recording;
use eyebolt_registration::LinkCache;
use eyebolt_robot::{Arm, KinematicsError};

/// What to calibrate, and how.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// The recording.
    pub recording: &'a Recording,
    /// The arm in it.
    pub arm: &'a Arm,
    /// Where shapes of links are kept between runs.
    pub cache: &'a LinkCache,
    /// What to read of the recording.
    pub options: RecordOptions,
    /// What an answer has to meet to be trusted.
    pub limits: Limits,
    /// Seed of the search.
    pub seed: u64,
}

/// A calibration with what it was made from.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The answer and the verdict.
    pub calibration: Calibration,
    /// What was seen, with the arm's links where the answer has them; `None` if the recording is not
    /// of this robot.
    pub session: Option<Session>,
}

/// Record, label, pose, refine, calibrate: an answer with a verdict, or the error that kept the
/// recording or the robot from being read.
///
/// # Errors
///
/// What [`record::open`] reports; but a recording with none of the robot's joints is refused.
pub fn run(request: &Request<'_>, progress: &dyn Progress) -> Result<Outcome, RecordError> {
    progress.begin(Step::Record);
    let Request { recording, arm, cache, options, limits, seed } = request;
    match record::open(recording, arm, cache, options) {
        Ok(mut session) => {
            let calibration = calibrate(&session, limits, *seed, progress);
            if let Some(refinement) = &calibration.refinement {
                session.move_joints(&refinement.joint_offsets);
            }
            Ok(Outcome { calibration, session: Some(session) })
        }
        Err(RecordError::Kinematics { source, .. }) if is_other_robot(arm, &source) => {
            let problem = format!("robot {:?}: {source}", arm.robot().name);
            let verdict = Verdict::Refused(vec![Reason::OtherRobot { problem }]);
            Ok(Outcome { calibration: Calibration::without_pose(verdict), session: None })
        }
        Err(error) => Err(error),
    }
}

/// Whether the recording has not a single joint of the arm.
fn is_other_robot(arm: &Arm, error: &KinematicsError) -> bool {
    let KinematicsError::MissingArmJoints { missing, .. } = error else { return false };
    missing.len() == arm.required_joints().len()
}
