//! Frames with the arm in one place: configurations.

use super::error::RecordError;
use super::options::MOST_CONFIGURATIONS;
use super::places::same_place;
use eyebolt_geometry::{Base, EndEffector, Transform};
use eyebolt_recording::FrameSource;
use eyebolt_robot::{Arm, JointPositions, KinematicsError, LinkPoses};

/// The configurations of a recording.
pub(crate) struct Groups {
    /// In order of appearance; at least one of a recording with frames.
    pub(crate) groups: Vec<Group>,
    /// How many frames are left out, since a joint of the arm was not told then.
    pub(crate) untold_frames: usize,
}

/// Frames with the arm in one place.
pub(crate) struct Group {
    /// Indices, rising.
    pub(crate) frames: Vec<usize>,
    /// Where the joints of the first frame put the links.
    pub(crate) first: Placement,
}

/// Frames of each configuration, in order of appearance; `each` gets every frame's name and joints.
///
/// Where the recording names a joint of the arm without saying where it is, the frame is left out;
/// that other frames lack it as well is an error if none is left.
pub(crate) fn group_frames(
    source: &dyn FrameSource,
    arm: &Arm,
    mut each: impl FnMut(&str, &JointPositions),
) -> Result<Groups, RecordError> {
    let mut groups: Vec<Group> = Vec::new();
    let (mut untold_frames, mut first_untold) = (0, None);
    for (index, name) in source.frame_names().iter().enumerate() {
        let joints = source.read_joints(index)?;
        each(name, &joints);
        let placement = match place(arm, &joints) {
            Err(error) => match untold(source, name, error) {
                error @ RecordError::JointsNotTold { .. } => {
                    untold_frames += 1;
                    first_untold.get_or_insert(error);
                    continue;
                }
                error => return Err(error),
            },
            Ok(placement) => placement,
        };
        let same =
            |group: &Group| same_place(&group.first.base_from_links, &placement.base_from_links);
        // From the last one, which it mostly is.
        match groups.iter().rposition(same) {
            Some(known) => groups[known].frames.push(index),
            None if groups.len() < MOST_CONFIGURATIONS => {
                groups.push(Group { frames: vec![index], first: placement });
            }
            None => return Err(RecordError::NeverAtRest),
        }
    }
    match first_untold.filter(|_| groups.is_empty()) {
        Some(error) => Err(error),
        None => Ok(Groups { groups, untold_frames }),
    }
}

/// What it means that the joints of `frame` place no links, by what `source` knows of its joints.
fn untold(source: &dyn FrameSource, frame: &str, error: KinematicsError) -> RecordError {
    let frame = frame.to_owned();
    let known = &source.provenance().untold_joints;
    if let KinematicsError::MissingArmJoints { missing, .. } = &error {
        let reasons: Option<Vec<_>> = missing.iter().map(|joint| known.get(joint)).collect();
        if let Some(reasons) = reasons {
            let reasons: Vec<_> = reasons.into_iter().map(String::as_str).collect();
            return RecordError::JointsNotTold { frame, reasons: reasons.join("; ") };
        }
    }
    RecordError::Kinematics { frame, source: error }
}

/// Where the joints of one frame put the links.
pub(crate) struct Placement {
    pub(crate) base_from_links: LinkPoses,
    pub(crate) base_from_end_effector: Transform<Base, EndEffector>,
    pub(crate) unplaced_joints: Vec<String>,
    pub(crate) joints: JointPositions,
}

fn place(arm: &Arm, joints: &JointPositions) -> Result<Placement, KinematicsError> {
    let poses = arm.known_link_poses(joints)?;
    Ok(Placement {
        base_from_links: poses.base_from_links,
        base_from_end_effector: arm.base_from_end_effector(joints)?,
        unplaced_joints: poses.unplaced_joints,
        joints: joints.clone(),
    })
}
