//! Where everything of a simulated recording is.

use super::body::ArmBody;
use super::configurations::{Onlooker, Pose, choose, choose_alike};
use super::dress::soft_parts;
use super::error::SimulateError;
use super::plate::Plate;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use super::solids::Solid;
use super::stage::{Stage, stages, usual_size};
use super::surroundings::in_place;
use super::true_arm::true_arm;
use super::viewpoint::Viewpoint;
use super::{occlusion, scene, surroundings};
use eyebolt_geometry::{Base, Camera, PinholeCamera, Transform};
use eyebolt_registration::LinkCache;
use eyebolt_render::{RayScene, SceneMesh};
use eyebolt_robot::JointPositions;
use nalgebra::{Point3, Vector3};

/// Where everything is.
pub struct Plan<'a> {
    pub(super) scenario: Scenario<'a>,
    /// The arm as it is, which may not be as it is described.
    pub(super) body: ArmBody,
    /// The true intrinsics.
    pub(super) camera: PinholeCamera,
    /// What the recording says they are.
    pub(super) stated_camera: PinholeCamera,
    pub(super) base_from_camera: Transform<Base, Camera>,
    /// Where the camera is after it was bumped, if it is.
    pub(super) bumped: Option<Transform<Base, Camera>>,
    pub(super) poses: Vec<Pose>,
    /// The room, then the clutter.
    solids: Vec<Solid>,
    room: usize,
    stages: Vec<Stage>,
    /// What the hand holds towards the camera, if it does.
    pub(super) plate: Option<Plate>,
}

/// Decides where everything of `scenario` is; `cache` keeps shapes of links.
///
/// # Errors
///
/// Shapes that cannot be read, a camera that hardly sees the end-effector, impossible intrinsics.
pub fn plan<'a>(scenario: Scenario<'a>, cache: &LinkCache) -> Result<Plan<'a>, SimulateError> {
    if scenario.faults.bump.is_some() && scenario.configurations < 2 {
        return Err(SimulateError::BumpOfOne);
    }
    let body = {
        let arm = true_arm(&scenario);
        let soft = soft_parts(&scenario, arm.robot());
        ArmBody::new(arm, &soft, cache)?
    };
    let camera = scenario.sensor.camera();
    let stated_camera = scenario.faults.intrinsics().stated(&camera)?;
    let seed = scenario.seed;
    let Seen { base_from_camera, room: solids, poses } = seen(&scenario, &body, &camera)?;
    let bumped = scenario.faults.bumped(&base_from_camera, &mut RandomStream::Bump.of(seed));
    let room = solids.len();
    let mut plan = Plan {
        scenario,
        body,
        camera,
        stated_camera,
        base_from_camera,
        bumped,
        poses,
        solids,
        room,
        stages: Vec::new(),
        plate: None,
    };
    plan.put_things();
    Ok(plan)
}

/// A camera, the room that it stands in, and configurations that it sees well.
struct Seen {
    base_from_camera: Transform<Base, Camera>,
    room: Vec<Solid>,
    poses: Vec<Pose>,
}

/// Where the camera stands, and what it sees. Where it sees nothing of an arm that is none of usual size
/// on its own base, it looks at where that arm's end-effector goes.
fn seen(
    scenario: &Scenario<'_>,
    body: &ArmBody,
    camera: &PinholeCamera,
) -> Result<Seen, SimulateError> {
    match seen_from(scenario, body, camera, &scenario.viewpoint) {
        Err(SimulateError::Unfit { found: 0, wanted, rejected }) => {
            let other = match scenario.viewpoint {
                Viewpoint::Within(ranges) => body.end_effectors().and_then(|at| ranges.about(&at)),
                Viewpoint::Preset(_) => None,
            };
            let nothing = SimulateError::Unfit { found: 0, wanted, rejected };
            let other = other.ok_or(nothing)?;
            seen_from(scenario, body, camera, &Viewpoint::Within(other))
        }
        first => first,
    }
}

fn seen_from(
    scenario: &Scenario<'_>,
    body: &ArmBody,
    camera: &PinholeCamera,
    viewpoint: &Viewpoint,
) -> Result<Seen, SimulateError> {
    let seed = scenario.seed;
    let base_from_camera = viewpoint.base_from_camera(&mut RandomStream::Viewpoint.of(seed));
    let eye = base_from_camera.point(&Point3::origin());
    let room = scene::room(&mut RandomStream::Room.of(seed), &[eye], usual_size(scenario));
    let above_m = body.table_above_usual_m();
    let solids: Vec<Solid> = room.into_iter().map(|solid| solid.raised(above_m)).collect();
    let room = RayScene::new(&solids.iter().map(in_place).collect::<Vec<_>>());
    let onlooker = Onlooker {
        camera,
        camera_from_base: base_from_camera.inverse(),
        range_m: scenario.sensor.range_m,
        told_m: [scenario.faults.depth_scale, scenario.faults.depth_offset_m],
        room: &room,
    };
    let random = RandomStream::Configurations.of(seed);
    let count = scenario.configurations;
    let poses = match scenario.faults.wrist_only {
        true => choose_alike(body, &onlooker, count, random)?,
        false => choose(body, &onlooker, count, random)?,
    };
    Ok(Seen { base_from_camera, room: solids, poses })
}

impl Plan<'_> {
    /// The same camera and room with the arm resting in `configurations` instead; all that stands about is put out of
    /// its way anew.
    ///
    /// # Errors
    ///
    /// A configuration without the positions of all joints of the arm, by its place.
    pub fn at(self, configurations: &[JointPositions]) -> Result<Self, SimulateError> {
        let pose = |(index, joints): (usize, &JointPositions)| {
            let posture = self.body.posture(joints).ok_or(SimulateError::Unposed { index })?;
            Ok(Pose { joints: joints.clone(), posture })
        };
        let poses = configurations.iter().enumerate().map(pose);
        let poses = poses.collect::<Result<Vec<_>, SimulateError>>()?;
        let mut plan = Self { poses, ..self };
        plan.put_things();
        Ok(plan)
    }

    /// Puts whatever is not the room out of the way of the arm.
    fn put_things(&mut self) {
        self.solids.truncate(self.room);
        let (scenario, body, poses) = (&self.scenario, &self.body, &self.poses);
        let eye = self.base_from_camera.point(&Point3::origin());
        self.solids.extend(surroundings::clutter_about(scenario, body, poses, &eye));
        self.solids.extend(occlusion::before(scenario, body, poses, &eye));
        self.stages = stages(scenario, body, poses, &eye);
    }

    /// The true pose of the base link in the camera's optical frame, when the recording begins.
    pub fn camera_from_base(&self) -> Transform<Camera, Base> {
        self.base_from_camera.inverse()
    }

    /// Centre of the workspace, base frame: the middle of where the end-effector is.
    pub fn workspace_in_base(&self) -> Point3<f64> {
        let tip = |pose: &Pose| {
            let there = self.body.arm.base_from_end_effector(&pose.joints);
            there.expect("the arm was posed with these joints").translation_m()
        };
        Point3::from(self.poses.iter().map(tip).sum::<Vector3<f64>>() / self.poses.len() as f64)
    }

    /// What stands around: the room, then the clutter.
    pub fn solids(&self) -> &[Solid] {
        &self.solids
    }

    /// The links of the arm with its joints at `joints`, the plate on its hand, then what stands around in a
    /// configuration.
    pub(super) fn scene(
        &self,
        arm: &[SceneMesh<'_>],
        joints: &JointPositions,
        configuration: usize,
    ) -> RayScene {
        let hand = self.body.arm.base_from_end_effector(joints);
        let plate = self.plate.as_ref().zip(hand.ok()).map(|(plate, hand)| plate.at(&hand));
        let with_plate: Vec<_> = arm.iter().copied().chain(plate).collect();
        self.scene_on(&with_plate, self.stages.get(configuration))
    }

    /// What stands around when the arm is not there yet: nobody has passed by.
    pub(super) fn empty_scene(&self) -> RayScene {
        let beside = self.stages.first().and_then(|stage| stage.beside.clone());
        self.scene_on(&[], Some(&Stage { beside, ..Stage::default() }))
    }

    fn scene_on(&self, arm: &[SceneMesh<'_>], stage: Option<&Stage>) -> RayScene {
        let (usual, things) = self.solids.split_at(self.room);
        let room = stage.and_then(|stage| stage.other_room.as_deref()).unwrap_or(usual);
        let passing = stage.map_or(&[][..], |stage| &stage.passing);
        let beside = stage.and_then(|stage| stage.beside.as_ref());
        let beside = beside.map_or(Vec::new(), |beside| beside.meshes(&self.body));
        let around = room.iter().chain(things).chain(passing).map(in_place);
        RayScene::new(&arm.iter().copied().chain(around).chain(beside).collect::<Vec<_>>())
    }
}
