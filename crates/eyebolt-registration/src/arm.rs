//! An arm's links as shapes, and the arm in one configuration.

mod joints;

pub use joints::{ArmJoint, JointAxis, JointOffsets, MOST_JOINTS};

use crate::distance_field::DistanceSample;
use crate::link_model::LinkModel;
use eyebolt_geometry::{Base, Camera, Link, Transform};
use eyebolt_render::PosedMesh;
use nalgebra::{Matrix3, Point3, Vector3};
use std::sync::Arc;

/// The shapes of all links of an arm that have one, and the joints whose zeros may be off.
#[derive(Clone, Debug)]
pub struct ArmModel {
    links: Vec<ArmLink>,
    joints: Vec<ArmJoint>,
}

/// One link with a shape.
#[derive(Clone, Debug)]
pub struct ArmLink {
    /// The link's name in the URDF.
    pub name: String,
    /// Its shape.
    pub model: Arc<LinkModel>,
}

impl ArmModel {
    /// An arm of these links.
    ///
    /// # Panics
    ///
    /// With more than 255 links.
    pub fn new(links: Vec<ArmLink>) -> Self {
        assert!(links.len() < 256, "an arm of {} links", links.len());
        Self { links, joints: Vec::new() }
    }

    /// The same arm with `joints`, from the base on, of a chain where each carries the next; those
    /// beyond the first [`MOST_JOINTS`] are taken at their word.
    ///
    /// # Panics
    ///
    /// If a joint does not say of each link whether it carries it.
    #[must_use]
    pub fn with_joints(self, mut joints: Vec<ArmJoint>) -> Self {
        let complete = |joint: &ArmJoint| joint.carries.len() == self.links.len();
        assert!(joints.iter().all(complete), "one entry for each link");
        joints.truncate(MOST_JOINTS);
        Self { joints, ..self }
    }

    /// The joints whose zeros may be off, from the base on; none unless they were given.
    pub fn joints(&self) -> &[ArmJoint] {
        &self.joints
    }

    /// The links, in the order that postures use.
    pub fn links(&self) -> &[ArmLink] {
        &self.links
    }
}

/// An arm in one configuration: where each link of the [`ArmModel`] is in the base frame.
#[derive(Clone, Debug)]
pub struct Posture {
    base_from_link: Vec<Transform<Base, Link>>,
    placed: Vec<Placed>,
    axes: Vec<JointAxis>,
}

/// A link's pose the other way round, in single precision, with a sphere about its field.
#[derive(Clone, Copy, Debug)]
struct Placed {
    link_from_base: Matrix3<f32>,
    offset: Vector3<f32>,
    centre_in_base: Point3<f32>,
    radius_m: f32,
}

/// The surface of the arm nearest to a point.
#[derive(Clone, Copy, Debug)]
pub struct NearestSurface {
    /// Which link of the [`ArmModel`].
    pub link: usize,
    /// Signed distance to it, metres.
    pub distance_m: f32,
    /// Gradient of the distance in the base frame.
    pub gradient_in_base: Vector3<f32>,
}

impl Posture {
    /// The arm with its links at `base_from_link`, one for each link of `arm`.
    pub fn new(arm: &ArmModel, base_from_link: Vec<Transform<Base, Link>>) -> Self {
        assert_eq!(arm.links.len(), base_from_link.len(), "one pose for each link");
        let placed = arm.links.iter().zip(&base_from_link).map(|(link, pose)| {
            let inverse = pose.inverse();
            let (low, high) = link.model.field.bounds();
            let centre = nalgebra::center(&low, &high);
            Placed {
                link_from_base: inverse.rotation().to_rotation_matrix().into_inner().cast(),
                offset: inverse.translation_m().cast(),
                centre_in_base: pose.point(&centre.cast()).cast(),
                radius_m: 0.5 * (high - low).norm(),
            }
        });
        Self { placed: placed.collect(), base_from_link, axes: Vec::new() }
    }

    /// The same posture, where the arm's joints have their axes at `axes`, in the order of
    /// [`ArmModel::joints`]; those beyond the first [`MOST_JOINTS`] have no use.
    #[must_use]
    pub fn with_axes(self, mut axes: Vec<JointAxis>) -> Self {
        axes.truncate(MOST_JOINTS);
        Self { axes, ..self }
    }

    /// Pose of each link of the model.
    pub fn base_from_link(&self) -> &[Transform<Base, Link>] {
        &self.base_from_link
    }

    /// Signed distance from `point_in_base` (metres) to the arm.
    pub fn nearest(&self, arm: &ArmModel, point_in_base: &Point3<f32>) -> Option<NearestSurface> {
        self.nearest_within(arm, point_in_base, f32::INFINITY)
    }

    /// As [`Self::nearest`], but only what is nearer than `limit_m`, which is quickly decided where
    /// there is nothing.
    pub fn nearest_within(
        &self,
        arm: &ArmModel,
        point_in_base: &Point3<f32>,
        limit_m: f32,
    ) -> Option<NearestSurface> {
        let mut best: Option<(usize, DistanceSample)> = None;
        let mut limit_m = limit_m;
        for (link, (shape, placed)) in arm.links.iter().zip(&self.placed).enumerate() {
            let reach = limit_m + placed.radius_m;
            // A field never says less than the distance to its own sphere.
            let apart = (point_in_base - placed.centre_in_base).norm_squared();
            if reach < 0.0 || apart > reach * reach {
                continue;
            }
            let in_link =
                Point3::from(placed.link_from_base * point_in_base.coords + placed.offset);
            let sample = shape.model.field.sample(&in_link);
            if sample.distance_m < limit_m {
                limit_m = sample.distance_m;
                best = Some((link, sample));
            }
        }
        let (link, sample) = best?;
        let gradient_in_base = self.placed[link].link_from_base.tr_mul(&sample.gradient);
        Some(NearestSurface { link, distance_m: sample.distance_m, gradient_in_base })
    }

    /// The links' meshes where a camera at `camera_from_base` has them.
    pub fn meshes<'a>(
        &self,
        arm: &'a ArmModel,
        camera_from_base: &Transform<Camera, Base>,
    ) -> Vec<PosedMesh<'a>> {
        let posed = arm.links.iter().zip(&self.base_from_link).enumerate();
        posed
            .map(|(index, (link, pose))| PosedMesh {
                mesh: &link.model.mesh,
                camera_from_link: *camera_from_base * *pose,
                link: index as u8,
            })
            .collect()
    }
}
