//! Which links are the base and the end-effector, where nobody says.

use crate::error::RobotError;
use crate::input::Input;
use crate::robot::{Joint, JointKind, Robot};

/// The first link with geometry on the way down from the root through fixed joints; the last link
/// on that way if none has any. Branches that carry no joint, or not the end-effector, don't count.
///
/// A `base_link` without geometry on that way comes before it: it is the frame that others mean, and
/// what carries the geometry may be turned in it (`base_link_inertia`, by 180 degrees).
pub(super) fn base(robot: &Robot, end_effector: Option<usize>) -> Result<usize, RobotError> {
    let leads = leads_to(robot, end_effector);
    let mut link = below_undetermined(robot, end_effector);
    let mut conventional = None;
    loop {
        if robot.shows(link) {
            return Ok(conventional.unwrap_or(link));
        }
        if robot.links.get(link).is_some_and(|link| link.name.ends_with("base_link")) {
            conventional = Some(link);
        }
        let ways: Vec<&Joint> =
            robot.children(link).filter(|way| leads.get(way.child) == Some(&true)).collect();
        let moving =
            robot.children(link).any(|way| way.moves() && on_way(robot, way, end_effector));
        let fixed: Vec<&Joint> = ways.into_iter().filter(|way| way.is_fixed()).collect();
        match fixed.as_slice() {
            [] => return Ok(conventional.unwrap_or(link)),
            [way] if !moving => link = way.child,
            several => {
                let mut candidates = if moving { vec![link] } else { Vec::new() };
                candidates.extend(several.iter().map(|way| way.child));
                return Err(ambiguous(
                    robot,
                    "more than one link may be the base",
                    &candidates,
                    Input::BASE,
                ));
            }
        }
    }
}

/// The root, or the link below the last joint that is known to move somehow, but not where to, and
/// that carries all that moves, or the end-effector: a floating robot, a mobile platform.
fn below_undetermined(robot: &Robot, end_effector: Option<usize>) -> usize {
    let moving = |below: &[bool]| {
        let is_below = |joint: &&Joint| joint.moves() && below.get(joint.parent) == Some(&true);
        robot.joints.iter().filter(is_below).count()
    };
    let all = moving(&vec![true; robot.links.len()]);
    let carries = |joint: &&Joint| {
        let below = robot.at_or_below(joint.child);
        match end_effector {
            Some(end) => below.get(end) == Some(&true),
            None => all > 0 && moving(&below) == all,
        }
    };
    let mut undetermined = robot.joints.iter().filter(|j| !j.is_fixed() && !j.moves());
    undetermined.rfind(carries).map_or(0, |joint| joint.child)
}

/// Per link: whether the way down to the end-effector (or to any moving joint) leads through it.
fn leads_to(robot: &Robot, end_effector: Option<usize>) -> Vec<bool> {
    let mut leads: Vec<bool> = (0..robot.links.len()).map(|l| Some(l) == end_effector).collect();
    // Children come after their parents: from the last joint up, every child is decided.
    for joint in robot.joints.iter().rev() {
        let below = leads.get(joint.child) == Some(&true);
        if let Some(lead) = leads.get_mut(joint.parent) {
            *lead |= below || (end_effector.is_none() && joint.moves());
        }
    }
    leads
}

fn on_way(robot: &Robot, way: &Joint, end_effector: Option<usize>) -> bool {
    end_effector.is_none_or(|end| robot.at_or_below(way.child).get(end) == Some(&true))
}

/// Follows the moving joints down from the base as long as they form one chain. Where they part,
/// the parts are fingers if each has fewer turning joints than the chain so far, else arms.
///
/// Rods of a parallelogram follow joints of the chain and lead nowhere: they are no parts of it.
pub(super) fn end_effector(robot: &Robot, base: usize) -> Result<usize, RobotError> {
    let (turns, moves) = (most_below(robot, turning), most_below(robot, driven));
    let reach = |joint: &Joint| at(&turns, joint.child) + turning(joint);
    let drives = |joint: &Joint| at(&moves, joint.child) + driven(joint);
    let (mut top, mut turned) = (base, 0);
    let mut walked: Vec<usize> = Vec::new();
    loop {
        let body = rigid_body(robot, top);
        let leaving: Vec<&Joint> = (body.iter().flat_map(|link| robot.children(*link)))
            .filter(|joint| joint.moves() && !only_follows(robot, joint, &walked))
            .collect();
        let longest = leaving.iter().map(|joint| reach(joint)).max().unwrap_or(0);
        let is_hand = turned > 0 && leaving.iter().all(|joint| is_finger(robot, joint));
        let next = match leaving.as_slice() {
            [] => return Ok(first_with_geometry(robot, top)),
            fingers if is_hand => return Ok(hand(robot, top, fingers)),
            [only] if longest > 0 || turned == 0 => *only,
            parts if longest <= turned && turned > 0 => match clearly_longest(parts, &reach) {
                Some(arm) => arm,
                None => return Ok(hand(robot, top, parts)),
            },
            several => {
                // With what slides counted: a camera's head may turn as often as an arm that reaches.
                let most = several.iter().map(|joint| drives(joint)).max();
                let arms: Vec<&Joint> =
                    several.iter().filter(|joint| Some(drives(joint)) == most).copied().collect();
                match arms.as_slice() {
                    [only] => *only,
                    _ => return Err(many_arms(robot, &arms)),
                }
            }
        };
        turned += turning(next);
        walked.extend(robot.joints.iter().position(|joint| joint.name == next.name));
        top = next.child;
    }
}

/// The part that has more than twice the turning joints of every other: the chain goes on there, and
/// the others are what a joint without a motor turns, or a camera.
fn clearly_longest<'r>(parts: &[&'r Joint], reach: &dyn Fn(&Joint) -> usize) -> Option<&'r Joint> {
    let longest = parts.iter().copied().max_by_key(|joint| reach(joint))?;
    let others = parts.iter().filter(|part| part.child != longest.child);
    let second = others.map(|part| reach(part)).max()?;
    (second > 0 && reach(longest) > 2 * second && reach(longest) > 2).then_some(longest)
}

/// Whether `joint` and all below it follow joints that were `walked`.
fn only_follows(robot: &Robot, joint: &Joint, walked: &[usize]) -> bool {
    let below = robot.at_or_below(joint.child);
    let within = robot
        .joints
        .iter()
        .filter(|other| other.child == joint.child || below.get(other.parent) == Some(&true));
    let mut moving = within.filter(|joint| joint.moves());
    moving.all(|joint| joint.mimic.is_some_and(|mimic| follows(robot, mimic.joint, walked)))
}

/// Whether the chain of mimics from joint `first` on meets one of `walked`.
fn follows(robot: &Robot, first: usize, walked: &[usize]) -> bool {
    let next = |joint: &usize| Some(robot.joints.get(*joint)?.mimic?.joint);
    std::iter::successors(Some(first), next).any(|joint| walked.contains(&joint))
}

/// Whether all that moves from `joint` on is called what fingers are: names are all there is to tell
/// a jaw that turns from a last axis of the wrist.
fn is_finger(robot: &Robot, joint: &Joint) -> bool {
    const PARTS: [&str; 5] = ["finger", "jaw", "knuckle", "claw", "thumb"];
    const AXES: [&str; 4] = ["wrist", "roll", "pitch", "yaw"];
    let has = |name: &str, words: &[&str]| words.iter().any(|word| name.contains(word));
    let below = robot.at_or_below(joint.child);
    let mut moving = robot.joints.iter().filter(|other| {
        let within = other.child == joint.child || below.get(other.parent) == Some(&true);
        within && other.moves()
    });
    moving.all(|joint| {
        let name = joint.name.to_lowercase();
        let link = robot.links.get(joint.child).map(|link| link.name.to_lowercase());
        has(&name, &PARTS)
            || link.is_some_and(|link| has(&link, &PARTS))
            || (name.contains("gripper") && !has(&name, &AXES))
    })
}

fn many_arms(robot: &Robot, arms: &[&Joint]) -> RobotError {
    // Where each arm ends; an arm that parts again ends there.
    let candidates: Vec<usize> = (arms.iter())
        .map(|joint| end_effector(robot, joint.child).unwrap_or(joint.child))
        .collect();
    let what = "more than one arm, so more than one link may be the end-effector";
    ambiguous(robot, what, &candidates, Input::END_EFFECTOR)
}

fn ambiguous(robot: &Robot, what: &'static str, candidates: &[usize], input: Input) -> RobotError {
    let name = |link: &usize| Some(robot.links.get(*link)?.name.clone());
    let candidates = candidates.iter().filter_map(name).collect();
    RobotError::Ambiguous { file: robot.source.clone(), what, candidates, input }
}

/// 1 for a joint that a motor turns, else 0.
fn turning(joint: &Joint) -> usize {
    let turns = matches!(joint.kind, JointKind::Revolute | JointKind::Continuous);
    usize::from(turns && joint.mimic.is_none())
}

/// 1 for a joint that a motor moves, else 0.
fn driven(joint: &Joint) -> usize {
    usize::from(joint.moves() && joint.mimic.is_none())
}

fn at(counts: &[usize], link: usize) -> usize {
    counts.get(link).copied().unwrap_or(0)
}

/// Per link: the most joints that `counts` on any way down from it.
fn most_below(robot: &Robot, counts: fn(&Joint) -> usize) -> Vec<usize> {
    let mut most = vec![0; robot.links.len()];
    for joint in robot.joints.iter().rev() {
        let below = at(&most, joint.child) + counts(joint);
        if let Some(most) = most.get_mut(joint.parent) {
            *most = below.max(*most);
        }
    }
    most
}

/// `top` and the links fixed below it.
fn rigid_body(robot: &Robot, top: usize) -> Vec<usize> {
    let mut fixed = vec![false; robot.links.len()];
    if let Some(top) = fixed.get_mut(top) {
        *top = true;
    }
    for joint in robot.joints.iter().filter(|joint| joint.is_fixed()) {
        let parent = fixed.get(joint.parent) == Some(&true);
        if let Some(child) = fixed.get_mut(joint.child) {
            *child |= parent;
        }
    }
    fixed.iter().enumerate().filter_map(|(link, fixed)| fixed.then_some(link)).collect()
}

/// The lowest link above all finger joints, or the nearest one above it with geometry.
fn hand(robot: &Robot, top: usize, fingers: &[&Joint]) -> usize {
    let above = |link: usize| {
        std::iter::successors(Some(link), |link| {
            (*link != top).then(|| robot.links.get(*link)?.parent.map(|(parent, _)| parent))?
        })
    };
    let common = |link: &usize| {
        fingers.iter().all(|finger| above(finger.parent).any(|other| other == *link))
    };
    let first = fingers.first().map_or(top, |finger| finger.parent);
    let lowest = above(first).find(common).unwrap_or(top);
    let visible = |link: &usize| robot.shows(*link);
    above(lowest).find(visible).unwrap_or(lowest)
}

/// `top`, or the first link with geometry fixed below it, as long as the way down does not part.
fn first_with_geometry(robot: &Robot, top: usize) -> usize {
    let mut link = top;
    loop {
        if robot.shows(link) {
            return link;
        }
        let mut ways = robot.children(link);
        match (ways.next(), ways.next()) {
            (Some(way), None) => link = way.child,
            _ => return top,
        }
    }
}
