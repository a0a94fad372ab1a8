//! Things put where they neither touch the arm nor hide it.

use super::body::ArmBody;
use super::configurations::Pose;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use super::scene::{clutter, passer_by};
use super::solids::Solid;
use eyebolt_geometry::Transform;
use eyebolt_render::{Random, RayScene, SceneMesh};
use nalgebra::Point3;
use rayon::prelude::*;

/// Places tried for each thing; a small table may have no room for all.
const TRIES: u64 = 30;
/// Of the arm's surface in one configuration, a thing hides no more than this.
const HIDDEN: f64 = 0.04;
/// Nothing stands nearer to the camera, metres.
const CAMERA_CLEARANCE_M: f64 = 0.5;

/// The clutter of `scenario`, out of the way of the arm in `poses` as seen from `eye` (base frame).
pub(super) fn clutter_about(
    scenario: &Scenario<'_>,
    body: &ArmBody,
    poses: &[Pose],
    eye: &Point3<f64>,
) -> Vec<Solid> {
    let random = RandomStream::Clutter.of(scenario.seed);
    let fits = |solid: &Solid| is_out_of_the_way(solid, body, poses, eye);
    put(scenario.clutter, random, body.table_above_usual_m(), clutter, fits)
}

/// Those who pass by while the arm of `scenario` rests in each of `poses`.
pub(super) fn passers_by(
    scenario: &Scenario<'_>,
    body: &ArmBody,
    poses: &[Pose],
    eye: &Point3<f64>,
) -> Vec<Vec<Solid>> {
    let random = RandomStream::PassersBy.of(scenario.seed);
    let of_pose = |(index, pose): (usize, &Pose)| {
        let fits = |solid: &Solid| is_out_of_the_way(solid, body, std::slice::from_ref(pose), eye);
        let (count, random) = (scenario.faults.lab.passers_by, random.at(index as u64));
        put(count, random, body.table_above_usual_m(), passer_by, fits)
    };
    poses.iter().enumerate().map(of_pose).collect()
}

/// As many things as there is room for, of `count` that `draw` makes, higher by `above_m`.
fn put(
    count: usize,
    random: Random,
    above_m: f64,
    draw: fn(&mut Random) -> Solid,
    fits: impl Fn(&Solid) -> bool + Sync,
) -> Vec<Solid> {
    let things = (0..count as u64).into_par_iter().filter_map(|thing| {
        let mut tries =
            (0..TRIES).map(|place| draw(&mut random.at(thing).at(place)).raised(above_m));
        tries.find(&fits)
    });
    things.collect()
}

fn is_out_of_the_way(solid: &Solid, body: &ArmBody, poses: &[Pose], eye: &Point3<f64>) -> bool {
    let far = |vertex: &Point3<f32>| (vertex.cast::<f64>() - eye).norm() > CAMERA_CLEARANCE_M;
    if !solid.mesh.vertices.iter().all(far) {
        return false;
    }
    let scene = RayScene::new(&[in_place(solid)]);
    poses.iter().all(|pose| {
        let points: Vec<Point3<f32>> = body.surface(&pose.posture).collect();
        let hidden = || scene.visible_from(*eye, &points).iter().filter(|sees| !**sees).count();
        body.is_clear_of(&pose.posture, solid) && hidden() as f64 <= HIDDEN * points.len() as f64
    })
}

/// `solid` as a part of a scene.
pub(super) fn in_place(solid: &Solid) -> SceneMesh<'_> {
    // Its coordinates are those of the base already.
    SceneMesh { mesh: &solid.mesh, base_from_mesh: Transform::identity() }
}
