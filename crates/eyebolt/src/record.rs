//! From a recording and a robot to a session: everything is read and checked here.

mod background;
mod eye;
mod group;
mod joints;
mod limits;
mod spread;

pub use limits::OutsideLimits;
pub(crate) use limits::WorstOutside;
pub(crate) use spread::most_spread;

use crate::session::{Configuration, Session};
use eyebolt_geometry::{Base, DepthImage, EndEffector, Mask, PinholeCamera, RayTable, Transform};
use eyebolt_recording::{Frame, Recording, RecordingError};
use eyebolt_registration::{ArmLink, ArmModel, LinkCache, Posture};
use eyebolt_robot::{
    Arm, JointPositions, KinematicsError, Link, LinkPoses, MeshError, Prefer, TriangleMesh,
    link_fingerprint, link_mesh,
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
    /// Hardly two frames have the arm in one place.
    #[error(
        "the arm is in more than {MOST_GROUPS} places: it never rests. Let it rest in each of some \
         configurations; with a bag, give a smaller --max-motion-deg"
    )]
    NeverAtRest,
    /// Clouds without a camera that do not tell their own.
    #[error(
        "frame {frame}: {problem}; add [camera] info = \"...\" to recording.toml, or give \
         --camera-info with a bag"
    )]
    Projection {
        /// Name of the frame.
        frame: String,
        /// What is wrong.
        problem: String,
    },
}

/// Poses `arm` in every frame of `recording`, gets the shapes of its links from `cache` or their
/// meshes, and reads the frames of each configuration.
///
/// Depth is read of no more frames than tell something new, one configuration after the other, so
/// that memory does not grow with the length of the recording.
///
/// # Errors
///
/// The first thing that cannot be read or does not fit, in the order of the frames.
pub fn open(
    recording: &Recording,
    arm: &Arm,
    cache: &LinkCache,
    options: &RecordOptions,
) -> Result<Session, RecordError> {
    let mut outside = WorstOutside::default();
    let groups = group_frames(recording, arm, |frame, joints| outside.add(arm, frame, joints))?;
    // A link that some frame does not place takes no part in any.
    let placed = |link: &usize| groups.iter().all(|g| g.first.base_from_links[*link].is_some());
    let links = (0..arm.robot().links.len()).filter(|link| arm.is_below_base(*link));
    let (links, model) = shapes(arm, links.filter(placed).collect(), cache)?;
    let postures: Vec<Vec<_>> = groups
        .iter()
        .map(|group| links.iter().filter_map(|l| group.first.base_from_links[*l]).collect())
        .collect();
    let (joints, model) = joints::offered(arm, &links, model);
    let chosen = most_spread(&postures, options.most_configurations);
    let eye = eye::find(recording, &first_frame(recording, &groups[chosen[0]].frames)?)?;
    let reader = Reader { recording, eye: &eye, rays: RayTable::new(&eye.camera), options };
    let configurations = chosen.par_iter().map(|group| {
        let read = reader.configuration(&groups[*group].frames)?;
        Ok(Configuration {
            frames: groups[*group]
                .frames
                .iter()
                .map(|f| recording.frame_names()[*f].clone())
                .collect(),
            depth: read.depth,
            mask: read.mask,
            base_from_end_effector: groups[*group].first.base_from_end_effector,
            posture: Posture::new(&model, postures[*group].clone()).with_axes(joints::axes(
                arm,
                &joints,
                &groups[*group].first.base_from_links,
            )),
        })
    });
    // Collected first: of several errors the first is reported, whichever thread met it.
    let configurations: Vec<Result<_, RecordError>> = configurations.collect();
    let configurations = configurations.into_iter().collect::<Result<Vec<_>, _>>()?;
    let background = background::read(recording, &eye, &configurations)?;
    let rays = reader.rays;
    let eye::Eye { camera, optical_from_camera, source } = eye;
    let mut outside_limits = outside.into_vec();
    let of_the_arm = [arm.required_joints(), arm.other_joints()].concat();
    outside_limits.retain(|outside| of_the_arm.contains(&outside.joint.as_str()));
    let assumed_joints = groups.first().map(|g| g.first.assumed_joints.clone()).unwrap_or_default();
    Ok(Session {
        camera,
        rays,
        optical_from_camera,
        source,
        arm: model,
        configurations,
        background,
        assumed_joints,
        outside_limits,
        spare_configurations: groups.len() - chosen.len(),
    })
}

/// What to read of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordOptions {
    /// Whether to use the masks of the recording.
    pub use_masks: bool,
    /// Of more configurations, those are used that differ most: time grows with the square of
    /// their number, and accuracy hardly grows any more.
    pub most_configurations: usize,
}

impl Default for RecordOptions {
    fn default() -> Self {
        Self { use_masks: true, most_configurations: 30 }
    }
}

/// Frames with the arm in one place.
pub(crate) struct Group {
    /// Indices, rising.
    pub(crate) frames: Vec<usize>,
    /// Where the joints of the first frame put the links.
    first: Placement,
}

/// Frames of each configuration, in order of appearance; `each` gets every frame's name and joints.
pub(crate) fn group_frames(
    recording: &Recording,
    arm: &Arm,
    mut each: impl FnMut(&str, &JointPositions),
) -> Result<Vec<Group>, RecordError> {
    let mut groups: Vec<Group> = Vec::new();
    for (index, name) in recording.frame_names().iter().enumerate() {
        let joints = recording.read_joints(index)?;
        each(name, &joints);
        let placement = place(arm, name, &joints)?;
        let same = |group: &Group| {
            group::same_place(&group.first.base_from_links, &placement.base_from_links)
        };
        // From the last one, which it mostly is.
        match groups.iter().rposition(same) {
            Some(known) => groups[known].frames.push(index),
            None if groups.len() < MOST_GROUPS => {
                groups.push(Group { frames: vec![index], first: placement });
            }
            None => return Err(RecordError::NeverAtRest),
        }
    }
    Ok(groups)
}

/// Configurations that are told apart.
const MOST_GROUPS: usize = 2000;
/// Pixels of the images that one configuration is made from: enough frames for a median, few
/// enough for memory.
const MOST_PIXELS: usize = 12_000_000;
const FEWEST_FRAMES: usize = 5;
const MOST_FRAMES: usize = 30;

/// The first of `frames` that can be read.
fn first_frame(recording: &Recording, frames: &[usize]) -> Result<Frame, RecordError> {
    let mut left_out = None;
    for index in frames {
        match recording.read_frame(*index) {
            Err(error) if recording.may_leave_out(&error) => left_out = Some(error),
            read => return Ok(read?),
        }
    }
    // A group has a frame, so that one was left out.
    Err(left_out.expect("a configuration has a frame").into())
}

/// Reads the frames of configurations.
struct Reader<'a> {
    recording: &'a Recording,
    eye: &'a eye::Eye,
    rays: RayTable,
    options: &'a RecordOptions,
}

/// What the frames of a configuration saw.
struct Seen {
    depth: DepthImage,
    mask: Option<Mask>,
}

impl Reader<'_> {
    fn configuration(&self, frames: &[usize]) -> Result<Seen, RecordError> {
        let camera = &self.eye.camera;
        let most = (MOST_PIXELS / camera.pixel_count().max(1)).clamp(FEWEST_FRAMES, MOST_FRAMES);
        let (mut images, mut masks, mut left_out) = (Vec::new(), Vec::new(), None);
        for index in evenly(frames, most) {
            let frame = match self.recording.read_frame(index) {
                Err(error) if self.recording.may_leave_out(&error) => {
                    left_out.get_or_insert(error);
                    continue;
                }
                read => read?,
            };
            let mask = frame.mask.filter(|_| self.options.use_masks);
            check_mask(&frame.name, mask.as_ref(), camera)?;
            images.push(self.eye.depth_image(&frame.range));
            masks.push(mask);
        }
        if let Some(error) = left_out.filter(|_| images.is_empty()) {
            return Err(error.into());
        }
        let image = group::median_depth(&images).expect("a configuration has a frame");
        Ok(Seen { depth: self.along_rays(image), mask: group::common_mask(&masks) })
    }

    /// `image` where the lens has rays.
    fn along_rays(&self, image: DepthImage) -> DepthImage {
        let (width, height) = (image.width(), image.height());
        let known = |(z, [x, y]): (f32, &[f32; 2])| if (x + y).is_nan() { 0.0 } else { z };
        let depth_m = image.into_depth_m().into_iter().zip(self.rays.rays()).map(known).collect();
        DepthImage::new(width, height, depth_m).expect("as many pixels as before")
    }
}

/// At most `most` of `indices`, from the first to the last.
fn evenly(indices: &[usize], most: usize) -> impl Iterator<Item = usize> {
    let count = indices.len().min(most);
    (0..count).map(move |i| indices[i * (indices.len() - 1) / (count - 1).max(1)])
}

/// Where the joints of one frame put the links.
struct Placement {
    base_from_links: LinkPoses,
    base_from_end_effector: Transform<Base, EndEffector>,
    assumed_joints: Vec<String>,
}

fn place(arm: &Arm, frame: &str, joints: &JointPositions) -> Result<Placement, RecordError> {
    let failed = |source| RecordError::Kinematics { frame: frame.to_owned(), source };
    let poses = arm.link_poses_with_defaults(joints).map_err(failed)?;
    Ok(Placement {
        base_from_links: poses.base_from_links,
        base_from_end_effector: arm.base_from_end_effector(joints).map_err(failed)?,
        assumed_joints: poses.defaulted_joints,
    })
}

/// A mask belongs to the pixels of the camera's images, also where clouds of another size are drawn
/// as images.
fn check_mask(frame: &str, mask: Option<&Mask>, camera: &PinholeCamera) -> Result<(), RecordError> {
    let size = (camera.width(), camera.height());
    let found = mask.map(|mask| (mask.width(), mask.height()));
    match found.filter(|mask| *mask != size) {
        Some(found) => Err(RecordError::MaskSize { frame: frame.to_owned(), found, size }),
        None => Ok(()),
    }
}

/// Shapes of those of `links` that have one, and which these are.
pub(crate) fn shapes(
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
