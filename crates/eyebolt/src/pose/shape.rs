//! An end-effector as registration sees it.

use crate::end_effector::{BoundingBox, EndEffector, EndEffectorError};
use crate::observations::Configuration;
use crate::record;
use eyebolt_geometry::{Base, EndEffector as EndEffectorFrame, Link, Transform};
use eyebolt_registration::{ArmLink, ArmModel, LinkCache, Posture};
use eyebolt_robot::{Arm, JointPositions};
use nalgebra::{Isometry3, Point3};

/// The links of an end-effector as distance fields and meshes. It is an arm by itself, whose base frame is the
/// end-effector frame.
#[derive(Clone, Debug)]
pub struct EndEffectorShape {
    /// Box, keypoints and symmetry.
    pub end_effector: EndEffector,
    /// Its links.
    pub model: ArmModel,
    /// Which links of the robot they are.
    links: Vec<usize>,
    /// Turns that cannot be seen, the identity first.
    twins: Vec<Isometry3<f64>>,
    /// The box about its meshes, which takes a pass over all vertices.
    mesh_box: BoundingBox,
}

impl EndEffectorShape {
    /// The end-effector of `arm`, with its shapes as `cache` keeps them.
    ///
    /// # Errors
    ///
    /// A mesh that cannot be read, or no shape with four points apart from each other.
    pub fn of(arm: &Arm, cache: &LinkCache) -> Result<Self, EndEffectorError> {
        let end_effector = EndEffector::of(arm)?;
        let (links, model) = record::shapes(arm, arm.end_effector_links(), cache)?;
        let turns = end_effector.symmetry().turns();
        let twins = std::iter::once(Isometry3::identity()).chain(turns).collect();
        let mesh_box = end_effector.mesh_box(&JointPositions::default());
        Ok(Self { end_effector, model, links, twins, mesh_box })
    }

    /// Its largest extent, metres: [`EndEffector::extent_m`].
    pub fn extent_m(&self) -> f64 {
        self.mesh_box.size_m().norm()
    }

    /// Middle of the box about its meshes, its fingers where they are without joint positions.
    pub fn centre(&self) -> Point3<f64> {
        self.mesh_box.centre()
    }

    /// Where its links are when its fingers are at `joints`; those that are not there, as without joint states.
    pub fn posture(&self, joints: &JointPositions) -> Posture {
        let poses = self.end_effector.poses(&self.links, joints);
        let as_base = |pose: Transform<EndEffectorFrame, _>| {
            Transform::<Base, _>::from_isometry(*pose.isometry())
        };
        Posture::new(&self.model, poses.into_iter().map(as_base).collect())
    }

    /// Where its links are in a configuration of `arm`; `None` if one of them is not among the arm's.
    pub(crate) fn posture_of(
        &self,
        arm: &ArmModel,
        configuration: &Configuration,
    ) -> Option<Posture> {
        let end_effector_from_base = configuration.base_from_end_effector.inverse();
        let pose = |of: &ArmLink| {
            let index = arm.links().iter().position(|link| link.name == of.name)?;
            let base_from_link = configuration.posture.base_from_link().get(index)?;
            let pose = end_effector_from_base * *base_from_link;
            Some(Transform::<Base, Link>::from_isometry(*pose.isometry()))
        };
        let poses = self.model.links().iter().map(pose).collect::<Option<Vec<_>>>()?;
        Some(Posture::new(&self.model, poses))
    }

    /// Postures of a few openings of its fingers, half open first; one if nothing of it moves.
    pub fn openings(&self) -> Vec<Posture> {
        let all = [0.5, 0.0, 1.0].map(|share| self.end_effector.opened(share));
        match all[0] == all[1] {
            true => vec![self.posture(&all[0])],
            false => all.iter().map(|joints| self.posture(joints)).collect(),
        }
    }

    /// Turns in the end-effector frame after which it looks the same, the identity first.
    pub fn twins(&self) -> &[Isometry3<f64>] {
        &self.twins
    }

    /// How far two poses are apart, metres and radians, by the turn that cannot be seen which is nearest.
    pub fn apart(&self, a: &Isometry3<f64>, b: &Isometry3<f64>) -> (f64, f64) {
        let by = |twin: &Isometry3<f64>| {
            let off = (b * twin).inverse() * a;
            (off.translation.vector.norm(), off.rotation.angle())
        };
        let extent_m = self.extent_m();
        let size = |(metres, radians): &(f64, f64)| metres + extent_m * radians;
        let nearest = self.twins.iter().map(by).min_by(|a, b| size(a).total_cmp(&size(b)));
        nearest.unwrap_or((0.0, 0.0))
    }
}
