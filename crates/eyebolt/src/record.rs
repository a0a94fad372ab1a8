//! From a recording and a robot to a session: everything is read and checked here.

mod group;

use crate::session::{Configuration, Session};
use eyebolt_geometry::{
    Camera, Cloud, DepthImage, PinholeCamera, RayTable, Transform, fit_projection,
};
use eyebolt_recording::{Folder, Frame, Range, RecordingError};
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
    let (camera, optical_from_camera) = camera_of(folder, &frames)?;
    let rays = RayTable::new(&camera);
    let joints: Vec<_> = frames.iter().map(|frame| &frame.joints).collect();
    let configurations = group::group(&joints)
        .into_iter()
        .map(|members| {
            let poses = &poses[members[0]];
            let members: Vec<&Frame> = members.iter().map(|index| &frames[*index]).collect();
            let base_from_link = links.iter().filter_map(|link| poses[*link]).collect();
            let posture = Posture::new(&model, base_from_link);
            merged(&members, posture, &camera, &optical_from_camera)
        })
        .collect();
    Ok(Session { camera, rays, optical_from_camera, arm: model, configurations })
}

/// One configuration of frames with the same joints.
fn merged(
    frames: &[&Frame],
    posture: Posture,
    camera: &PinholeCamera,
    optical_from_camera: &Transform<Camera, Camera>,
) -> Configuration {
    let depth = |frame: &&Frame| depth_image(&frame.range, camera, optical_from_camera);
    let images: Vec<DepthImage> = frames.iter().map(depth).collect();
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
    let links: Vec<(usize, ArmLink)> = links
        .into_par_iter()
        .map(|index| {
            let link = &robot.links[index];
            let failed = |source| RecordError::Mesh { link: link.name.clone(), source };
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

/// The camera of the depth images to be, and how to turn its frame to the optical one.
///
/// Depth images have theirs. Clouds without one either tell it by their grid, or get one that
/// looks at their middle.
fn camera_of(
    folder: &Folder,
    frames: &[Frame],
) -> Result<(PinholeCamera, Transform<Camera, Camera>), RecordError> {
    if let Some(camera) = folder.camera() {
        return Ok((camera.clone(), Transform::identity()));
    }
    let Some((frame, cloud)) = frames.iter().find_map(|frame| match &frame.range {
        Range::Cloud(cloud) => Some((frame, cloud)),
        Range::Depth(_) => None,
    }) else {
        let problem = "depth images without a camera".to_owned();
        let frame = frames.first().map(|f| f.name.clone()).unwrap_or_default();
        return Err(RecordError::Projection { frame, problem });
    };
    let fit = fit_projection(cloud).map_err(|problem| RecordError::Projection {
        frame: frame.name.clone(),
        problem: problem.to_string(),
    })?;
    let turn = fit.camera_from_cloud.inverse();
    Ok((fit.camera, Transform::from_parts(nalgebra::Vector3::zeros(), turn)))
}

fn depth_image(
    range: &Range,
    camera: &PinholeCamera,
    optical_from_camera: &Transform<Camera, Camera>,
) -> DepthImage {
    match range {
        Range::Depth(image) => image.clone(),
        Range::Cloud(cloud) => grid_depth(cloud, camera, optical_from_camera),
    }
}

/// Depth of an organised cloud along the camera's axis, pixel by pixel; other clouds are projected.
fn grid_depth(
    cloud: &Cloud,
    camera: &PinholeCamera,
    optical_from_camera: &Transform<Camera, Camera>,
) -> DepthImage {
    let turned = cloud.rotated(&optical_from_camera.rotation().inverse());
    if turned.grid() != Some((camera.width(), camera.height())) {
        return turned.to_depth_image(camera);
    }
    let depth = turned.points().iter().map(|p| p.z).collect();
    DepthImage::new(camera.width(), camera.height(), depth)
        .expect("the cloud has the camera's size")
}
