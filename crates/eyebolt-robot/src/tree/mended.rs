//! Several roots, and links with two parents: flaws, unless the arm needs to know better.

use super::parsed::{Motion, ParsedJoint, ParsedLink};
use crate::error::RobotError;
use crate::flaw::{Flaw, Of};
use crate::robot::JointKind;
use std::collections::{BTreeSet, HashMap};

/// `joints` so that no link has two parents and all trees hang on one root, with what that hides told
/// as `flaws` of the joints that are left: what hangs on them is nowhere, and no chain leads over them.
///
/// # Errors
///
/// Several trees with equally many joints that move, of which nobody can say which is the robot.
pub(super) fn mended(
    file: &str,
    links: &[ParsedLink],
    joints: Vec<ParsedJoint>,
    flaws: &mut Vec<Flaw>,
) -> Result<Vec<ParsedJoint>, RobotError> {
    let broken = |problem: String| RobotError::Tree { file: file.to_owned(), problem };
    let mut flaw = |joint: &str, problem: String| {
        flaws.push(Flaw { of: Of::Joint(joint.to_owned()), error: broken(problem) });
    };
    let mut carrier: HashMap<String, String> = HashMap::new();
    let mut kept: Vec<ParsedJoint> = Vec::with_capacity(joints.len());
    for joint in joints {
        match carrier.get(&joint.child) {
            Some(first) => {
                let (link, second) = (&joint.child, &joint.name);
                let problem = format!(
                    "link `{link}` is the child of joint `{first}` and of joint `{second}`; remove one"
                );
                flaw(first, problem);
            }
            None => {
                carrier.insert(joint.child.clone(), joint.name.clone());
                kept.push(joint);
            }
        }
    }
    let roots: Vec<&str> = links
        .iter()
        .map(|link| link.name.as_str())
        .filter(|name| !carrier.contains_key(*name))
        .collect();
    if roots.len() < 2 {
        return Ok(kept);
    }
    let problem =
        format!("more than one root: {}; connect them with fixed joints", roots.join(", "));
    let moving: Vec<usize> = roots.iter().map(|root| moving_below(root, &kept)).collect();
    let most = moving.iter().copied().max().unwrap_or(0);
    let fitting: Vec<&str> = roots
        .iter()
        .zip(&moving)
        .filter(|(_, count)| **count == most)
        .map(|(root, _)| *root)
        .collect();
    let main = match fitting.as_slice() {
        [_, _, ..] if most > 0 => return Err(broken(problem)),
        [first, ..] => *first,
        [] => return Ok(kept),
    };
    for root in roots.iter().filter(|root| **root != main) {
        // No name that a file may have.
        let name = format!("(none above {root})");
        flaw(&name, problem.clone());
        let motion = Motion::of(JointKind::Undetermined);
        let (parent, child) = (main.to_owned(), (*root).to_owned());
        kept.push(ParsedJoint { name, parent, child, motion });
    }
    Ok(kept)
}

/// How many joints move below the link `root`.
fn moving_below(root: &str, joints: &[ParsedJoint]) -> usize {
    let mut children: HashMap<&str, Vec<&ParsedJoint>> = HashMap::new();
    for joint in joints {
        children.entry(joint.parent.as_str()).or_default().push(joint);
    }
    let (mut queue, mut seen, mut count) = (vec![root], BTreeSet::from([root]), 0);
    while let Some(link) = queue.pop() {
        for joint in children.get(link).into_iter().flatten() {
            count += usize::from(!matches!(
                joint.motion.kind,
                JointKind::Fixed | JointKind::Undetermined
            ));
            if seen.insert(joint.child.as_str()) {
                queue.push(&joint.child);
            }
        }
    }
    count
}
