//! The end-effector as the robot description has it.

use super::bounding_box::BoundingBox;
use super::corners::corners;
use super::error::EndEffectorError;
use super::keypoints::{FEWEST_KEYPOINTS, Keypoint, choose, permutations};
use super::preset::Preset;
use super::reference::{end_effector_from_links, half_open};
use super::shape::{Part, parts, vertices};
use super::surface::spread;
use super::symmetry::Symmetry;
use eyebolt_geometry::{EndEffector as EndEffectorFrame, Link, Transform};
use eyebolt_robot::{Arm, Joint, JointPositions, TriangleMesh};
use nalgebra::Point3;

/// The end-effector link and all below it: shape, box, keypoints and symmetry.
///
/// Joint positions may be those of the whole arm or of the fingers alone: joints of the arm change
/// nothing here. Fingers without a position, or with one that is not a number, are where
/// [`Arm::link_poses_with_defaults`] puts them.
#[derive(Clone, Debug)]
pub struct EndEffector {
    arm: Arm,
    parts: Vec<Part>,
    keypoints: Vec<Keypoint>,
    symmetry: Symmetry,
    preset: Option<&'static Preset>,
    size_m: f64,
}

/// Points that tell the symmetry.
const DENSE: usize = 40_000;

impl EndEffector {
    /// Reads the meshes of the end-effector of `arm`, and chooses keypoints: the paper's for the
    /// hand of a Panda, else corners of the shape.
    ///
    /// # Errors
    ///
    /// A mesh that cannot be read, or no shape with four points apart from each other.
    pub fn of(arm: &Arm) -> Result<Self, EndEffectorError> {
        let parts = parts(arm)?;
        let mut made = Self {
            arm: arm.clone(),
            parts,
            keypoints: Vec::new(),
            symmetry: Symmetry::None,
            preset: Preset::of(arm),
            size_m: 0.0,
        };
        let half_open = half_open(arm);
        made.size_m = made.mesh_box(&half_open).size_m().norm();
        made.symmetry = Symmetry::of(&made.points(&half_open, DENSE));
        made.keypoints = match made.preset {
            Some(preset) => made.fixed(&preset.keypoints(arm), &preset.joints()),
            None => made.fixed(&made.corners(&half_open), &half_open),
        };
        if made.keypoints.len() < FEWEST_KEYPOINTS {
            let (robot, link) = (arm.robot().name.clone(), arm.end_effector_name().to_owned());
            return Err(EndEffectorError::NoSolid { robot, link });
        }
        Ok(made)
    }

    /// Name of the end-effector link.
    pub fn name(&self) -> &str {
        self.arm.end_effector_name()
    }

    /// Names of the joints that move the end-effector in the base, then of those that move its own
    /// parts.
    pub fn joint_names(&self) -> Vec<&str> {
        let mut names = self.arm.required_joints();
        let links = self.arm.end_effector_links();
        let below = |joint: &&Joint| joint.moves() && links.contains(&joint.parent);
        for joint in self.arm.robot().joints.iter().filter(below) {
            let name = self.source_name(joint);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// Name of the joint that decides where `joint` is.
    fn source_name<'a>(&'a self, mut joint: &'a Joint) -> &'a str {
        let joints = &self.arm.robot().joints;
        // A tree that was read has no circle of joints that follow each other.
        while let Some(next) = joint.mimic.and_then(|mimic| joints.get(mimic.joint)) {
            joint = next;
        }
        &joint.name
    }

    /// Its own joints at this share of the way between their limits.
    pub fn opened(&self, share: f64) -> JointPositions {
        let of_arm = self.arm.required_joints().len();
        let joints = &self.arm.robot().joints;
        let at = |name: &&str| {
            let joint = joints.iter().find(|joint| joint.name == **name);
            let limits = joint.and_then(|joint| joint.limits);
            let at = limits.map_or(0.0, |it| it.lower + share * (it.upper - it.lower));
            ((*name).to_owned(), at)
        };
        self.joint_names()[of_arm..].iter().map(at).collect()
    }

    /// What keypoints are fixed to, in the order of their classes (class 1 is the first).
    pub fn fixed_keypoints(&self) -> &[Keypoint] {
        &self.keypoints
    }

    /// Where the keypoints are, end-effector frame, metres; 4 to 8 of them, always in this order.
    pub fn keypoints(&self, joints: &JointPositions) -> Vec<Point3<f64>> {
        let links: Vec<usize> = self.keypoints.iter().map(|keypoint| keypoint.link).collect();
        let poses = self.poses(&links, joints);
        let keypoints = self.keypoints.iter().zip(poses);
        keypoints.map(|(keypoint, pose)| pose.point(&keypoint.point_in_link)).collect()
    }

    /// As [`Self::keypoints`]; `None` on a finger whose joint has no position in `joints`: nobody knows
    /// where that is.
    pub fn known_keypoints(&self, joints: &JointPositions) -> Vec<Option<Point3<f64>>> {
        let of_arm = self.arm.required_joints().into_iter().map(|name| (name.to_owned(), 0.0));
        let told = joints.iter().filter(|(_, position)| position.abs() < MOST_POSITION);
        let told = told.map(|(name, at)| (name.to_owned(), at));
        let placed = self.arm.known_link_poses(&of_arm.chain(told).collect());
        let placed = placed.map(|known| known.base_from_links).unwrap_or_default();
        let is_placed = |link: usize| placed.get(link).is_some_and(Option::is_some);
        let keypoints = self.keypoints.iter().zip(self.keypoints(joints));
        keypoints.map(|(keypoint, at)| is_placed(keypoint.link).then_some(at)).collect()
    }

    /// Which keypoint each looks like after each turn of [`Self::symmetry`], the identity first: by
    /// its shape alone, nobody can tell which of these is true.
    pub fn keypoint_permutations(&self) -> Vec<Vec<usize>> {
        permutations(&self.keypoints(&half_open(&self.arm)), &self.symmetry, self.size_m)
    }

    /// Turns that cannot be seen from the shape, with the fingers half open.
    pub fn symmetry(&self) -> Symmetry {
        self.symmetry
    }

    /// Box for points that are known to be of the robot: the published one of a known hand, else
    /// that of the meshes.
    pub fn bounding_box(&self, joints: &JointPositions) -> BoundingBox {
        self.preset.map_or_else(|| self.mesh_box(joints), Preset::bounding_box)
    }

    /// The smallest box about the meshes.
    pub fn mesh_box(&self, joints: &JointPositions) -> BoundingBox {
        let poses = self.part_poses(joints);
        let vertices = vertices(&self.parts, &poses).map(|(_, vertex)| vertex);
        BoundingBox::about(vertices).expect("every part has a triangle")
    }

    /// Diagonal of the box about the meshes with the fingers where they are without joint positions, metres:
    /// no two of its points are farther apart.
    pub fn extent_m(&self) -> f64 {
        self.mesh_box(&JointPositions::default()).size_m().norm()
    }

    /// All meshes as one, end-effector frame.
    pub fn mesh(&self, joints: &JointPositions) -> TriangleMesh {
        let mut whole = TriangleMesh::default();
        for (part, pose) in self.parts.iter().zip(self.part_poses(joints)) {
            let place = |vertex: &Point3<f32>| pose.point(&vertex.cast()).cast();
            let vertices = part.mesh.vertices.iter().map(place).collect();
            let placed = TriangleMesh { vertices, triangles: part.mesh.triangles.clone() };
            whole.append(&placed).expect("meshes of few links, each of bounded size");
        }
        whole
    }

    /// `count` points spread evenly over the surface, end-effector frame, metres; point by point the
    /// same ones for other positions of the fingers.
    pub fn points(&self, joints: &JointPositions, count: usize) -> Vec<Point3<f64>> {
        let poses = self.part_poses(joints);
        let spread = spread(&self.parts, count).into_iter();
        spread.map(|(part, point)| poses[part].point(&point)).collect()
    }

    fn corners(&self, joints: &JointPositions) -> Vec<(usize, Point3<f64>)> {
        let poses = self.part_poses(joints);
        let vertices: Vec<_> = vertices(&self.parts, &poses).collect();
        let corners = corners(&vertices, self.size_m);
        let chosen = choose(&corners, &self.symmetry, self.size_m).into_iter();
        chosen.map(|corner| (self.parts[corner.part].link, corner.point)).collect()
    }

    /// Points of the end-effector frame, fixed to their links where these are for `joints`.
    fn fixed(&self, points: &[(usize, Point3<f64>)], joints: &JointPositions) -> Vec<Keypoint> {
        let links: Vec<usize> = points.iter().map(|(link, _)| *link).collect();
        let poses = self.poses(&links, joints);
        let placed = points.iter().zip(poses);
        placed
            .map(|((link, point), pose)| Keypoint {
                link: *link,
                point_in_link: pose.inverse().point(point),
            })
            .collect()
    }

    fn part_poses(&self, joints: &JointPositions) -> Vec<Transform<EndEffectorFrame, Link>> {
        let links: Vec<usize> = self.parts.iter().map(|part| part.link).collect();
        self.poses(&links, joints)
    }

    pub(crate) fn poses(
        &self,
        links: &[usize],
        joints: &JointPositions,
    ) -> Vec<Transform<EndEffectorFrame, Link>> {
        let usable = joints.iter().filter(|(_, position)| position.abs() < MOST_POSITION);
        let usable: JointPositions = usable.map(|(name, at)| (name.to_owned(), at)).collect();
        let poses = end_effector_from_links(&self.arm, links, &usable);
        poses.unwrap_or_else(|_| {
            let none = JointPositions::default();
            end_effector_from_links(&self.arm, links, &none).expect("defaults are numbers")
        })
    }
}

/// Farther than this no joint turns or slides, radians or metres.
const MOST_POSITION: f64 = 1e6;
