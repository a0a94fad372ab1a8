//! Frames by their parents, checked.

use crate::export::error::ExportError;
use crate::export::frame_name::{FrameName, Named};
use eyebolt_geometry::Transform;
use std::collections::{BTreeMap, BTreeSet};

/// Largest part of a translation, metres: sums of many more than that would lose a millimetre.
const MAX_TRANSLATION_M: f64 = 1e6;

/// By how much two messages about the same two frames may differ, metres and radians.
const SAME: f64 = 1e-6;

/// A fixed transform from a frame to its parent, not yet checked.
#[derive(Clone, Debug)]
pub struct StaticEdge {
    /// Name of the parent; tf's `header.frame_id`.
    pub parent: String,
    /// Name of the child; tf's `child_frame_id`.
    pub child: String,
    /// The pose of the child in the parent.
    pub parent_from_child: Transform<Named, Named>,
}

/// Frames that never move against each other: each has at most one parent, and none is above
/// itself. Trees that nothing connects may stand side by side.
#[derive(Clone, Debug, Default)]
pub struct StaticTree {
    source: String,
    /// By child: its parent, and its pose in it.
    edges: BTreeMap<FrameName, (FrameName, Transform<Named, Named>)>,
    /// Whether the source has joints that move, which are not in the tree.
    pub(in crate::export) moves: bool,
}

impl StaticTree {
    /// No frames at all.
    pub fn empty() -> Self {
        Self::default()
    }

    /// The tree of `edges`, which came from `source` (for messages). An edge may be told twice.
    ///
    /// # Errors
    /// Names that are none, a translation beyond all measure, an edge told twice in different ways,
    /// a frame with two parents, and frames in a cycle.
    pub fn from_edges(source: &str, edges: Vec<StaticEdge>) -> Result<Self, ExportError> {
        let mut tree = Self { source: source.to_owned(), ..Self::default() };
        for edge in edges {
            tree.insert(edge)?;
        }
        tree.check_cycles()?;
        Ok(tree)
    }

    fn insert(&mut self, edge: StaticEdge) -> Result<(), ExportError> {
        let source = &self.source;
        let name = |name: &str, field: &str| {
            FrameName::new(name).map_err(|bad| ExportError::bad_name(source, field, &bad))
        };
        let parent = name(&edge.parent, "frame_id")?;
        let child = name(&edge.child, "child_frame_id")?;
        let pose = edge.parent_from_child;
        if !pose.translation_m().iter().all(|metres| metres.abs() <= MAX_TRANSLATION_M) {
            let problem = format!("farther than {MAX_TRANSLATION_M} m from {parent}");
            return Err(self.invalid(&child, problem, "Publish metres"));
        }
        let Some((first, before)) = self.edges.get(&child) else {
            self.edges.insert(child, (parent, pose));
            return Ok(());
        };
        if *first != parent {
            let problem = format!("it has two parents, {first} and {parent}");
            return Err(self.invalid(&child, problem, "Leave out one of the two transforms"));
        }
        let (distance_m, angle_rad) = before.distance_to(&pose);
        let same = distance_m <= SAME && angle_rad <= SAME;
        if !same {
            let problem = format!("two transforms to {parent} differ");
            return Err(self.invalid(&child, problem, "Leave out the one that is not in force"));
        }
        Ok(())
    }

    fn invalid(&self, frame: &FrameName, problem: String, remedy: &str) -> ExportError {
        ExportError::invalid(&self.source, format!("frame {frame}"), problem, remedy)
    }

    fn check_cycles(&self) -> Result<(), ExportError> {
        // Each frame is walked once: `checked` are those known to end at a root.
        let mut checked: BTreeSet<&FrameName> = BTreeSet::new();
        for start in self.edges.keys() {
            let mut walked = BTreeSet::new();
            let mut next = Some(start);
            while let Some(frame) = next.filter(|frame| !checked.contains(frame)) {
                if !walked.insert(frame) {
                    let problem = "it is above itself: the transforms form a cycle".to_owned();
                    return Err(self.invalid(frame, problem, "Leave out one of them"));
                }
                next = self.parent(frame);
            }
            checked.extend(walked);
        }
        Ok(())
    }

    /// Where the transforms came from, for messages.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// Whether it has no transforms.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// Parent of `frame`, if it has one here.
    pub fn parent(&self, frame: &FrameName) -> Option<&FrameName> {
        self.edges.get(frame).map(|(parent, _)| parent)
    }

    /// The frame above `frame` that has no parent here; `frame` itself if it has none.
    pub fn root<'t>(&'t self, frame: &'t FrameName) -> &'t FrameName {
        self.above(frame).last().unwrap_or(frame)
    }

    /// `frame` and those above it, up to the root.
    fn above<'t>(&'t self, frame: &'t FrameName) -> impl Iterator<Item = &'t FrameName> {
        // There are no cycles, so this ends.
        std::iter::successors(Some(frame), |frame| self.parent(frame))
    }

    /// The tree without the transform that places the frames of `optical` among those of `base`, and
    /// that transform's parent and child: the child is the root of the camera's frames, below the
    /// last frame that both share. `None` where nothing connects them, or the base hangs on the
    /// camera.
    pub(in crate::export) fn cut_between(
        &self,
        base: &FrameName,
        optical: &FrameName,
    ) -> Option<(Self, FrameName, FrameName)> {
        let of_base: BTreeSet<&FrameName> = self.above(base).collect();
        let child = self.above(optical).take_while(|frame| !of_base.contains(frame)).last()?;
        let parent = self.parent(child)?;
        let mut cut = self.clone();
        cut.edges.remove(child);
        Some((cut, parent.clone(), child.clone()))
    }

    /// All edges: child, parent, `parent_from_child`.
    pub(in crate::export) fn edges(
        &self,
    ) -> impl Iterator<Item = (&FrameName, &FrameName, &Transform<Named, Named>)> {
        self.edges.iter().map(|(child, (parent, pose))| (child, parent, pose))
    }
}
