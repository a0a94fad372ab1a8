//! Which links are the base and the end-effector, where nobody says.

use crate::error::RobotError;
use crate::input::Input;
use crate::robot::{Joint, JointKind, Robot};

/// The first link with geometry on the way down from the root through fixed joints; the last link
/// on that way if none has any. Branches that carry no joint, or not the end-effector, don't count.
pub(super) fn base(robot: &Robot, end_effector: Option<usize>) -> Result<usize, RobotError> {
    let leads = leads_to(robot, end_effector);
    let mut link = 0;
    loop {
        if robot.links.get(link).is_none_or(|link| link.has_geometry()) {
            return Ok(link);
        }
        let ways: Vec<&Joint> =
            robot.children(link).filter(|way| leads.get(way.child) == Some(&true)).collect();
        let moving =
            robot.children(link).any(|way| way.moves() && on_way(robot, way, end_effector));
        let fixed: Vec<&Joint> = ways.into_iter().filter(|way| !way.moves()).collect();
        match fixed.as_slice() {
            [] => return Ok(link),
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
pub(super) fn end_effector(robot: &Robot, base: usize) -> Result<usize, RobotError> {
    let turns = turning_joints_below(robot);
    let reach = |joint: &Joint| turns.get(joint.child).copied().unwrap_or(0) + turning(joint);
    let (mut top, mut turned) = (base, 0);
    loop {
        let body = rigid_body(robot, top);
        let leaving: Vec<&Joint> = body
            .iter()
            .flat_map(|link| robot.children(*link))
            .filter(|joint| joint.moves())
            .collect();
        let longest = leaving.iter().map(|joint| reach(joint)).max().unwrap_or(0);
        let next = match leaving.as_slice() {
            [] => return Ok(first_with_geometry(robot, top)),
            [only] if longest > 0 || turned == 0 => *only,
            _ if longest <= turned && turned > 0 => return Ok(hand(robot, top, &leaving)),
            several => {
                let arms: Vec<&Joint> =
                    several.iter().filter(|joint| reach(joint) == longest).copied().collect();
                match arms.as_slice() {
                    [only] => *only,
                    _ => return Err(many_arms(robot, &arms)),
                }
            }
        };
        turned += turning(next);
        top = next.child;
    }
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

/// Per link: the most turning joints on any way down from it.
fn turning_joints_below(robot: &Robot) -> Vec<usize> {
    let mut turns = vec![0; robot.links.len()];
    for joint in robot.joints.iter().rev() {
        let below = turns.get(joint.child).copied().unwrap_or(0) + turning(joint);
        if let Some(most) = turns.get_mut(joint.parent) {
            *most = below.max(*most);
        }
    }
    turns
}

/// `top` and the links fixed below it.
fn rigid_body(robot: &Robot, top: usize) -> Vec<usize> {
    let mut fixed = vec![false; robot.links.len()];
    if let Some(top) = fixed.get_mut(top) {
        *top = true;
    }
    for joint in robot.joints.iter().filter(|joint| !joint.moves()) {
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
    let visible = |link: &usize| robot.links.get(*link).is_some_and(|link| link.has_geometry());
    above(lowest).find(visible).unwrap_or(lowest)
}

/// `top`, or the first link with geometry fixed below it, as long as the way down does not part.
fn first_with_geometry(robot: &Robot, top: usize) -> usize {
    let mut link = top;
    loop {
        if robot.links.get(link).is_none_or(|link| link.has_geometry()) {
            return link;
        }
        let mut ways = robot.children(link);
        match (ways.next(), ways.next()) {
            (Some(way), None) => link = way.child,
            _ => return top,
        }
    }
}
