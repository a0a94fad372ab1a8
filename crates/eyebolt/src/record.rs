//! From a recording and a robot to a session: everything is read and checked here.

mod eye;
mod group;

use crate::session::{Configuration, Session};
use eyebolt_geometry::{Base, DepthImage, EndEffector, PinholeCamera, RayTable, Transform};
use eyebolt_recording::{Folder, Frame, RecordingError};
use eyebolt_registration::{ArmLink, ArmModel, LinkCache, Posture};
use eyebolt_robot::{
    Arm, KinematicsError, Link, LinkPoses, MeshError, Prefer, TriangleMesh, link_fingerprint,
    link_mesh,
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
    /// A mask is not of the size of the images.
    #[error(
        "frame {frame}: frames.mask: {} x {} pixels, but the images are {} x {}; masks and clouds \
         of all frames must have one size", found.0, found.1, size.0, size.1
    )]
    MaskSize {
        /// Name of the frame.
        frame: String,
        /// Width and height of its mask.
        found: (u32, u32),
        /// Width and height of the images.
        size: (u32, u32),
    },
    /// A link is larger than any arm.
    #[error(
        "link {link}: {extent_m:.0} m long; a mesh in millimetres needs scale=\"0.001 0.001 0.001\", \
         and what the arm stands on belongs above its base (--base)"
    )]
    HugeLink {
        /// The link.
        link: String,
        /// Its largest extent.
        extent_m: f32,
    },
    /// More links with shapes than an arm may have.
    #[error("{count} links have a shape, more than 255; name the arm's own base with --base")]
    TooManyLinks {
        /// How many there are.
        count: usize,
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
    let placed = frames.iter().map(|frame| place(arm, frame)).collect::<Result<Vec<_>, _>>()?;
    // A link that some frame does not place takes no part in any.
    let links = (0..arm.robot().links.len()).filter(|link| {
        arm.is_below_base(*link) && placed.iter().all(|p| p.base_from_links[*link].is_some())
    });
    let (links, model) = shapes(arm, links.collect(), cache)?;
    let eye = eye::find(folder, &frames)?;
    check_masks(&frames, &eye.camera)?;
    let rays = RayTable::new(&eye.camera);
    let link_poses = |p: &Placement| links.iter().filter_map(|l| p.base_from_links[*l]).collect();
    let poses: Vec<Vec<_>> = placed.iter().map(link_poses).collect();
    let configurations = group::group(&poses)
        .into_iter()
        .map(|members| {
            let first = members[0];
            let members: Vec<&Frame> = members.iter().map(|index| &frames[*index]).collect();
            let masks: Vec<_> = members.iter().map(|frame| frame.mask.clone()).collect();
            Configuration {
                frames: members.iter().map(|frame| frame.name.clone()).collect(),
                depth: depth(&members, &eye, &rays),
                mask: group::common_mask(&masks),
                base_from_end_effector: placed[first].base_from_end_effector,
                posture: Posture::new(&model, poses[first].clone()),
            }
        })
        .collect();
    let eye::Eye { camera, optical_from_camera, source } = eye;
    let assumed_joints = placed.first().map(|p| p.assumed_joints.clone()).unwrap_or_default();
    Ok(Session {
        camera,
        rays,
        optical_from_camera,
        source,
        arm: model,
        configurations,
        assumed_joints,
    })
}

/// Median of what frames of one configuration saw, along rays that the lens has.
fn depth(frames: &[&Frame], eye: &eye::Eye, rays: &RayTable) -> DepthImage {
    let images: Vec<_> = frames.iter().map(|frame| eye.depth_image(&frame.range)).collect();
    let image = group::median_depth(&images).expect("a configuration has a frame");
    let (width, height) = (image.width(), image.height());
    let known = |(z, [x, y]): (&f32, &[f32; 2])| if (x + y).is_nan() { 0.0 } else { *z };
    let depth_m = image.depth_m().iter().zip(rays.rays()).map(known).collect();
    DepthImage::new(width, height, depth_m).expect("as many pixels as before")
}

/// Where the joints of one frame put the links.
struct Placement {
    base_from_links: LinkPoses,
    base_from_end_effector: Transform<Base, EndEffector>,
    assumed_joints: Vec<String>,
}

fn place(arm: &Arm, frame: &Frame) -> Result<Placement, RecordError> {
    let failed = |source| RecordError::Kinematics { frame: frame.name.clone(), source };
    let poses = arm.link_poses_with_defaults(&frame.joints).map_err(failed)?;
    Ok(Placement {
        base_from_links: poses.base_from_links,
        base_from_end_effector: arm.base_from_end_effector(&frame.joints).map_err(failed)?,
        assumed_joints: poses.defaulted_joints,
    })
}

/// Masks belong to the pixels of the camera's images, also where clouds of another size are drawn
/// as images.
fn check_masks(frames: &[Frame], camera: &PinholeCamera) -> Result<(), RecordError> {
    let size = (camera.width(), camera.height());
    for frame in frames {
        let mask = frame.mask.as_ref().map(|mask| (mask.width(), mask.height()));
        if let Some(found) = mask.filter(|mask| *mask != size) {
            return Err(RecordError::MaskSize { frame: frame.name.clone(), found, size });
        }
    }
    Ok(())
}

fn read_frames(folder: &Folder, use_masks: bool) -> Result<Vec<Frame>, RecordingError> {
    let count = folder.frame_names().len();
    let read = |index: usize| {
        let mut frame = folder.read_frame(index)?;
        frame.mask = frame.mask.filter(|_| use_masks);
        Ok(frame)
    };
    // Collected first: of several errors the first is reported, whichever thread met it.
    let frames: Vec<_> = (0..count).into_par_iter().map(read).collect();
    frames.into_iter().collect()
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
            let mesh = || plausible_mesh(link, prefer);
            let model = cache.load_or_build(&print.to_string(), mesh)?;
            Ok(Some((index, ArmLink { name: link.name.clone(), model: Arc::new(model) })))
        })
        .collect::<Vec<Result<_, RecordError>>>()
        .into_iter()
        .filter_map(Result::transpose)
        .collect::<Result<_, _>>()?;
    if links.len() > MOST_LINKS {
        return Err(RecordError::TooManyLinks { count: links.len() });
    }
    if links.is_empty() {
        let (robot, base) = (robot.name.clone(), arm.base_name().to_owned());
        return Err(RecordError::NoShapes { robot, base });
    }
    let (indices, links) = links.into_iter().unzip();
    Ok((indices, ArmModel::new(links)))
}

/// Links with shapes that one arm may have.
const MOST_LINKS: usize = 255;
/// No link of an arm is larger than this, metres.
const LARGEST_LINK_M: f32 = 5.0;

fn plausible_mesh(link: &Link, prefer: Prefer) -> Result<TriangleMesh, RecordError> {
    let name = || link.name.clone();
    let failed = |source| RecordError::Mesh { link: name(), source };
    let mesh = link_mesh(link, prefer).map_err(failed)?.unwrap_or_default();
    let extent_m = mesh.bounds().map_or(0.0, |(low, high)| (high - low).amax());
    if extent_m > LARGEST_LINK_M {
        return Err(RecordError::HugeLink { link: name(), extent_m });
    }
    Ok(mesh)
}
