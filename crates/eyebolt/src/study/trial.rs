//! One session from beginning to end.

use super::ending::{Answered, Ending, Refusal};
use super::quantile::quantiles;
use super::session::Session;
use super::tampering::Tampering;
use crate::calibrate::{Calibration, Deviation, Verdict};
use crate::pipeline::{self, Request};
use crate::simulate::{Plan, Scenario, SimulateError, plan};
use eyebolt_recording::InMemory;
use eyebolt_registration::LinkCache;
use eyebolt_robot::Arm;

/// A session and how it ended.
#[derive(Clone, Debug)]
pub struct SessionResult {
    /// The session.
    pub session: Session,
    /// How it ended.
    pub ending: Ending,
    /// What simulating it took, seconds.
    pub simulate_s: f64,
    /// What calibrating it took, seconds.
    pub calibrate_s: f64,
}

/// Seeds tried for a session, each with a camera at another place, until one sees the arm.
const TRIES: u64 = 6;

/// Simulates `session`, calibrates it and holds the answer against the truth. `clock` tells seconds,
/// since any moment; `cache` keeps shapes of links.
pub fn try_session(session: Session, cache: &LinkCache, clock: &dyn Fn() -> f64) -> SessionResult {
    let arm = session.robot.arm();
    let begun = clock();
    let simulated = simulate(&session, &arm, cache);
    let simulate_s = clock() - begun;
    let begun = clock();
    let ending = match &simulated {
        Ok((plan, source)) => calibrated(&session, plan, source, &arm, cache),
        Err(SimulateError::Frame(error)) => Ending::Failed(Refusal::of_error(error)),
        Err(error) => Ending::Unfit(error.to_string()),
    };
    SessionResult { session, ending, simulate_s, calibrate_s: clock() - begun }
}

fn simulate<'a>(
    session: &Session,
    arm: &'a Arm,
    cache: &LinkCache,
) -> Result<(Plan<'a>, InMemory), SimulateError> {
    let scenario = |attempt: u64| Scenario {
        arm,
        urdf: session.robot.urdf,
        sensor: session.sensor,
        viewpoint: session.viewpoint,
        configurations: session.configurations,
        frames: session.frames,
        moving_frames: 0,
        backgrounds: session.backgrounds,
        clutter: session.clutter,
        faults: session.faults,
        seed: session.seed.wrapping_add(attempt),
    };
    let first = plan(scenario(0), cache);
    let planned = (1..TRIES).fold(first, |planned, attempt| match planned {
        Err(SimulateError::Unfit { .. }) => plan(scenario(attempt), cache),
        settled => settled,
    });
    let plan = planned?;
    let source = plan.in_memory()?;
    Ok((plan, source))
}

fn calibrated(
    session: &Session,
    plan: &Plan<'_>,
    source: &InMemory,
    arm: &Arm,
    cache: &LinkCache,
) -> Ending {
    let tampered = session.tampering.as_ref().map(|tampering| tampering.apply(source, arm));
    let source = match &tampered {
        None => source,
        Some(Ok(tampered)) => tampered,
        Some(Err(error)) => return Ending::Failed(Refusal::of_error(error)),
    };
    let described = match &session.tampering {
        Some(Tampering::OtherRobot(other)) => other.arm(),
        _ => arm.clone(),
    };
    let request = Request { cache: cache.clone(), ..Request::new(source, &described) };
    match pipeline::run(&request, &()) {
        Ok(outcome) => Ending::Answered(answered(&outcome.calibration, plan)),
        Err(error) => Ending::Failed(Refusal::of_error(&error)),
    }
}

/// `calibration` against the truth. Of a camera that was bumped the truth is where it stood first, unless
/// the answer says that it is of a later place.
fn answered(calibration: &Calibration, plan: &Plan<'_>) -> Answered {
    let at = plan.workspace_in_base();
    let pose = calibration.camera_from_base.as_ref();
    let off = |truth| pose.map(|pose| Deviation::between(pose, truth, &at));
    let after = plan.sought_camera_from_base_after();
    let first = plan.sought_camera_from_base();
    let later = after.as_ref().filter(|_| !calibration.camera_moved.is_empty());
    Answered {
        error: off(later.unwrap_or(&first)),
        error_after_bump: after.as_ref().and_then(off),
        still_part: calibration.still_part.as_ref().and_then(|still| still.best),
        expected: calibration.error.as_ref().map(|error| error.expected),
        quantiles: calibration.error.as_ref().zip(pose).map(|(e, pose)| quantiles(e, pose, &at)),
        refusals: match &calibration.verdict {
            Verdict::Trusted => Vec::new(),
            Verdict::Refused(reasons) => reasons.iter().map(Refusal::of).collect(),
        },
    }
}
