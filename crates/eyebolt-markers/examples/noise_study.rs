//! Two hundred hand-eye problems with noise of 0.3 px, solved by all solvers and refined: a line of JSON for
//! each, which `noise_study.py` solves again by OpenCV and compares.

#![allow(clippy::print_stdout, reason = "its output is what it is for")]

#[path = "../tests/markers/noise.rs"]
mod noise;

use eyebolt_geometry::{
    Base, Camera, CoordinateFrame, Distortion, EndEffector, PinholeCamera, Transform, rotation_exp,
};
use eyebolt_markers::hand_eye::{HandEye, PosePair, Solver, View, refine, solve};
use eyebolt_markers::{Correspondence, Marker, planar_poses};
use nalgebra::{Point3, Vector2, Vector3};
use noise::{noise, normal};
use serde_json::{Value, json};
use std::f64::consts::PI;

const PROBLEMS: u64 = 200;
const SIGMA_PX: f64 = 0.3;
const SIDE_M: f64 = 0.08;

/// Where everything is in one problem.
struct Problem {
    truth: HandEye<Base, EndEffector>,
    robot: Vec<Transform<Base, EndEffector>>,
}

/// A camera anywhere around an arm, and 5 to 20 poses that hold a tag towards it, give or take 40 degrees.
fn problem(seed: u64) -> Problem {
    let n = |place: u64| noise(seed, place);
    let around = PI * n(0);
    let base_from_camera: Transform<Base, Camera> = {
        let eye = Vector3::new(1.2 * around.cos(), 1.2 * around.sin(), 0.6 + 0.4 * n(1));
        let aim = Vector3::new(0.3 * around.cos(), 0.3 * around.sin(), 0.4) - eye;
        let z = aim.normalize();
        let x = z.cross(&Vector3::z()).normalize();
        let axes = nalgebra::Matrix3::from_columns(&[x, z.cross(&x), z]);
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(axes);
        Transform::from_parts(eye, nalgebra::UnitQuaternion::from_rotation_matrix(&rotation))
    };
    let mount = rotation_exp(&(Vector3::new(n(2), n(3), n(4)).normalize() * (PI * n(5))));
    let carrier_from_marker =
        Transform::from_parts(Vector3::new(0.05 * n(6), 0.05 * n(7), 0.1 + 0.05 * n(8)), mount);
    let camera_from_root = base_from_camera.inverse();
    let poses = 5 + (seed % 16) as usize;
    let robot = (0..poses as u64).map(|i| {
        let n = |place: u64| noise(seed, 100 + 10 * i + place);
        let tilt = rotation_exp(&(Vector3::new(n(0), n(1), 0.0) * 0.7))
            * rotation_exp(&(Vector3::z() * (1.5 * n(2))));
        let z = 0.9 + 0.3 * n(3);
        let at = Vector3::new(0.25 * n(4) * z, 0.2 * n(5) * z, z);
        let camera_from_marker: Transform<Camera, Marker> = Transform::from_parts(at, tilt);
        base_from_camera * camera_from_marker * carrier_from_marker.inverse()
    });
    Problem { robot: robot.collect(), truth: HandEye { camera_from_root, carrier_from_marker } }
}

fn camera() -> PinholeCamera {
    PinholeCamera::new(640, 480, 600.0, 600.0, 319.5, 239.5, Distortion::None).expect("a camera")
}

fn view(seed: u64, index: usize, problem: &Problem) -> Option<View<Base, EndEffector>> {
    let root_from_carrier = *problem.robot.get(index)?;
    let pose = problem.truth.camera_from_marker(&root_from_carrier);
    let half = 0.5 * SIDE_M;
    let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
    let points = corners.iter().enumerate().map(|(k, (x, y))| {
        let point_in_marker = Point3::new(*x, *y, 0.0);
        let place = (1000 * (index + 1) + 2 * k) as u64;
        let error = Vector2::new(normal(seed, place), normal(seed, place + 1)) * SIGMA_PX;
        let pixel = camera().project(&pose.point(&point_in_marker))? + error;
        Some(Correspondence { point_in_marker, pixel })
    });
    let points: Vec<_> = points.collect::<Option<_>>()?;
    let poses = planar_poses(&points, &camera());
    Some(View { root_from_carrier, points, poses })
}

fn rows<A: CoordinateFrame, B: CoordinateFrame>(pose: &Transform<A, B>) -> Value {
    let matrix = pose.matrix();
    json!([0, 1, 2, 3].map(|r| [0, 1, 2, 3].map(|c| matrix[(r, c)])))
}

/// How far the camera is from where it is, millimetres and degrees.
fn off(answer: &HandEye<Base, EndEffector>, truth: &HandEye<Base, EndEffector>) -> [f64; 2] {
    let (found, right) = (answer.camera_from_root.inverse(), truth.camera_from_root.inverse());
    let (metres, radians) = found.distance_to(&right);
    [1e3 * metres, radians.to_degrees()]
}

fn main() {
    for seed in 0..PROBLEMS {
        let problem = problem(seed);
        let views: Vec<_> =
            (0..problem.robot.len()).filter_map(|index| view(seed, index, &problem)).collect();
        let pairs: Vec<_> = views
            .iter()
            .filter_map(|view| {
                let camera_from_marker = view.poses.first()?.camera_from_marker;
                Some(PosePair { root_from_carrier: view.root_from_carrier, camera_from_marker })
            })
            .collect();
        let mut errors = serde_json::Map::new();
        let mut best: Option<(f64, HandEye<Base, EndEffector>)> = None;
        for solver in Solver::ALL {
            let Ok(answer) = solve(solver, &pairs) else { continue };
            errors.insert(solver.name().to_owned(), json!(off(&answer, &problem.truth)));
            if let Some(refined) = refine(&views, &camera(), &answer)
                && best.is_none_or(|(sigma_px, _)| refined.sigma_px < sigma_px)
            {
                best = Some((refined.sigma_px, refined.hand_eye));
            }
        }
        if let Some((_, answer)) = best {
            errors.insert("refined".to_owned(), json!(off(&answer, &problem.truth)));
        }
        let pair = |pair: &PosePair<Base, EndEffector>| {
            json!([rows(&pair.root_from_carrier), rows(&pair.camera_from_marker)])
        };
        let line = json!({
            "base_from_camera": rows(&problem.truth.camera_from_root.inverse()),
            "pairs": pairs.iter().map(pair).collect::<Vec<_>>(),
            "errors_mm_deg": errors,
        });
        println!("{line}");
    }
}
