//! The kinematic tree of a robot.

use crate::error::RobotError;
use crate::flaw::{Flaw, Of};
use eyebolt_geometry::{Transform, frame};
use nalgebra::{Translation3, Unit, UnitQuaternion, Vector3};
use std::path::PathBuf;

/// Links and joints of a robot, as its URDF describes them. Holds no meshes, only where they are.
#[derive(Clone, Debug)]
pub struct Robot {
    /// Name given in the URDF, empty where it gives none.
    pub name: String,
    /// All links; the root is first and every link comes after its parent.
    pub links: Vec<Link>,
    /// All joints, in the order of their child links.
    pub joints: Vec<Joint>,
    /// Where the description came from, for messages.
    pub(crate) source: String,
    pub(crate) urdf_hash: String,
    /// Parts that cannot be used as they stand.
    pub(crate) flaws: Vec<Flaw>,
}

/// A rigid part of the robot.
#[derive(Clone, Debug)]
pub struct Link {
    /// Unique name.
    pub name: String,
    /// Index of the parent link in [`Robot::links`] and of the joint between the two in
    /// [`Robot::joints`]; `None` for the root.
    pub parent: Option<(usize, usize)>,
    /// What the link looks like.
    pub visuals: Vec<Body>,
    /// What the link may bump into things with: coarser, sometimes padded.
    pub collisions: Vec<Body>,
}

/// A shape fixed to a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Pose of the shape in the link's frame.
    pub link_from_body: Transform<frame::Link, frame::Link>,
    /// The shape, in its own frame.
    pub shape: Shape,
}

/// A shape in its own frame, metres. Round shapes run along z; all but meshes are centred.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A mesh file, every coordinate times `scale`. Nothing of it has been read yet.
    Mesh {
        /// The file, found by the rules of [`crate::PackageRoots`].
        path: PathBuf,
        /// Factors along x, y and z, never zero; negative ones mirror.
        scale: [f64; 3],
    },
    /// A box.
    Box {
        /// Full extents along x, y and z.
        size: [f64; 3],
    },
    /// A cylinder.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Full length along z.
        length: f64,
    },
    /// A cylinder with half-spheres as ends.
    Capsule {
        /// Radius of the cylinder and of its ends.
        radius: f64,
        /// Length of the cylinder along z, without its ends.
        length: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius.
        radius: f64,
    },
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Not at all.
    Fixed,
    /// Turns about its axis within limits, radians.
    Revolute,
    /// Turns about its axis without limits, radians.
    Continuous,
    /// Slides along its axis, metres.
    Prismatic,
    /// In a way that no one number tells (planar, floating), or that the description gets wrong:
    /// where its links are is not known.
    Undetermined,
}

/// The connection of a link to its parent.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Unique name.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Index of the parent link.
    pub parent: usize,
    /// Index of the child link.
    pub child: usize,
    /// Pose of the child link in the parent link at position 0.
    pub parent_from_child_at_zero: Transform<frame::Link, frame::Link>,
    /// Axis in the child's frame.
    pub axis: Unit<Vector3<f64>>,
    /// Limits of the position; `None` where the URDF gives none or the joint is continuous.
    pub limits: Option<JointLimits>,
    /// How fast it may move, radians or metres a second; `None` where the URDF gives no speed above zero.
    pub most_per_s: Option<f64>,
    /// The joint that this one follows, if any.
    pub mimic: Option<Mimic>,
}

/// Least and greatest position of a joint, radians or metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits {
    /// Least position.
    pub lower: f64,
    /// Greatest position, not below `lower`.
    pub upper: f64,
}

/// A joint that follows another: `position = multiplier * other + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mimic {
    /// Index of the joint that is followed, which may follow another itself.
    pub joint: usize,
    /// Factor.
    pub multiplier: f64,
    /// Added after the factor, radians or metres.
    pub offset: f64,
}

impl Robot {
    /// Index of the link called `name`.
    pub fn link_index(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }

    /// Index of the joint called `name`.
    pub fn joint_index(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Names of the joints that have positions of their own.
    pub fn own_joints(&self) -> Vec<String> {
        let own = self.joints.iter().filter(|joint| joint.moves() && joint.mimic.is_none());
        own.map(|joint| joint.name.clone()).collect()
    }

    /// BLAKE3 hash of the URDF text, as 64 hexadecimal digits.
    pub fn urdf_hash(&self) -> &str {
        &self.urdf_hash
    }

    /// The links that joints of any kind carry directly under `link`, with their joints.
    pub(crate) fn children(&self, link: usize) -> impl Iterator<Item = &Joint> {
        self.joints.iter().filter(move |joint| joint.parent == link)
    }

    /// Whether the link has a shape, or would have one if that could be used.
    pub(crate) fn shows(&self, link: usize) -> bool {
        self.links.get(link).is_some_and(|link| {
            let flawed = |of: &Of| match of {
                Of::Visual(name) | Of::Collision(name) => *name == link.name,
                Of::Nothing(_) | Of::Joint(_) | Of::Mimic(_) => false,
            };
            link.has_geometry() || self.flaws.iter().any(|flaw| flawed(&flaw.of))
        })
    }

    /// The first flaw of a joint that `wanted` is true of.
    pub(crate) fn joint_flaw(&self, wanted: impl Fn(&str) -> bool) -> Option<&RobotError> {
        self.flaws.iter().find_map(|flaw| match &flaw.of {
            Of::Joint(name) | Of::Mimic(name) if wanted(name) => Some(&flaw.error),
            _ => None,
        })
    }

    /// That joints do not make one tree, if they do not.
    pub(crate) fn tree_flaw(&self) -> Option<&RobotError> {
        let of_tree = |flaw: &&Flaw| {
            matches!((&flaw.of, &flaw.error), (Of::Joint(_), RobotError::Tree { .. }))
        };
        self.flaws.iter().find(of_tree).map(|flaw| &flaw.error)
    }

    pub(crate) fn link_names(&self) -> Vec<String> {
        self.links.iter().map(|link| link.name.clone()).collect()
    }
}

impl Link {
    /// Whether the link has any shape at all.
    pub fn has_geometry(&self) -> bool {
        !self.visuals.is_empty() || !self.collisions.is_empty()
    }
}

impl Joint {
    /// Whether the joint has a position.
    pub fn moves(&self) -> bool {
        !matches!(self.kind, JointKind::Fixed | JointKind::Undetermined)
    }

    /// Whether the child link stands still in the parent link.
    pub fn is_fixed(&self) -> bool {
        self.kind == JointKind::Fixed
    }

    /// Pose of the child link in the parent link at `position` (radians or metres; ignored by
    /// fixed joints).
    pub fn parent_from_child(&self, position: f64) -> Transform<frame::Link, frame::Link> {
        let motion = match self.kind {
            JointKind::Fixed | JointKind::Undetermined => return self.parent_from_child_at_zero,
            JointKind::Revolute | JointKind::Continuous => nalgebra::Isometry3::from_parts(
                Translation3::identity(),
                UnitQuaternion::from_axis_angle(&self.axis, position),
            ),
            JointKind::Prismatic => nalgebra::Isometry3::from_parts(
                Translation3::from(self.axis.into_inner() * position),
                UnitQuaternion::identity(),
            ),
        };
        self.parent_from_child_at_zero * Transform::from_isometry(motion)
    }
}
