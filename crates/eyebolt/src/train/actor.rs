//! An arm to be drawn in many postures.

use super::error::TrainError;
use crate::end_effector::BoundingBox;
use crate::record;
use crate::simulate::{placed_links, rests};
use eyebolt_geometry::{Base, Camera, EndEffector, Link, PinholeCamera, Transform};
use eyebolt_registration::LinkCache;
use eyebolt_render::{PosedMesh, Random, Raster};
use eyebolt_robot::{Arm, JointPositions, Prefer, TriangleMesh, link_mesh};
use nalgebra::Point3;

/// An arm with the shapes of its links, few triangles each.
pub struct Actor {
    /// Its kinematics.
    pub arm: Arm,
    /// Of each shape, the link of the robot that it is.
    pub links: Vec<usize>,
    /// Of each shape, its surface in the frame of its link, metres.
    pub meshes: Vec<TriangleMesh>,
    /// Whether each shape belongs to the end-effector.
    pub is_end_effector: Vec<bool>,
    /// From the base to the farthest part of the stretched arm, about, metres.
    pub reach_m: f64,
}

/// Where an arm is.
pub struct Pose {
    /// Its joints.
    pub joints: JointPositions,
    /// Of each shape.
    pub base_from_link: Vec<Transform<Base, Link>>,
    /// Of the end-effector.
    pub base_from_end_effector: Transform<Base, EndEffector>,
}

impl Actor {
    /// `arm` with its shapes as `cache` keeps them, simplified.
    ///
    /// # Errors
    ///
    /// Shapes that cannot be read.
    pub fn new(arm: Arm, cache: &LinkCache) -> Result<Self, TrainError> {
        let (links, model) = record::shapes(&arm, placed_links(&arm), cache)?;
        let meshes = model.links().iter().map(|link| link.model.mesh.clone()).collect();
        Ok(Self::of(arm, links, meshes))
    }

    /// `arm` of plain shapes only, as they are.
    ///
    /// # Errors
    ///
    /// Shapes that cannot be read.
    pub fn of_plain_shapes(arm: Arm) -> Result<Self, TrainError> {
        let (mut links, mut meshes) = (Vec::new(), Vec::new());
        for (index, link) in arm.robot().links.iter().enumerate() {
            let failed = |source| record::RecordError::Mesh { link: link.name.clone(), source };
            if let Some(mesh) = link_mesh(link, Prefer::Visual).map_err(failed)? {
                links.push(index);
                meshes.push(mesh);
            }
        }
        Ok(Self::of(arm, links, meshes))
    }

    fn of(arm: Arm, links: Vec<usize>, meshes: Vec<TriangleMesh>) -> Self {
        let end_effector = arm.end_effector_links();
        let is_end_effector = links.iter().map(|link| end_effector.contains(link)).collect();
        let mut actor = Self { arm, links, meshes, is_end_effector, reach_m: 0.0 };
        let random = Random::new(0);
        // How far it gets in a few dozen postures.
        let far = (0..40).filter_map(|place| {
            let pose = actor.pose(actor.any_joints(&mut random.at(place)))?;
            Some(pose.base_from_end_effector.translation_m().norm())
        });
        actor.reach_m = far.fold(0.2, f64::max);
        actor
    }

    /// Joint positions anywhere within their limits, fingers included.
    pub fn any_joints(&self, random: &mut Random) -> JointPositions {
        let robot = self.arm.robot();
        let names = [self.arm.required_joints(), self.arm.other_joints()].concat();
        let drawn = names.into_iter().map(|name| {
            let limits = robot.joint_index(name).and_then(|index| robot.joints[index].limits);
            let (low, high) = limits.map_or((-3.1, 3.1), |limits| (limits.lower, limits.upper));
            (name.to_owned(), random.between(low, high))
        });
        drawn.collect()
    }

    /// Where everything is; `None` if the joints do not say.
    pub fn pose(&self, joints: JointPositions) -> Option<Pose> {
        let poses = self.arm.link_poses_with_defaults(&joints).ok()?.base_from_links;
        let base_from_link = self.links.iter().map(|link| poses[*link]).collect::<Option<_>>()?;
        let base_from_end_effector = self.arm.base_from_end_effector(&joints).ok()?;
        Some(Pose { joints, base_from_link, base_from_end_effector })
    }

    /// Draws it where `pose` has it: [`Raster::link`] is the shape that is seen.
    pub fn draw(
        &self,
        raster: &mut Raster,
        camera: &PinholeCamera,
        pose: &Pose,
        camera_from_base: &Transform<Camera, Base>,
    ) {
        let posed = self.meshes.iter().zip(&pose.base_from_link).zip(0..=u8::MAX);
        let posed = posed.map(|((mesh, base_from_link), link)| PosedMesh {
            mesh,
            camera_from_link: *camera_from_base * *base_from_link,
            link,
        });
        raster.draw(camera, &posed.collect::<Vec<_>>());
    }

    /// Middle of the box around the end-effector link's own shape, in its frame, metres; the origin if it
    /// has none.
    pub fn end_effector_middle(&self) -> Point3<f64> {
        self.end_effector_shape().map_or(Point3::origin(), |shape| self.middle(shape))
    }

    /// Diagonal of that box, metres, and at least a few centimetres.
    pub fn end_effector_extent_m(&self) -> f64 {
        let bounds = self.end_effector_shape().and_then(|shape| self.meshes[shape].bounds());
        bounds.map_or(0.05, |(low, high)| f64::from((high - low).norm()).max(0.05))
    }

    fn end_effector_shape(&self) -> Option<usize> {
        self.links.iter().position(|link| *link == self.arm.end_effector())
    }

    /// Middle of the box around one of its shapes, in the frame of its link, metres; the origin if it is empty.
    pub fn middle(&self, shape: usize) -> Point3<f64> {
        let bounds = self.meshes[shape].bounds();
        bounds.map_or(Point3::origin(), |(low, high)| nalgebra::center(&low, &high).cast())
    }

    /// The lowest point of the arm but for the shapes that no joint moves, base frame, metres.
    pub fn lowest_m(&self, pose: &Pose) -> f64 {
        let moved = self.meshes.iter().zip(&pose.base_from_link).zip(&self.links);
        let moved = moved.filter(|(_, link)| !rests(&self.arm, **link));
        let corners = moved.flat_map(|((mesh, base_from_link), _)| {
            let bounds = mesh.bounds();
            let around =
                bounds.map(|(low, high)| BoundingBox { low: low.cast(), high: high.cast() });
            let corners = around.into_iter().flat_map(|around| around.corners());
            corners.map(|corner| base_from_link.point(&corner).z)
        });
        corners.fold(f64::INFINITY, f64::min)
    }
}
