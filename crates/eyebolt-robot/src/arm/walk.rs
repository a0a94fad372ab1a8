//! Ways up and down the tree of a robot.

use crate::robot::{Joint, Robot};

impl Robot {
    /// Joints from link `top` down to link `bottom`; `None` if `bottom` is not below `top`.
    pub(super) fn chain(&self, top: usize, bottom: usize) -> Option<Vec<usize>> {
        let mut chain = Vec::new();
        let mut link = bottom;
        while link != top {
            let (parent, joint) = self.links.get(link)?.parent?;
            chain.push(joint);
            link = parent;
        }
        chain.reverse();
        Some(chain)
    }

    /// Per link: whether it is `top` or hangs below it.
    pub(super) fn at_or_below(&self, top: usize) -> Vec<bool> {
        let mut below: Vec<bool> = Vec::with_capacity(self.links.len());
        for (index, link) in self.links.iter().enumerate() {
            // Parents come first, so theirs is known.
            let parent = link.parent.and_then(|(parent, _)| below.get(parent).copied());
            below.push(index == top || parent.unwrap_or(false));
        }
        below
    }

    /// The joint at the end of the chain of mimics that starts at `joint`.
    pub(super) fn source_joint(&self, joint: usize) -> Option<&Joint> {
        let mut joint = self.joints.get(joint)?;
        while let Some(mimic) = joint.mimic {
            joint = self.joints.get(mimic.joint)?;
        }
        Some(joint)
    }
}
