//! An arm that can be posed, drawn and kept from bumping into things.

use super::dress::Soft;
use super::scene::TABLE_BELOW_M;
use super::solids::Solid;
use super::table;
use super::viewpoint::EndEffectors;
use crate::record;
use eyebolt_geometry::{Base, Camera, Link, Transform};
use eyebolt_registration::{ArmModel, LinkCache, Posture};
use eyebolt_render::{Random, SceneMesh};
use eyebolt_robot::{Arm, JointPositions, Prefer, TriangleMesh, link_mesh};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

/// An arm with the shapes of its links.
pub(crate) struct ArmBody {
    pub(crate) arm: Arm,
    /// Which links of the robot the model's are.
    pub(crate) links: Vec<usize>,
    pub(crate) model: ArmModel,
    /// The links' surfaces as they are, not simplified.
    meshes: Vec<TriangleMesh>,
    /// Of the model's links, those of the end-effector.
    pub(crate) is_end_effector: Vec<bool>,
    /// Pairs of links that may not touch: not neighbours, and none that always do.
    apart: Vec<(usize, usize)>,
    /// How postures are drawn.
    draws: Vec<Draw>,
    /// Of the model's links, those that the joints of the chain and of the hand move. The others (what
    /// the arm stands on, wheels, a head, a second arm) stay where they are.
    pub(crate) moved: Vec<bool>,
    /// Height of the table's top, base frame, metres.
    pub(crate) table_m: f64,
    /// Around each of the model's links: centre in its frame, radius, metres.
    spheres: Vec<(Point3<f32>, f32)>,
}

/// How the position of a joint is drawn.
struct Draw {
    joint: String,
    /// Between which positions, if it is drawn at all; else it stays where it is by default.
    between: Option<[f64; 2]>,
    default: f64,
}

/// Nothing comes nearer to the arm than this, metres.
const CLEARANCE_M: f32 = 0.012;
/// Configurations drawn to learn which links always touch, and how many of them say so.
const TRIALS: u64 = 60;
const MOSTLY: f64 = 0.5;

impl ArmBody {
    /// `arm` as it is described.
    pub(crate) fn of_described(arm: Arm, cache: &LinkCache) -> Result<Self, record::RecordError> {
        Self::new(arm, &[], cache)
    }

    /// `arm` with `soft` parts on it, that are seen and give way.
    pub(super) fn new(
        arm: Arm,
        soft: &[Soft],
        cache: &LinkCache,
    ) -> Result<Self, record::RecordError> {
        let robot = arm.robot();
        let (links, model) = record::shapes(&arm, placed_links(&arm), cache)?;
        let meshes = links.iter().map(|index| {
            let mut link = robot.links[*index].clone();
            let on_it = soft.iter().filter(|part| part.link == *index);
            link.visuals.extend(on_it.map(|part| part.body.clone()));
            let read = link_mesh(&link, Prefer::Visual);
            let failed = |source| record::RecordError::Mesh { link: link.name.clone(), source };
            Ok(read.map_err(failed)?.unwrap_or_default())
        });
        let meshes: Vec<TriangleMesh> = meshes.collect::<Result<_, record::RecordError>>()?;
        let end_effector = arm.end_effector_links();
        let drawn = drawn_joints(&arm);
        let moved: Vec<bool> = links.iter().map(|link| is_moved(&arm, &drawn, *link)).collect();
        let mut body = Self {
            is_end_effector: links.iter().map(|link| end_effector.contains(link)).collect(),
            moved,
            table_m: -TABLE_BELOW_M,
            spheres: meshes.iter().map(sphere).collect(),
            draws: draws(&arm, &drawn),
            arm,
            apart: Vec::new(),
            links,
            model,
            meshes,
        };
        let random = Random::new(0);
        let drawn = (0..TRIALS).map(|trial| body.any_joints(&mut random.at(trial)));
        let trials: Vec<Posture> = drawn.filter_map(|joints| body.posture(&joints)).collect();
        body.apart = body.seldom_touching(&trials);
        body.table_m = body.table_under(&trials);
        Ok(body)
    }

    pub(crate) fn posture(&self, joints: &JointPositions) -> Option<Posture> {
        let poses = self.arm.link_poses_with_defaults(joints).ok()?.base_from_links;
        let poses: Option<Vec<_>> = self.links.iter().map(|link| poses[*link]).collect();
        Some(Posture::new(&self.model, poses?))
    }

    /// The links' surfaces where `posture` has them.
    pub(super) fn scene_meshes(&self, posture: &Posture) -> Vec<SceneMesh<'_>> {
        let posed = self.meshes.iter().zip(posture.base_from_link());
        posed.map(|(mesh, pose)| SceneMesh { mesh, base_from_mesh: *pose }).collect()
    }

    /// Where each of the model's links reaches down to in `postures`, and what is moved.
    fn table_under(&self, postures: &[Posture]) -> f64 {
        let low = |link: usize, posture: &Posture| {
            let heights = self.link_surface(posture, link).map(|point| f64::from(point.z));
            heights.fold(f64::INFINITY, f64::min)
        };
        let lows = (0..self.links.len()).map(|link| {
            let lows = postures.iter().map(|posture| low(link, posture)).collect();
            table::Lows { lows, moved: self.moved[link] }
        });
        table::top(&lows.collect::<Vec<_>>(), f64::from(CLEARANCE_M))
    }

    /// How much higher than usual the table is: not at all, or lower.
    pub(super) fn table_above_usual_m(&self) -> f64 {
        self.table_m + TABLE_BELOW_M
    }

    /// Where the end-effector goes; `None` if nowhere.
    pub(super) fn end_effectors(&self) -> Option<EndEffectors> {
        const DRAWN: u64 = 500;
        let random = Random::new(0);
        let at = |place: u64| {
            let joints = self.any_joints(&mut random.at(place));
            Some(self.arm.base_from_end_effector(&joints).ok()?.translation_m())
        };
        let places: Vec<Vector3<f64>> = (0..DRAWN).filter_map(at).collect();
        let middle = places.iter().sum::<Vector3<f64>>() / places.len().max(1) as f64;
        let mut far: Vec<f64> = places.iter().map(|place| (place - middle).norm()).collect();
        far.sort_by(f64::total_cmp);
        let far_m = *far.get(far.len() * 9 / 10)?;
        Some(EndEffectors { middle, far_m })
    }

    /// Joint positions anywhere within their limits, fingers included; joints of other limbs stay where
    /// they are by default.
    pub(crate) fn any_joints(&self, random: &mut Random) -> JointPositions {
        let drawn = self.draws.iter().map(|Draw { joint, between, default }| {
            let at = between.map_or(*default, |[low, high]| random.between(low, high));
            (joint.clone(), at)
        });
        drawn.collect()
    }

    /// Between which positions, radians or metres, a joint is drawn that postures differ in; a little within its limits.
    pub(crate) fn range(&self, joint: &str) -> Option<[f64; 2]> {
        self.draws.iter().find(|draw| draw.joint == joint)?.between
    }

    /// Whether the arm in `posture` touches itself or the table, or comes near to the camera.
    pub(super) fn bumps(&self, posture: &Posture, camera_in_base: &Point3<f64>) -> bool {
        self.is_near(posture, camera_in_base) || self.sinks(posture) || self.touches_itself(posture)
    }

    /// Whether the arm in `posture` comes near to a camera.
    pub(crate) fn is_near(&self, posture: &Posture, camera_in_base: &Point3<f64>) -> bool {
        const CAMERA_CLEARANCE_M: f32 = 0.3;
        let camera = camera_in_base.cast();
        posture.nearest_within(&self.model, &camera, CAMERA_CLEARANCE_M, 0).is_some()
    }

    /// Whether links in `posture` touch that should not.
    pub(crate) fn touches_itself(&self, posture: &Posture) -> bool {
        let spheres = self.spheres_of(posture);
        self.apart.iter().any(|pair| self.touch(posture, &spheres, *pair))
    }

    /// Whether `solid` is clear of the arm in `posture`.
    pub(super) fn is_clear_of(&self, posture: &Posture, solid: &Solid) -> bool {
        let (low, high) = solid.bounds();
        let margin = nalgebra::Vector3::repeat(2.0 * CLEARANCE_M);
        let (low, high) = (low - margin, high + margin);
        !self
            .surface(posture)
            .any(|p| (0..3).all(|axis| (low[axis]..high[axis]).contains(&p[axis])))
    }

    /// Points all over the arm, base frame.
    pub(super) fn surface<'b>(
        &'b self,
        posture: &'b Posture,
    ) -> impl Iterator<Item = Point3<f32>> + 'b {
        (0..self.links.len()).flat_map(move |link| self.link_surface(posture, link))
    }

    /// Points all over link `link` of the model, base frame.
    pub(crate) fn link_surface<'b>(
        &'b self,
        posture: &'b Posture,
        link: usize,
    ) -> impl Iterator<Item = Point3<f32>> + 'b {
        let pose = posture.base_from_link()[link].isometry().cast::<f32>();
        self.model.links()[link].model.surface.iter().map(move |s| pose * s.point)
    }

    /// Whether a link that moves touches the table in `posture`.
    pub(crate) fn sinks(&self, posture: &Posture) -> bool {
        let table = self.table_m as f32 + CLEARANCE_M;
        (0..self.links.len())
            .filter(|link| self.moved[*link])
            .any(|link| self.link_surface(posture, link).any(|point| point.z < table))
    }

    /// Lets only joints called `moving` move from here on: links that none of them moves against each other may touch, as the
    /// fingers of a closed hand do.
    pub(crate) fn hold_all_but(&mut self, moving: &[&str]) {
        let movers: Vec<Vec<usize>> =
            self.links.iter().map(|link| movers(&self.arm, moving, *link)).collect();
        self.apart.retain(|(a, b)| movers[*a] != movers[*b]);
        self.moved = movers.iter().map(|movers| !movers.is_empty()).collect();
    }

    fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        let count = self.links.len();
        let all = (0..count).flat_map(move |a| (a + 1..count).map(move |b| (a, b)));
        // What does not move does not begin to touch.
        all.filter(|(a, b)| self.moved[*a] || self.moved[*b])
    }

    fn touch(
        &self,
        posture: &Posture,
        spheres: &[(Point3<f32>, f32)],
        (a, b): (usize, usize),
    ) -> bool {
        if are_apart(spheres[a], spheres[b]) {
            return false;
        }
        let pose = |link: usize| &posture.base_from_link()[link];
        let (in_a, in_b): (Transform<Link, Base>, Transform<Link, Base>) =
            (pose(a).inverse(), pose(b).inverse());
        let near = |of: usize, to: usize, to_from_of: Transform<Link, Link>| {
            let (of, field) = (&self.model.links()[of].model, &self.model.links()[to].model.field);
            let to_from_of = to_from_of.isometry().cast::<f32>();
            of.surface
                .iter()
                .any(|s| field.sample(&(to_from_of * s.point)).distance_m < CLEARANCE_M)
        };
        near(a, b, in_b * *pose(a)) || near(b, a, in_a * *pose(b))
    }

    /// The sphere around link `link` of the model: centre in the link's frame, radius, metres.
    pub(super) fn sphere(&self, link: usize) -> (Point3<f32>, f32) {
        self.spheres[link]
    }

    /// The spheres around the links where `posture` has them.
    fn spheres_of(&self, posture: &Posture) -> Vec<(Point3<f32>, f32)> {
        let placed = self.spheres.iter().zip(posture.base_from_link());
        placed
            .map(|((centre, radius), pose)| (pose.isometry().cast::<f32>() * centre, *radius))
            .collect()
    }

    /// Pairs of links that are no neighbours and do not mostly touch in `postures`.
    fn seldom_touching(&self, postures: &[Posture]) -> Vec<(usize, usize)> {
        let neighbours = |(a, b): (usize, usize)| {
            let robot = self.arm.robot();
            let parent = |link: usize| robot.links[self.links[link]].parent.map(|(above, _)| above);
            parent(a) == Some(self.links[b]) || parent(b) == Some(self.links[a])
        };
        let spheres: Vec<_> = postures.iter().map(|posture| self.spheres_of(posture)).collect();
        let mostly = |pair: (usize, usize)| {
            let placed = postures.iter().zip(&spheres);
            let touching = placed.filter(|(posture, spheres)| self.touch(posture, spheres, pair));
            touching.count() as f64 >= MOSTLY * postures.len() as f64
        };
        let pairs: Vec<_> = self.pairs().collect();
        pairs.into_par_iter().filter(|pair| !neighbours(*pair) && !mostly(*pair)).collect()
    }

    /// Where the end-effector is, for a quick look at whether the camera has it in view.
    pub(super) fn end_effector(
        &self,
        joints: &JointPositions,
        camera_from_base: &Transform<Camera, Base>,
    ) -> Option<Point3<f64>> {
        let pose = self.arm.base_from_end_effector(joints).ok()?;
        Some(camera_from_base.point(&Point3::from(pose.translation_m())))
    }
}

/// The links below the base whose place positions of joints tell: what hangs on a joint of another kind is
/// nowhere.
pub fn placed_links(arm: &Arm) -> Vec<usize> {
    let names = [arm.required_joints(), arm.other_joints()].concat();
    let anywhere = names.iter().map(|name| ((*name).to_owned(), arm.default_position(name)));
    let poses = arm.known_link_poses(&anywhere.collect()).map(|known| known.base_from_links);
    let poses = poses.unwrap_or_default().into_iter().enumerate();
    let placed = poses.filter_map(|(link, pose)| pose.map(|_| link));
    placed.filter(|link| arm.is_below_base(*link)).collect()
}

/// Names of the joints that postures differ in: those of the chain and of the hand.
fn drawn_joints(arm: &Arm) -> Vec<&str> {
    let (robot, hand) = (arm.robot(), arm.end_effector_links());
    let of_hand = |name: &&str| {
        robot.joint_index(name).is_some_and(|joint| hand.contains(&robot.joints[joint].parent))
    };
    let others = arm.other_joints().into_iter().filter(of_hand);
    arm.required_joints().into_iter().chain(others).collect()
}

/// How the positions of the joints of `arm` are drawn, of which `free` are not where they are by default.
fn draws(arm: &Arm, free: &[&str]) -> Vec<Draw> {
    let robot = arm.robot();
    let names = [arm.required_joints(), arm.other_joints()].concat();
    let draw = |name: &str| {
        let limits = robot.joint_index(name).and_then(|index| robot.joints[index].limits);
        let (low, high) = limits.map_or((-3.0, 3.0), |limits| (limits.lower, limits.upper));
        // Clear of the stops, where arms refuse to go. Limits that nobody filled in leave no room.
        let clear = 0.03 * (high - low);
        Draw {
            joint: name.to_owned(),
            between: free.contains(&name).then_some([low + clear, high - clear]),
            default: arm.default_position(name),
        }
    };
    names.into_iter().map(draw).collect()
}

/// Whether two spheres are so far apart that nothing else of their links needs to be looked at: nearly all
/// are.
fn are_apart((a, radius_a): (Point3<f32>, f32), (b, radius_b): (Point3<f32>, f32)) -> bool {
    (a - b).norm() > radius_a + radius_b + 2.0 * CLEARANCE_M
}

/// Whether one of the joints called `drawn` moves `link` in the base.
fn is_moved(arm: &Arm, drawn: &[&str], link: usize) -> bool {
    !movers(arm, drawn, link).is_empty()
}

/// Those joints between the base and `link` that are called one of `names`, or follow one, the last one first.
fn movers(arm: &Arm, names: &[&str], link: usize) -> Vec<usize> {
    let robot = arm.robot();
    let mut found = Vec::new();
    let mut at = link;
    while let Some((parent, own)) = robot.links[at].parent.filter(|_| at != arm.base()) {
        let mut joint = &robot.joints[own];
        while let Some(mimic) = joint.mimic {
            joint = &robot.joints[mimic.joint];
        }
        if names.contains(&joint.name.as_str()) {
            found.push(own);
        }
        at = parent;
    }
    found
}

/// Whether no joint moves `link`, which is below the base of `arm`, in the base.
pub fn rests(arm: &Arm, link: usize) -> bool {
    let robot = arm.robot();
    let mut at = link;
    while let Some((parent, joint)) = robot.links[at].parent.filter(|_| at != arm.base()) {
        if !robot.joints[joint].is_fixed() {
            return false;
        }
        at = parent;
    }
    true
}

/// A sphere around `mesh`.
fn sphere(mesh: &TriangleMesh) -> (Point3<f32>, f32) {
    let centre =
        mesh.bounds().map_or(Point3::origin(), |(low, high)| nalgebra::center(&low, &high));
    let distances = mesh.vertices.iter().map(|vertex| (vertex - centre).norm());
    (centre, distances.fold(0.0, f32::max))
}
