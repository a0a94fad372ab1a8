//! Another arm of the same kind that stands beside.

use super::body::ArmBody;
use super::configurations::Pose;
use super::lab::SecondArm;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use eyebolt_geometry::{Base, Transform};
use eyebolt_registration::Posture;
use eyebolt_render::{Random, RayScene, SceneMesh};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Another arm at rest.
#[derive(Clone)]
pub(super) struct Beside {
    base_from_its_base: Transform<Base, Base>,
    posture: Posture,
}

/// Places and postures tried.
const TRIES: u64 = 300;
/// How far away it stands, metres.
const DISTANCE_M: [f64; 2] = [0.6, 0.9];
/// The two come no nearer to each other, metres.
const CLEARANCE_M: f32 = 0.03;
/// Of the arm's surface in one configuration it hides no more than this.
const HIDDEN: f64 = 0.1;

/// Where another arm rests in each of `poses` of `body`, if there is to be one and it has room. It stands
/// in the same place all the time.
pub(super) fn second_arm(
    scenario: &Scenario<'_>,
    body: &ArmBody,
    poses: &[Pose],
    eye: &Point3<f64>,
) -> Vec<Option<Beside>> {
    let nowhere = vec![None; poses.len()];
    let moves = match scenario.faults.lab.second_arm {
        SecondArm::None => return nowhere,
        SecondArm::Still => false,
        SecondArm::Moving => true,
    };
    let random = RandomStream::SecondArm.of(scenario.seed);
    let rests = |place: &Transform<Base, Base>, random: Random, poses: &[Pose]| {
        let mut tries = (0..TRIES).map(|turn| posture(body, place, &mut random.at(turn)));
        tries.find(|beside| {
            beside.as_ref().is_some_and(|beside| is_out_of_the_way(beside, body, poses, eye))
        })?
    };
    // One side first, then the other.
    for side in [0, 1] {
        let random = random.at(side);
        let place = place(&mut random.at(u64::MAX), side == 0);
        let found: Vec<Option<Beside>> = match moves {
            false => vec![rests(&place, random, poses); poses.len()],
            true => {
                let one =
                    |(i, pose)| rests(&place, random.at(i as u64), std::slice::from_ref(pose));
                poses.iter().enumerate().map(one).collect()
            }
        };
        if found.iter().any(Option::is_some) {
            return found;
        }
    }
    nowhere
}

/// Somewhere on the table to the left or right, turned as it was put.
fn place(random: &mut Random, first: bool) -> Transform<Base, Base> {
    let way = if (random.uniform() < 0.5) == first { FRAC_PI_2 } else { -FRAC_PI_2 };
    let way = way + random.between(-0.4, 0.4);
    let [near, far] = DISTANCE_M;
    let at = random.between(near, far) * Vector3::new(way.cos(), way.sin(), 0.0);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), random.between(-PI, PI));
    Transform::from_parts(at, turn)
}

/// Any posture that it can rest in.
fn posture(body: &ArmBody, place: &Transform<Base, Base>, random: &mut Random) -> Option<Beside> {
    let posture = body.posture(&body.any_joints(random))?;
    // Of the camera it stays clear by being out of the way.
    let nowhere = Point3::new(0.0, 0.0, 1e3);
    let free = !body.bumps(&posture, &nowhere);
    free.then_some(Beside { base_from_its_base: *place, posture })
}

fn is_out_of_the_way(beside: &Beside, body: &ArmBody, poses: &[Pose], eye: &Point3<f64>) -> bool {
    const CAMERA_CLEARANCE_M: f32 = 0.5;
    let place = beside.base_from_its_base.isometry().cast::<f32>();
    let surface: Vec<Point3<f32>> = body.surface(&beside.posture).map(|p| place * p).collect();
    if surface.iter().any(|p| (p - eye.cast::<f32>()).norm() < CAMERA_CLEARANCE_M) {
        return false;
    }
    let touches = |pose: &Pose| {
        let near = |p| pose.posture.nearest_within(&body.model, p, CLEARANCE_M, 0).is_some();
        surface.iter().any(near)
    };
    if poses.iter().any(touches) {
        return false;
    }
    let scene = RayScene::new(&beside.meshes(body));
    poses.iter().all(|pose| {
        let points: Vec<Point3<f32>> = body.surface(&pose.posture).collect();
        let hidden = scene.visible_from(*eye, &points).iter().filter(|sees| !**sees).count();
        hidden as f64 <= HIDDEN * points.len() as f64
    })
}

impl Beside {
    /// Its links where they are.
    pub(super) fn meshes<'b>(&self, body: &'b ArmBody) -> Vec<SceneMesh<'b>> {
        let posed = body.scene_meshes(&self.posture).into_iter();
        let beside = |link: SceneMesh<'b>| SceneMesh {
            base_from_mesh: self.base_from_its_base * link.base_from_mesh,
            ..link
        };
        posed.map(beside).collect()
    }
}
