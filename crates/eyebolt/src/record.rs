//! From a recording and a robot to a session: everything is read and checked here.

mod eye;
mod group;

use crate::session::{Configuration, Session};
use eyebolt_geometry::RayTable;
use eyebolt_recording::{Folder, Frame, RecordingError};
use eyebolt_registration::{ArmLink, ArmModel, LinkCache, Posture};
use eyebolt_robot::{
    Arm, KinematicsError, LinkPoses, MeshError, Prefer, link_fingerprint, link_mesh,
};
use rayon::prelude::*;
use std::sync::Arc;

/// Why a recording and a robot do not make a session.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The recording cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A link's shape cannot be read.
    #[error("link {link}: {source}")]
    Mesh {
        /// The link.
        link: String,
        /// What is wrong with it.
        source: MeshError,
    },
    /// The recording's joints are not the robot's.
    #[error("frame {frame}: {source}")]
    Kinematics {
        /// Name of the frame.
        frame: String,
        /// What does not fit.
        source: KinematicsError,
    },
    /// No link below the base has a shape.
    #[error(
        "robot {robot}: no link below {base} has a visual or collision shape, so there is nothing \
         to find in the images; give a URDF with meshes"
    )]
    NoShapes {
        /// The robot's name.
        robot: String,
        /// The base link.
        base: String,
    },
    /// Clouds without a camera that do not tell their own.
    #[error("frame {frame}: {problem}; add [camera] info = \"...\" to recording.toml")]
    Projection {
        /// Name of the frame.
        frame: String,
        /// What is wrong.
        problem: String,
    },
}

/// Reads all frames of `folder`, poses `arm` in each, and gets the shapes of its links from
/// `cache` or their meshes.
///
/// # Errors
///
/// The first thing that cannot be read or does not fit, in the order of the frames.
pub fn open(
    folder: &Folder,
    arm: &Arm,
    cache: &LinkCache,
    use_masks: bool,
) -> Result<Session, RecordError> {
    let frames = read_frames(folder, use_masks)?;
    let poses = frames.iter().map(|frame| link_poses(arm, frame)).collect::<Result<Vec<_>, _>>()?;
    // A link that some frame does not place takes no part in any.
    let placed =
        |link: &usize| poses.iter().all(|poses| poses.get(*link).is_some_and(Option::is_some));
    let links = (0..arm.robot().links.len()).filter(placed).collect();
    let (links, model) = shapes(arm, links, cache)?;
    let eye = eye::find(folder, &frames)?;
    let joints: Vec<_> = frames.iter().map(|frame| &frame.joints).collect();
    let configurations = group::group(&joints)
        .into_iter()
        .map(|members| {
            let poses = &poses[members[0]];
            let members: Vec<&Frame> = members.iter().map(|index| &frames[*index]).collect();
            let base_from_link = links.iter().filter_map(|link| poses[*link]).collect();
            let posture = Posture::new(&model, base_from_link);
            merged(&members, posture, &eye)
        })
        .collect();
    let rays = RayTable::new(&eye.camera);
    let eye::Eye { camera, optical_from_camera, source } = eye;
    Ok(Session { camera, rays, optical_from_camera, source, arm: model, configurations })
}

/// One configuration of frames with the same joints.
fn merged(frames: &[&Frame], posture: Posture, eye: &eye::Eye) -> Configuration {
    let images: Vec<_> = frames.iter().map(|frame| eye.depth_image(&frame.range)).collect();
    let masks: Vec<_> = frames.iter().map(|frame| frame.mask.clone()).collect();
    Configuration {
        frames: frames.iter().map(|frame| frame.name.clone()).collect(),
        depth: group::median_depth(&images).expect("a configuration has a frame"),
        mask: group::common_mask(&masks),
        joints: frames[0].joints.clone(),
        posture,
    }
}

fn link_poses(arm: &Arm, frame: &Frame) -> Result<LinkPoses, RecordError> {
    let failed = |source| RecordError::Kinematics { frame: frame.name.clone(), source };
    Ok(arm.link_poses_with_defaults(&frame.joints).map_err(failed)?.base_from_links)
}

fn read_frames(folder: &Folder, use_masks: bool) -> Result<Vec<Frame>, RecordingError> {
    let count = folder.frame_names().len();
    let read = |index: usize| {
        let mut frame = folder.read_frame(index)?;
        frame.mask = frame.mask.filter(|_| use_masks);
        Ok(frame)
    };
    (0..count).into_par_iter().map(read).collect()
}

/// Shapes of those of `links` that have one, and which these are.
fn shapes(
    arm: &Arm,
    links: Vec<usize>,
    cache: &LinkCache,
) -> Result<(Vec<usize>, ArmModel), RecordError> {
    let robot = arm.robot();
    // Links without a visual stand for clearance (the Panda's `_sc`), not for anything to be seen,
    // unless the whole robot is described so.
    let visible = robot.links.iter().any(|link| !link.visuals.is_empty());
    let links: Vec<(usize, ArmLink)> = links
        .into_par_iter()
        .map(|index| {
            let link = &robot.links[index];
            let failed = |source| RecordError::Mesh { link: link.name.clone(), source };
            if visible && link.visuals.is_empty() {
                return Ok(None);
            }
            let prefer = Prefer::Visual;
            let Some(print) = link_fingerprint(link, prefer).map_err(failed)? else {
                return Ok(None);
            };
            let mesh = || Ok(link_mesh(link, prefer)?.unwrap_or_default());
            let model = cache.load_or_build(&print.to_string(), mesh).map_err(failed)?;
            Ok(Some((index, ArmLink { name: link.name.clone(), model: Arc::new(model) })))
        })
        .collect::<Result<Vec<_>, RecordError>>()?
        .into_iter()
        .flatten()
        .collect();
    if links.is_empty() {
        let (robot, base) = (robot.name.clone(), arm.base_name().to_owned());
        return Err(RecordError::NoShapes { robot, base });
    }
    let (indices, links) = links.into_iter().unzip();
    Ok((indices, ArmModel::new(links)))
}
