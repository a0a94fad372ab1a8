//! Whether to trust an answer.

use super::error::ErrorEstimate;
use super::limits::Limits;
use super::reason::{Reason, Verdict};
use super::still_part::StillPart;
use crate::joint_limits::OutsideLimits;
use crate::refine::{Agreement, ConfigurationOutcome, misplaced, too_many_misplaced, total};
use eyebolt_registration::{ArmJoint, Refinement, StopReason};
use eyebolt_robot::JointKind;

/// Joints may be this far outside their limits: zeros and limits of real arms differ by as much from
/// those of their description, and joints overshoot.
const OUTSIDE_RAD: f64 = 0.1;
const OUTSIDE_M: f64 = 0.01;
/// Zeros of arms that were put together by hand are off by a degree; a joint that seems to be off by
/// more says that its recorded positions are another's.
const JOINT_OFF_RAD: f64 = 0.035;
/// An offset counts from where it is surely not zero: beyond its 95 percent interval.
const JOINT_SIGMAS: f64 = 2.0;
/// Share of the posed arm's pixels that may show the scene behind it. Of a right pose's, clear of its
/// outline, hardly any do; the failures of depth on glossy links do not look like the scene.
const CONTRADICTED_SHARE: f64 = 0.05;
/// A last step larger than this says that the refinement was still on its way.
const SETTLED_M: f64 = 2e-3;
const SETTLED_RAD: f64 = 2e-3;

/// What a verdict is based on.
pub(crate) struct Findings<'a> {
    pub refinement: &'a Refinement,
    /// The arm's joints, in the order of the refinement's offsets.
    pub joints: &'a [ArmJoint],
    pub outcomes: &'a [ConfigurationOutcome],
    pub outside_limits: &'a [OutsideLimits],
    pub error: &'a ErrorEstimate,
    /// Where the links that never move may be; `None` if nothing turns.
    pub still_part: Option<&'a StillPart>,
    /// Two joints that fit better with their names exchanged.
    pub exchanged: Option<[String; 2]>,
    /// Whether another pose explains nearly as much.
    pub rival: bool,
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

/// Weighs the findings.
pub(crate) fn judge(findings: &Findings<'_>, limits: &Limits) -> Verdict {
    let mut reasons: Vec<Reason> = outside(findings.outside_limits).into_iter().collect();
    match misplaced_reason(findings.outcomes) {
        Some(misplaced) => reasons.push(misplaced),
        None => reasons.extend(few_configurations(findings.outcomes, limits)),
    }
    if findings.refinement.stop == StopReason::Underdetermined {
        reasons.push(Reason::Underdetermined);
        return Verdict::Refused(reasons);
    }
    reasons.extend(findings.exchanged.clone().map(|joints| Reason::JointsExchanged { joints }));
    reasons.extend(joint_off(findings));
    reasons.extend(base_elsewhere(findings, limits));
    reasons.extend(contradicted(findings));
    // How exact an answer is matters only if it is one: advice on accuracy would mislead.
    if reasons.iter().all(is_few_configurations) {
        reasons.extend(stopped(findings.refinement));
        if findings.rival {
            reasons.push(Reason::Ambiguous);
        }
        reasons.extend(limits.exceeded_by(&findings.error.expected));
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

fn misplaced_reason(outcomes: &[ConfigurationOutcome]) -> Option<Reason> {
    let (misplaced, judged) = misplaced(outcomes);
    too_many_misplaced(outcomes).then_some(Reason::Misplaced { misplaced, judged })
}

/// The joint that is farthest off, if that is too far.
fn joint_off(findings: &Findings<'_>) -> Option<Reason> {
    let offsets = findings.refinement.joint_offsets.rad;
    let joints = findings.joints.iter().zip(offsets).zip(findings.error.joint_sigma_rad);
    // A joint that is hardly seen takes up whatever is wrong with depth: only what is sure counts. What
    // that does to the pose is part of the expected error.
    let far = joints.map(|((joint, rad), sigma)| (joint, rad, rad.abs() - JOINT_SIGMAS * sigma));
    let (joint, rad, far) = far.max_by(|(.., a), (.., b)| a.total_cmp(b))?;
    (far > JOINT_OFF_RAD).then(|| Reason::JointOff {
        joint: joint.name.clone(),
        offset_deg: rad.to_degrees(),
        limit_deg: JOINT_OFF_RAD.to_degrees(),
    })
}

/// That what never moves is farther from where the description has it than answers may be off.
fn base_elsewhere(findings: &Findings<'_>, limits: &Limits) -> Option<Reason> {
    let (shift_m, limit_m) =
        (findings.still_part?.sure_shift_m().norm(), limits.expected.translation_m);
    let (shift_mm, limit_mm) = (1e3 * shift_m, 1e3 * limit_m);
    (shift_m > limit_m).then_some(Reason::BaseElsewhere { shift_mm, limit_mm })
}

fn stopped(refinement: &Refinement) -> Option<Reason> {
    let step = &refinement.last_step;
    let (metres, radians) = (step.fixed_rows::<3>(0).norm(), step.fixed_rows::<3>(3).norm());
    (metres > SETTLED_M || radians > SETTLED_RAD).then(|| Reason::NotSettled {
        translation_mm: 1e3 * metres,
        rotation_deg: radians.to_degrees(),
    })
}

fn contradicted(findings: &Findings<'_>) -> Option<Reason> {
    let views: Vec<Agreement> = findings.outcomes.iter().filter_map(|o| o.agreement).collect();
    let all = total(&views);
    if !all.is_in_view() {
        return Some(Reason::OutOfView);
    }
    let share = all.contradicted_share();
    let (percent, limit) = (100.0 * share, 100.0 * CONTRADICTED_SHARE);
    (share > CONTRADICTED_SHARE).then_some(Reason::Contradicted { percent, limit })
}
