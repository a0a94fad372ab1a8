//! An arm without the parts of its description that are wrong, as long as it needs none of them.

use super::chain::Arm;
use crate::error::RobotError;
use crate::flaw::{LeftOut, Of};
use crate::robot::{Joint, JointKind};

const COLLISION_STANDS_IN: &str = "the link's collision shapes stand for what it looks like";
const VISUAL_SUFFICES: &str = "what the link looks like is enough";
const NOT_THE_ARM: &str = "the arm does not need it";
const NO_EXTENT: &str = "a shape without extent is none";
const UNPLACED: &str = "what hangs on this joint takes no part";
const OWN_RECORD: &str = "its links take part only where its own position is recorded";

impl Arm {
    /// What of the description is left out for this arm.
    ///
    /// # Errors
    /// The first flaw of a part that the arm needs.
    pub(crate) fn without_flaws(mut self) -> Result<Self, RobotError> {
        let flaws = self.robot.flaws.clone();
        for flaw in flaws {
            let instead = self.without(&flaw.of).ok_or_else(|| flaw.error.clone())?;
            self.left_out.push(LeftOut { problem: flaw.error, instead });
        }
        Ok(self)
    }

    /// What is done without a part; `None` if the arm needs it.
    fn without(&mut self, of: &Of) -> Option<&'static str> {
        match of {
            Of::Nothing(_) => Some(NO_EXTENT),
            Of::Joint(name) => {
                let joint = self.robot.joint_index(name).filter(|_| !self.has_in_chain(name))?;
                self.robot.joints.get_mut(joint)?.kind = JointKind::Undetermined;
                Some(UNPLACED)
            }
            Of::Mimic(name) => (!self.has_in_chain(name)).then_some(OWN_RECORD),
            Of::Visual(name) => self.without_visuals(name),
            Of::Collision(name) => self.without_collisions(name),
        }
    }

    fn without_visuals(&mut self, name: &str) -> Option<&'static str> {
        let link = self.robot.link_index(name)?;
        let needed = self.needs(link);
        if !self.is_below_base(link) {
            return Some(NOT_THE_ARM);
        }
        let whole = !self.robot.flaws.iter().any(|flaw| flaw.of == Of::Collision(name.to_owned()));
        let link = self.robot.links.get_mut(link)?;
        // Half of what a link looks like is worse than all of what is a little coarser.
        link.visuals.clear();
        if whole && !link.collisions.is_empty() {
            // A link without a visual would count as one that nobody sees.
            link.visuals.clone_from(&link.collisions);
            return Some(COLLISION_STANDS_IN);
        }
        (!needed).then_some(NOT_THE_ARM)
    }

    fn without_collisions(&mut self, name: &str) -> Option<&'static str> {
        let link = self.robot.link_index(name)?;
        let needed = self.needs(link);
        let link = self.robot.links.get_mut(link)?;
        link.collisions.clear();
        match link.visuals.is_empty() {
            false => Some(VISUAL_SUFFICES),
            true => (!needed).then_some(NOT_THE_ARM),
        }
    }

    fn has_in_chain(&self, name: &str) -> bool {
        let joint = self.robot.joint_index(name);
        joint.is_some_and(|joint| self.chain.contains(&joint))
    }

    /// Whether the shape of `link` matters: the base, what moves with the chain, the hand. What is
    /// fixed to the base stands beside the arm, as a table does, and other branches are other limbs.
    fn needs(&self, link: usize) -> bool {
        let mut at = link;
        loop {
            if self.below_end_effector.get(at) == Some(&true) {
                return true;
            }
            if let Some(moves) = self.moves_in_chain(at) {
                return moves || at == link;
            }
            let parent = self.robot.links.get(at).and_then(|link| link.parent);
            let fixed = parent
                .filter(|(_, joint)| self.robot.joints.get(*joint).is_some_and(Joint::is_fixed));
            let Some((parent, _)) = fixed else { return false };
            at = parent;
        }
    }

    /// Whether a joint of the chain moves `link`, if the chain leads through it.
    fn moves_in_chain(&self, link: usize) -> Option<bool> {
        let joints = self.chain.iter().filter_map(|joint| self.robot.joints.get(*joint));
        let links = joints.scan(false, |moves, joint| {
            *moves |= joint.moves();
            Some((joint.child, *moves))
        });
        let mut all = std::iter::once((self.base, false)).chain(links);
        all.find(|(other, _)| *other == link).map(|(_, moves)| moves)
    }
}
