//! Links and joints by name into one tree, parents first.

mod mended;
mod parsed;

use crate::error::RobotError;
use crate::flaw::{Flaw, Of};
use crate::robot::{Joint, Link, Mimic};
use mended::mended;
use parsed::Followed;
pub(crate) use parsed::{Motion, ParsedJoint, ParsedLink};
use std::collections::{BTreeSet, HashMap, VecDeque};

/// Most links: a humanoid with hands has some 200.
const MAX_LINKS: usize = 5_000;

/// Links in an order in which parents come first, joints in the order of their children.
pub(crate) fn build(
    file: &str,
    links: Vec<ParsedLink>,
    joints: Vec<ParsedJoint>,
    flaws: &mut Vec<Flaw>,
) -> Result<(Vec<Link>, Vec<Joint>), RobotError> {
    let broken = |problem: String| RobotError::Tree { file: file.to_owned(), problem };
    if links.len() > MAX_LINKS {
        let count = links.len();
        return Err(broken(format!(
            "{count} links, but a robot may have {MAX_LINKS}; remove some"
        )));
    }
    unique("link", links.iter().map(|link| link.name.as_str())).map_err(broken)?;
    unique("joint", joints.iter().map(|joint| joint.name.as_str())).map_err(broken)?;
    let joints = mended(file, &links, joints, flaws)?;
    let order = order(&links, &joints).map_err(broken)?;
    let (links, mut joints, followed) = assemble(links, joints, &order);
    let unfollowed =
        [connect_mimics(&mut joints, followed), cut_mimic_cycles(&mut joints)].concat();
    let flaw = |(joint, problem)| Flaw { of: Of::Mimic(joint), error: broken(problem) };
    flaws.extend(unfollowed.into_iter().map(flaw));
    Ok((links, joints))
}

fn unique<'n>(what: &str, names: impl Iterator<Item = &'n str>) -> Result<(), String> {
    let mut seen = BTreeSet::new();
    for name in names {
        if !seen.insert(name) {
            return Err(format!("two {what}s are called `{name}`; rename or remove one"));
        }
    }
    Ok(())
}

/// Links from the root down: (index of the link, index of the joint that carries it).
fn order(
    links: &[ParsedLink],
    joints: &[ParsedJoint],
) -> Result<Vec<(usize, Option<usize>)>, String> {
    let by_name: HashMap<&str, usize> =
        links.iter().enumerate().map(|(index, link)| (link.name.as_str(), index)).collect();
    let mut carrier: Vec<Option<usize>> = vec![None; links.len()];
    let mut children: HashMap<usize, Vec<usize>> = HashMap::new();
    for (index, joint) in joints.iter().enumerate() {
        let find = |end: &str, link: &str| {
            by_name.get(link).copied().ok_or_else(|| {
                format!("joint `{}`, {end}: there is no link `{link}`; add it", joint.name)
            })
        };
        let (parent, child) = (find("parent", &joint.parent)?, find("child", &joint.child)?);
        children.entry(parent).or_default().push(child);
        if let Some(carrier) = carrier.get_mut(child) {
            *carrier = Some(index);
        }
    }
    let root = only_root(links, &carrier)?;
    let mut order = Vec::with_capacity(links.len());
    let mut queue = VecDeque::from([root]);
    while let Some(link) = queue.pop_front() {
        order.push((link, carrier.get(link).copied().flatten()));
        queue.extend(children.get(&link).into_iter().flatten());
    }
    if order.len() < links.len() {
        let reached: BTreeSet<usize> = order.iter().map(|(link, _)| *link).collect();
        let names: Vec<_> = (links.iter().enumerate())
            .filter(|(index, _)| !reached.contains(index))
            .map(|(_, link)| link.name.as_str())
            .collect();
        let names = names.join(", ");
        return Err(format!("the joints form a cycle through links {names}; remove one joint"));
    }
    Ok(order)
}

fn only_root(links: &[ParsedLink], carrier: &[Option<usize>]) -> Result<usize, String> {
    let roots: Vec<usize> = (carrier.iter().enumerate())
        .filter_map(|(index, joint)| joint.is_none().then_some(index))
        .collect();
    match roots.as_slice() {
        [root, ..] => Ok(*root),
        [] if links.is_empty() => Err("there are no links; give the URDF of a robot".to_owned()),
        [] => Err("no link is the root: the joints form a cycle; remove one joint".to_owned()),
    }
}

fn assemble(
    links: Vec<ParsedLink>,
    joints: Vec<ParsedJoint>,
    order: &[(usize, Option<usize>)],
) -> (Vec<Link>, Vec<Joint>, Vec<Followed>) {
    let mut links: Vec<Option<ParsedLink>> = links.into_iter().map(Some).collect();
    let mut joints: Vec<Option<ParsedJoint>> = joints.into_iter().map(Some).collect();
    let mut new_links: Vec<Link> = Vec::with_capacity(order.len());
    let mut new_joints: Vec<Joint> = Vec::with_capacity(joints.len());
    let mut followed = Vec::with_capacity(joints.len());
    let mut place: HashMap<String, usize> = HashMap::new();
    for (link, joint) in order {
        let Some(link) = links.get_mut(*link).and_then(Option::take) else { continue };
        let joint = joint.and_then(|joint| joints.get_mut(joint)?.take());
        let child = new_links.len();
        let parent = joint.as_ref().and_then(|joint| place.get(&joint.parent).copied());
        place.insert(link.name.clone(), child);
        let ParsedLink { name, visuals, collisions } = link;
        let parent_and_joint = parent.map(|parent| (parent, new_joints.len()));
        new_links.push(Link { name, parent: parent_and_joint, visuals, collisions });
        if let (Some(parent), Some(joint)) = (parent, joint) {
            let Motion { kind, parent_from_child_at_zero, axis, limits, most_per_s, mimic } =
                joint.motion;
            followed.push(mimic);
            let name = joint.name;
            new_joints.push(Joint {
                name,
                kind,
                parent,
                child,
                parent_from_child_at_zero,
                axis,
                limits,
                most_per_s,
                mimic: None,
            });
        }
    }
    (new_links, new_joints, followed)
}

/// What each joint follows: name, multiplier, offset. Returns the joints that follow nothing that
/// moves, which then follow nothing, and what is wrong with them.
fn connect_mimics(joints: &mut [Joint], followed: Vec<Followed>) -> Vec<(String, String)> {
    let mut problems = Vec::new();
    let by_name: HashMap<String, (usize, bool)> = (joints.iter().enumerate())
        .map(|(index, joint)| (joint.name.clone(), (index, joint.moves())))
        .collect();
    for (joint, mimic) in joints.iter_mut().zip(followed) {
        let Some((name, multiplier, offset)) = mimic else { continue };
        joint.mimic = match by_name.get(&name) {
            Some((other, true)) => Some(Mimic { joint: *other, multiplier, offset }),
            Some((_, false)) => {
                let follower = &joint.name;
                let problem = format!(
                    "joint `{follower}`, mimic: `{name}` is fixed; follow a joint that moves"
                );
                problems.push((follower.clone(), problem));
                None
            }
            None => {
                let follower = &joint.name;
                let problem =
                    format!("joint `{follower}`, mimic: no joint `{name}`; correct the name");
                problems.push((follower.clone(), problem));
                None
            }
        };
    }
    problems
}

/// Lets one joint of every cycle of mimics follow nothing; these, and what is wrong with them.
fn cut_mimic_cycles(joints: &mut [Joint]) -> Vec<(String, String)> {
    let mut problems = Vec::new();
    // Each joint is walked once: `checked` are those known to end at a joint that follows none.
    let mut checked = BTreeSet::new();
    for start in 0..joints.len() {
        let mut walked = BTreeSet::new();
        let mut next = Some(start);
        while let Some(index) = next.filter(|index| !checked.contains(index)) {
            let Some(joint) = joints.get_mut(index) else { break };
            if !walked.insert(index) {
                let name = joint.name.clone();
                let problem = format!("joint `{name}`, mimic: it follows itself; remove one mimic");
                problems.push((name, problem));
                joint.mimic = None;
                break;
            }
            next = joint.mimic.map(|mimic| mimic.joint);
        }
        checked.extend(walked);
    }
    problems
}
