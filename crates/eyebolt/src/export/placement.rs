//! The pose of one frame in another, from a calibration and static transforms.

use super::error::ExportError;
use super::frame_name::{FrameName, Named, listed};
use super::graph::{Graph, chain};
use super::note::Note;
use super::saved::SavedCalibration;
use super::static_tree::StaticTree;
use eyebolt_geometry::Transform;

/// What to export, as a person asks for it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// The parent; otherwise the calibration's base.
    pub parent: Option<&'a str>,
    /// The child; otherwise the depth optical frame, or the root of the camera's static transforms
    /// where these already give that frame a parent.
    pub child: Option<&'a str>,
    /// Name of the depth optical frame; otherwise the one that the calibration tells.
    pub optical: Option<&'a str>,
    /// Export a pose that was refused.
    pub even_if_refused: bool,
}

/// The pose of `child` in `parent`.
#[derive(Clone, Debug)]
pub struct Placement {
    /// The parent; tf's `frame_id`.
    pub parent: FrameName,
    /// The child; tf's `child_frame_id`.
    pub child: FrameName,
    /// Maps coordinates in `child` to coordinates in `parent`.
    pub parent_from_child: Transform<Named, Named>,
    /// The calibration's end-effector link.
    pub end_effector: FrameName,
    /// Whether `child` is the depth optical frame: x right, y down, z forward.
    pub child_is_optical: bool,
    /// What a person should know before using it.
    pub notes: Vec<Note>,
}

impl Placement {
    /// The pose that is `wanted`, over the calibration and the transforms that its recording told.
    ///
    /// Where these place the camera already, as an earlier calibration does, the transform that does
    /// so is the one that is exported anew: no frame gets a second parent.
    ///
    /// # Errors
    /// As of [`Placement::find`].
    pub fn of_recording(
        calibration: &SavedCalibration,
        wanted: &Wanted<'_>,
    ) -> Result<Self, ExportError> {
        let tree = calibration.tree();
        let optical = optical_frame(calibration, tree, wanted)?;
        let Some((tree, parent, child)) = tree.cut_between(&calibration.base_frame, &optical)
        else {
            let mut placement = Self::find(calibration, tree, wanted)?;
            placement.notes.extend(
                calibration
                    .tree_problem()
                    .map(|problem| Note::NoTree { problem: problem.to_owned() }),
            );
            if tree.is_empty() && placement.child_is_optical && wanted.child.is_none() {
                placement.notes.push(Note::TreeUnknown { optical });
            }
            return Ok(placement);
        };
        let by_default = wanted.parent.is_none() && wanted.child.is_none();
        let parent_name = if by_default { Some(parent.as_str()) } else { wanted.parent };
        let mut placement =
            Self::find(calibration, &tree, &Wanted { parent: parent_name, ..*wanted })?;
        placement.notes.retain(|note| !matches!(note, Note::ChildIsRoot { .. }));
        placement.notes.push(Note::Replaces { parent, child });
        Ok(placement)
    }

    /// The pose that is `wanted`, over the calibration and the transforms of `tree`.
    ///
    /// # Errors
    /// A calibration that was refused or has no pose; a frame that has no name, is nowhere, or is not
    /// connected to the other; a `tree` that connects base and camera by itself.
    pub fn find(
        calibration: &SavedCalibration,
        tree: &StaticTree,
        wanted: &Wanted<'_>,
    ) -> Result<Self, ExportError> {
        let base_from_camera = calibration.base_from_camera(wanted.even_if_refused)?;
        let base = &calibration.base_frame;
        let optical = &optical_frame(calibration, tree, wanted)?;
        let mut graph = Graph::of(tree);
        check_apart(&graph, tree, base, optical)?;
        let mut notes: Vec<Note> = calibration
            .refused()
            .map(|reasons| Note::Refused { reasons: reasons.join("; ") })
            .into_iter()
            .collect();
        let tree_is_apart = !graph.contains(base) && !graph.contains(optical);
        if tree_is_apart && let Some(note) = apart_note(&graph, tree, base, optical) {
            notes.push(note);
        }
        graph.connect(base, optical, Transform::from_isometry(*base_from_camera.isometry()));

        let parent = wanted.parent.map_or(Ok(base.clone()), FrameName::new)?;
        let child = match wanted.child {
            Some(child) => FrameName::new(child)?,
            None => tree.root(optical).clone(),
        };
        notes.extend(parent_note(tree, &child, optical, wanted.child.is_none()));
        Ok(Self {
            parent_from_child: pose(&graph, tree, &parent, &child)?,
            end_effector: calibration.end_effector_frame.clone(),
            child_is_optical: child == *optical,
            parent,
            child,
            notes,
        })
    }
}

fn optical_frame(
    calibration: &SavedCalibration,
    tree: &StaticTree,
    wanted: &Wanted<'_>,
) -> Result<FrameName, ExportError> {
    // Without other transforms there is no other frame of the camera that the child could be.
    let only = wanted.child.filter(|_| tree.is_empty());
    match (wanted.optical, &calibration.camera_frame, only) {
        (Some(name), ..) | (None, None, Some(name)) => Ok(FrameName::new(name)?),
        (None, Some(name), _) => Ok(name.clone()),
        (None, None, None) => {
            Err(ExportError::UnnamedCamera { file: calibration.file().to_owned() })
        }
    }
}

/// An error if `tree` says where the camera is: which of the two answers would hold?
fn check_apart<'f>(
    graph: &Graph<'f>,
    tree: &StaticTree,
    base: &'f FrameName,
    optical: &'f FrameName,
) -> Result<(), ExportError> {
    if base == optical {
        return Err(ExportError::SameFrame { frame: base.clone() });
    }
    let reached = graph.reach(base);
    if !reached.contains_key(optical) {
        return Ok(());
    }
    let names: Vec<_> = chain(&reached, optical).into_iter().map(FrameName::as_str).collect();
    Err(ExportError::AlreadyConnected {
        tree: tree.source().to_owned(),
        base: base.clone(),
        camera: optical.clone(),
        chain: names.join(" - "),
    })
}

fn apart_note(
    graph: &Graph<'_>,
    tree: &StaticTree,
    base: &FrameName,
    optical: &FrameName,
) -> Option<Note> {
    (!tree.is_empty()).then(|| Note::TreeApart {
        tree: tree.source().to_owned(),
        base: base.clone(),
        optical: optical.clone(),
        known: listed(graph.frames()),
    })
}

fn parent_note(
    tree: &StaticTree,
    child: &FrameName,
    optical: &FrameName,
    by_default: bool,
) -> Option<Note> {
    if let Some(parent) = tree.parent(child) {
        return Some(Note::SecondParent { child: child.clone(), parent: parent.clone() });
    }
    let parent = tree.parent(optical).filter(|_| by_default)?;
    Some(Note::ChildIsRoot {
        optical: optical.clone(),
        parent: parent.clone(),
        root: child.clone(),
    })
}

fn pose(
    graph: &Graph<'_>,
    tree: &StaticTree,
    parent: &FrameName,
    child: &FrameName,
) -> Result<Transform<Named, Named>, ExportError> {
    for wanted in [parent, child] {
        if !graph.contains(wanted) {
            let known = listed(graph.frames());
            return Err(ExportError::UnknownFrame { wanted: wanted.clone(), known });
        }
    }
    if parent == child {
        return Err(ExportError::SameFrame { frame: parent.clone() });
    }
    let reached = graph.reach(parent);
    if let Some(found) = reached.get(child) {
        return Ok(found.start_from_frame);
    }
    let apart = graph.frames().filter(|frame| !reached.contains_key(frame));
    let moving = if tree.moves { " (joints that move do not count)" } else { "" };
    Err(ExportError::Unconnected {
        parent: parent.clone(),
        child: child.clone(),
        reached: listed(reached.keys().copied().filter(|frame| *frame != parent)),
        apart: format!("{}{moving}", listed(apart)),
    })
}
