//! Things around the arm: beside it, and not between it and the camera.

use crate::shapes;
use crate::stage::{ARM, Recorded, SENSOR, planned, small};
use eyebolt::simulate::{Plan, Scenario};
use eyebolt_geometry::{Base, Camera, Link, Transform};
use eyebolt_render::{IdealView, RayScene, SceneMesh};
use eyebolt_robot::{JointPositions, Prefer, TriangleMesh, link_mesh};
use nalgebra::Point3;

const SEEDS: [u64; 2] = [31, 32];
const CLUTTER: usize = 8;

fn cluttered(seed: u64) -> Plan<'static> {
    planned(Scenario { clutter: CLUTTER, configurations: 3, frames: 1, seed, ..small() })
}

#[test]
fn things_stand_clear_of_the_arm_and_the_camera() {
    let mut things = 0;
    for seed in SEEDS {
        let plan = cluttered(seed);
        let eye = plan.camera_from_base().inverse().point(&Point3::origin());
        let poses = Recorded::of_plan(&plan).joints();
        for solid in plan.solids().iter().skip(shapes::ROOM) {
            things += 1;
            let vertices = || solid.mesh.vertices.iter().map(|vertex| vertex.cast::<f64>());
            assert!(vertices().all(|vertex| (vertex - eye).norm() > 0.4));
            for joints in &poses {
                let arm = shapes::arm(joints);
                let distances = vertices().flat_map(|v| arm.iter().map(move |a| a.distance_m(&v)));
                let least = distances.fold(f64::INFINITY, f64::min);
                assert!(least > 0.01, "{least} m");
            }
        }
    }
    assert!(things > CLUTTER * SEEDS.len() / 2, "{things}");
}

/// The arm's meshes where `joints` put them.
fn posed<'a>(meshes: &'a [TriangleMesh], joints: &JointPositions) -> Vec<SceneMesh<'a>> {
    let poses = ARM.link_poses(joints).unwrap();
    let posed = meshes.iter().zip(poses);
    posed.map(|(mesh, pose)| SceneMesh { mesh, base_from_mesh: pose.unwrap() }).collect()
}

/// Pixels of the arm, and of its hand.
fn pixels(meshes: &[SceneMesh<'_>], base_from_camera: &Transform<Base, Camera>) -> [usize; 2] {
    let view: IdealView = RayScene::new(meshes).view(&SENSOR.camera(), base_from_camera);
    let links = ARM.robot().links.len();
    let hand = ARM.end_effector_links();
    let arm = view.surface.iter().map(|surface| usize::from(*surface)).filter(|at| *at < links);
    let arm: Vec<usize> = arm.collect();
    [arm.len(), arm.iter().filter(|link| hand.contains(link)).count()]
}

#[test]
fn things_hide_little_of_the_arm() {
    let links = ARM.robot().links.iter();
    let meshes: Vec<TriangleMesh> =
        links.map(|link| link_mesh(link, Prefer::Visual).unwrap().unwrap()).collect();
    for seed in SEEDS {
        let plan = cluttered(seed);
        let base_from_camera = plan.camera_from_base().inverse();
        for joints in Recorded::of_plan(&plan).joints() {
            let arm = posed(&meshes, &joints);
            let in_base: Transform<Base, Link> = Transform::from_parts(
                nalgebra::Vector3::zeros(),
                nalgebra::UnitQuaternion::identity(),
            );
            let around =
                plan.solids().iter().map(|s| SceneMesh { mesh: &s.mesh, base_from_mesh: in_base });
            let scene: Vec<_> = arm.iter().copied().chain(around).collect();
            let [all, hand] = pixels(&arm, &base_from_camera);
            let [all_seen, hand_seen] = pixels(&scene, &base_from_camera);
            let shares = [all_seen as f64 / all as f64, hand_seen as f64 / hand as f64];
            assert!(shares[0] > 0.75 && hand_seen > 80, "{seed}: {shares:?} {hand_seen}");
        }
    }
}
