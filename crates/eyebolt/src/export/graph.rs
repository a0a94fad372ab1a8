//! Which frames transforms connect, in whatever direction they are told.

use super::frame_name::{FrameName, Named};
use super::static_tree::StaticTree;
use eyebolt_geometry::Transform;
use std::collections::{BTreeMap, VecDeque};

/// Frames and what they are connected to.
#[derive(Default)]
pub(super) struct Graph<'f> {
    neighbours: BTreeMap<&'f FrameName, Vec<Neighbour<'f>>>,
}

/// The name of a neighbour, and its pose in the frame that it is a neighbour of.
type Neighbour<'f> = (&'f FrameName, Transform<Named, Named>);

/// A frame that can be reached.
pub(super) struct Reached<'f> {
    /// Its pose in the frame that the search started at.
    pub(super) start_from_frame: Transform<Named, Named>,
    /// The frame before it on the way; `None` for the start.
    before: Option<&'f FrameName>,
}

impl<'f> Graph<'f> {
    /// The frames of `tree`.
    pub(super) fn of(tree: &'f StaticTree) -> Self {
        let mut graph = Self::default();
        for (child, parent, parent_from_child) in tree.edges() {
            graph.connect(parent, child, *parent_from_child);
        }
        graph
    }

    pub(super) fn connect(
        &mut self,
        parent: &'f FrameName,
        child: &'f FrameName,
        parent_from_child: Transform<Named, Named>,
    ) {
        self.neighbours.entry(parent).or_default().push((child, parent_from_child));
        self.neighbours.entry(child).or_default().push((parent, parent_from_child.inverse()));
    }

    pub(super) fn frames(&self) -> impl Iterator<Item = &'f FrameName> {
        self.neighbours.keys().copied()
    }

    pub(super) fn contains(&self, frame: &FrameName) -> bool {
        self.neighbours.contains_key(frame)
    }

    /// All frames connected to `start`, itself among them.
    pub(super) fn reach(&self, start: &'f FrameName) -> BTreeMap<&'f FrameName, Reached<'f>> {
        let origin = Reached { start_from_frame: Transform::identity(), before: None };
        let mut reached = BTreeMap::from([(start, origin)]);
        let mut queue = VecDeque::from([(start, Transform::identity())]);
        while let Some((frame, start_from_frame)) = queue.pop_front() {
            for (next, frame_from_next) in self.neighbours.get(frame).into_iter().flatten() {
                if !reached.contains_key(next) {
                    let start_from_frame = start_from_frame * *frame_from_next;
                    reached.insert(*next, Reached { start_from_frame, before: Some(frame) });
                    queue.push_back((*next, start_from_frame));
                }
            }
        }
        reached
    }
}

/// The frames from the start of the search to `end`.
pub(super) fn chain<'f>(
    reached: &BTreeMap<&'f FrameName, Reached<'f>>,
    end: &'f FrameName,
) -> Vec<&'f FrameName> {
    // The search leads back to its start, so this ends.
    let back = std::iter::successors(Some(end), |frame| reached.get(frame)?.before);
    let mut chain: Vec<_> = back.collect();
    chain.reverse();
    chain
}
