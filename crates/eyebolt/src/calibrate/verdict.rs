//! Whether to trust an answer.

use super::shortlist::total;
use super::{Agreement, ConfigurationOutcome, Deviation, Dropped, ErrorEstimate};
use crate::record::OutsideLimits;
use eyebolt_registration::{ArmJoint, Refinement, StopReason};
use eyebolt_robot::JointKind;

/// What an answer has to meet to be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Distinct arm configurations at least.
    pub configurations: usize,
    /// Expected error at most.
    pub expected: Deviation,
}

impl Default for Limits {
    fn default() -> Self {
        let expected = Deviation { translation_m: 0.020, rotation_rad: 1.2f64.to_radians() };
        Self { configurations: 3, expected }
    }
}

/// Joints may be this far outside their limits: zeros and limits of real arms differ by as much from
/// those of their description, and joints overshoot.
const OUTSIDE_RAD: f64 = 0.1;
const OUTSIDE_M: f64 = 0.01;
/// Zeros of arms that were put together by hand are off by a degree; a joint that seems to be off by
/// more says that its recorded positions are another's.
const JOINT_OFF_RAD: f64 = 0.035;
const FIRST_JOINT_SIGMAS: f64 = 2.0;
/// Share of configurations that may have a misplaced link before the joints themselves are in
/// doubt.
const MISPLACED_SHARE: f64 = 0.25;
/// Share of the posed arm's pixels that may be contradicted: rims and masks are never exact.
const CONTRADICTED_SHARE: f64 = 0.25;
/// Share of the masked pixels that the posed arm need not explain: tools and cables.
const UNEXPLAINED_OF_MASKS: f64 = 0.25;
/// Likewise of what moved, which shadows and reflections add to.
const UNEXPLAINED_OF_MOVING: f64 = 0.45;
/// A last step larger than this says that the refinement was still on its way.
const SETTLED_M: f64 = 2e-3;
const SETTLED_RAD: f64 = 2e-3;

/// Trusted, or refused with reasons.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Use it; it is off by about as much as expected.
    Trusted,
    /// Do not use it.
    Refused(Vec<Reason>),
}

/// Why an answer is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Reason {
    /// Too few distinct configurations.
    #[error(
        "{used} distinct arm configurations could be used, {needed} are needed: record the arm in \
         more positions, far apart and turned differently"
    )]
    FewConfigurations {
        /// Configurations used.
        used: usize,
        /// Configurations needed.
        needed: usize,
    },
    /// No pose was found.
    #[error(
        "no camera pose explains what was seen: check that the robot description is this robot's \
         and that the arm is in view and moves between the configurations"
    )]
    NothingFound,
    /// The robot in the recording is not the robot described.
    #[error("the recording does not fit the robot: {problem}")]
    OtherRobot {
        /// What does not fit.
        problem: String,
    },
    /// Nothing that was seen can be held against the posed arm.
    #[error(
        "nothing was seen where the posed arm would be: check that the arm is in view and that the \
         depth images are not empty there"
    )]
    OutOfView,
    /// The evidence leaves the pose open.
    #[error("the data do not determine the pose: record the arm in positions farther apart")]
    Underdetermined,
    /// The refinement did not settle.
    #[error(
        "the refinement was still moving by {translation_mm:.1} mm and {rotation_deg:.2} degrees \
         when it was stopped"
    )]
    NotSettled {
        /// Last step, millimetres.
        translation_mm: f64,
        /// Last step, degrees.
        rotation_deg: f64,
    },
    /// A joint was recorded where the robot description does not let it be.
    #[error("{0}")]
    OutsideLimits(OutsideLimits),
    /// Links are not where the joints put them in too many configurations.
    #[error(
        "in {misplaced} of {judged} configurations a link is not where the joints put it: check \
         that joint names and order, joint zeros and the robot description are this arm's"
    )]
    Misplaced {
        /// Configurations with a misplaced link.
        misplaced: usize,
        /// Configurations looked at.
        judged: usize,
    },
    /// The answer takes a joint to be farther off than zeros are.
    #[error(
        "joint {joint:?} would have to stand {offset_deg:+.1} degrees from where it says (at most \
         {limit_deg:.1} are trusted): check that joint names and order, joint zeros and the robot \
         description are this arm's"
    )]
    JointOff {
        /// Name of the joint.
        joint: String,
        /// How much farther it stands than it says, degrees.
        offset_deg: f64,
        /// Allowed, either way, degrees.
        limit_deg: f64,
    },
    /// The camera sees through the posed arm.
    #[error(
        "{percent:.0} % of the posed arm's pixels are contradicted by depth or mask (at most \
         {limit:.0} % are trusted): the robot description or the joints are not this arm's"
    )]
    Contradicted {
        /// Percent of the pixels.
        percent: f64,
        /// Percent allowed.
        limit: f64,
    },
    /// The posed arm does not explain what was seen.
    #[error(
        "{percent:.0} % of the arm's pixels are not on the posed arm (at most {limit:.0} % are \
         trusted): the robot description lacks a part, or is not this arm's"
    )]
    Unexplained {
        /// Percent of the pixels.
        percent: f64,
        /// Percent allowed.
        limit: f64,
    },
    /// Another pose explains the data nearly as well.
    #[error(
        "another camera pose explains the data nearly as well: record the arm in positions that \
         tell its sides apart"
    )]
    Ambiguous,
    /// The expected error is too large.
    #[error(
        "the expected error is {translation_mm:.1} mm and {rotation_deg:.2} degrees, more than the \
         {limit_mm:.1} mm and {limit_deg:.2} degrees allowed: record more configurations, nearer \
         to the camera"
    )]
    Inaccurate {
        /// Expected error, millimetres.
        translation_mm: f64,
        /// Expected error, degrees.
        rotation_deg: f64,
        /// Allowed, millimetres.
        limit_mm: f64,
        /// Allowed, degrees.
        limit_deg: f64,
    },
}

/// What a verdict is based on.
pub(crate) struct Evidence<'a> {
    pub refinement: &'a Refinement,
    /// The arm's joints, in the order of the refinement's offsets.
    pub joints: &'a [ArmJoint],
    pub outcomes: &'a [ConfigurationOutcome],
    pub outside_limits: &'a [OutsideLimits],
    pub error: &'a ErrorEstimate,
    /// Whether another pose explains nearly as much.
    pub rival: bool,
    pub masks: bool,
}

/// The verdict where there is no pose at all.
pub(crate) fn nothing_found(
    outcomes: &[ConfigurationOutcome],
    outside_limits: &[OutsideLimits],
    limits: &Limits,
) -> Verdict {
    let known = outside(outside_limits).into_iter().chain(few_configurations(outcomes, limits));
    Verdict::Refused(known.chain([Reason::NothingFound]).collect())
}

/// Weighs the evidence.
pub(crate) fn judge(evidence: &Evidence<'_>, limits: &Limits) -> Verdict {
    let mut reasons: Vec<Reason> = outside(evidence.outside_limits).into_iter().collect();
    match misplaced(evidence.outcomes) {
        Some(misplaced) => reasons.push(misplaced),
        None => reasons.extend(few_configurations(evidence.outcomes, limits)),
    }
    if evidence.refinement.stop == StopReason::Underdetermined {
        reasons.push(Reason::Underdetermined);
        return Verdict::Refused(reasons);
    }
    reasons.extend(joint_off(evidence));
    reasons.extend(disagreement(evidence));
    // How exact an answer is matters only if it is one: advice on accuracy would mislead.
    if reasons.iter().all(is_few_configurations) {
        reasons.extend(stopped(evidence.refinement));
        if evidence.rival {
            reasons.push(Reason::Ambiguous);
        }
        reasons.extend(inaccurate(&evidence.error.expected, limits));
    }
    if reasons.is_empty() { Verdict::Trusted } else { Verdict::Refused(reasons) }
}

fn is_few_configurations(reason: &Reason) -> bool {
    matches!(reason, Reason::FewConfigurations { .. })
}

fn few_configurations(outcomes: &[ConfigurationOutcome], limits: &Limits) -> Option<Reason> {
    let (used, needed) =
        (outcomes.iter().filter(|o| o.dropped.is_none()).count(), limits.configurations);
    (used < needed).then_some(Reason::FewConfigurations { used, needed })
}

/// The joint that is farthest outside its limits, measured by what is allowed.
fn outside(joints: &[OutsideLimits]) -> Option<Reason> {
    let by_allowed = |joint: &OutsideLimits| match joint.kind {
        JointKind::Prismatic => joint.beyond() / OUTSIDE_M,
        _ => joint.beyond() / OUTSIDE_RAD,
    };
    let worst = joints.iter().max_by(|a, b| by_allowed(a).total_cmp(&by_allowed(b)))?;
    (by_allowed(worst) > 1.0).then(|| Reason::OutsideLimits(worst.clone()))
}

fn misplaced(outcomes: &[ConfigurationOutcome]) -> Option<Reason> {
    let misplaced = outcomes.iter().filter(|o| is_misplaced(o)).count();
    let judged = misplaced + outcomes.iter().filter(|o| o.dropped.is_none()).count();
    (misplaced as f64 > MISPLACED_SHARE * judged as f64)
        .then_some(Reason::Misplaced { misplaced, judged })
}

/// The joint that is farthest off, if that is too far.
fn joint_off(evidence: &Evidence<'_>) -> Option<Reason> {
    let offsets = evidence.refinement.joint_offsets.rad;
    let joints = evidence.joints.iter().zip(offsets).zip(evidence.error.joint_sigma_rad);
    // The first joint's is no part of the pose and often hardly seen: only what is sure counts. Others
    // take the pose along with them, sure or not: two exchanged names look like uncertain offsets.
    let by = |joint: &ArmJoint, rad: f64, sigma: f64| match joint.defines_base {
        true => rad.abs() - FIRST_JOINT_SIGMAS * sigma,
        false => rad.abs(),
    };
    let far = joints.map(|((joint, rad), sigma)| (joint, rad, by(joint, rad, sigma)));
    let (joint, rad, far) = far.max_by(|(.., a), (.., b)| a.total_cmp(b))?;
    (far > JOINT_OFF_RAD).then(|| Reason::JointOff {
        joint: joint.name.clone(),
        offset_deg: rad.to_degrees(),
        limit_deg: JOINT_OFF_RAD.to_degrees(),
    })
}

fn is_misplaced(outcome: &ConfigurationOutcome) -> bool {
    matches!(outcome.dropped, Some(Dropped::Misplaced(_)))
}

/// Whether the configurations marked as misplaced, `misplaced` of them, are few enough to go on
/// without them.
pub(crate) fn may_be_dropped(count: usize, outcomes: &[ConfigurationOutcome]) -> bool {
    count > 0 && misplaced(outcomes).is_none()
}

fn stopped(refinement: &Refinement) -> Option<Reason> {
    let step = &refinement.last_step;
    let (metres, radians) = (step.fixed_rows::<3>(0).norm(), step.fixed_rows::<3>(3).norm());
    (metres > SETTLED_M || radians > SETTLED_RAD).then(|| Reason::NotSettled {
        translation_mm: 1e3 * metres,
        rotation_deg: radians.to_degrees(),
    })
}

fn disagreement(evidence: &Evidence<'_>) -> Vec<Reason> {
    let views: Vec<Agreement> = evidence.outcomes.iter().filter_map(|o| o.agreement).collect();
    let all = total(&views);
    let unexplained_limit =
        if evidence.masks { UNEXPLAINED_OF_MASKS } else { UNEXPLAINED_OF_MOVING };
    let (contradicted, unexplained) = (all.contradicted_share(), all.unexplained_share());
    if !all.is_in_view() {
        return vec![Reason::OutOfView];
    }
    let mut reasons = Vec::new();
    if contradicted > CONTRADICTED_SHARE {
        let (percent, limit) = (100.0 * contradicted, 100.0 * CONTRADICTED_SHARE);
        reasons.push(Reason::Contradicted { percent, limit });
    }
    if unexplained > unexplained_limit {
        let (percent, limit) = (100.0 * unexplained, 100.0 * unexplained_limit);
        reasons.push(Reason::Unexplained { percent, limit });
    }
    reasons
}

fn inaccurate(expected: &Deviation, limits: &Limits) -> Option<Reason> {
    let limit = limits.expected;
    let accurate = expected.translation_m <= limit.translation_m
        && expected.rotation_rad <= limit.rotation_rad;
    (!accurate).then(|| Reason::Inaccurate {
        translation_mm: 1e3 * expected.translation_m,
        rotation_deg: expected.rotation_rad.to_degrees(),
        limit_mm: 1e3 * limit.translation_m,
        limit_deg: limit.rotation_rad.to_degrees(),
    })
}
