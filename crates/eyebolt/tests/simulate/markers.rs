//! The baseline with a marker, from simulated pictures to a verdict.

use crate::stage::{ARM, CACHE, SENSOR, planned, small};
use eyebolt::calibrate::Limits;
use eyebolt::markers::{
    EyeInHand, EyeToHand, MarkerCalibration, MarkerFailure, MarkerObservations, MarkerReason,
    MarkerRequest, calibrate, difference, follow, observe,
};
use eyebolt::pipeline::Request;
use eyebolt::simulate::{Plan, Scenario};
use eyebolt_geometry::{Camera, DepthImage, EndEffector, Transform, rotation_exp};
use eyebolt_markers::{Marker, Target};
use eyebolt_recording::{ColorImage, FrameSource, InMemory};
use eyebolt_render::{Mode, Random, Sensor};
use eyebolt_robot::JointPositions;
use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};

/// A camera as many have it, without errors of depth.
const CAMERA: Sensor =
    Sensor { mode: Mode { width: 640, height: 480, focal_px: 525.0 }, ..Sensor::IDEAL };

fn target(text: &str) -> Target {
    text.parse().unwrap()
}

fn request<'a>(source: &'a dyn FrameSource, text: &str) -> MarkerRequest<'a> {
    let (target, limits) = (target(text), Limits::default());
    MarkerRequest { source, arm: &ARM, target, limits, most_configurations: 60 }
}

fn seen(source: &dyn FrameSource, text: &str) -> MarkerObservations {
    observe(&request(source, text), &()).unwrap()
}

fn session(text: &str, configurations: usize) -> Plan<'static> {
    let scenario = Scenario { sensor: CAMERA, configurations, frames: 2, ..small() };
    planned(scenario).with_marker(&target(text))
}

#[test]
fn a_tag_on_the_hand_tells_the_camera() {
    let plan = session("aruco:4x4_50:0.08", 16);
    let source = plan.in_memory().unwrap();
    let observations = seen(&source, "aruco:4x4_50:0.08");
    assert_eq!(observations.target.to_string(), "aruco:4x4_50:0.08:0");
    let calibration: MarkerCalibration<EyeToHand> = calibrate(&observations, &Limits::default());
    assert_eq!(calibration.reasons, [], "{:?}", calibration.error);
    let (answer, error) = (calibration.camera_from_root.unwrap(), calibration.error.unwrap());
    let truth = plan.camera_from_base();
    let at = plan.workspace_in_base();
    let off = (answer.point(&at) - truth.point(&at)).norm();
    assert!(off < 0.008 && off < 3.0 * error.expected.translation_m, "{off} m, {error:?}");
    let turned = answer.rotation().angle_to(&truth.rotation()).to_degrees();
    assert!(turned < 0.5 && turned < 3.0 * error.expected.rotation_rad.to_degrees(), "{turned}");
    let refined = calibration.refined.unwrap();
    let mount = plan.end_effector_from_marker().unwrap();
    let (metres, _) = refined.hand_eye.carrier_from_marker.distance_to(&mount);
    assert!(metres < 0.010 && refined.size_error.abs() < 0.01, "{metres} m, {refined:?}");

    // The arm's own shape goes on from there: the plate is not in its description.
    let without = Request { cache: CACHE.clone(), ..Request::new(&source, &ARM) };
    let outcome = follow(&without, &answer, &()).unwrap();
    let apart = difference(&outcome, &answer, &at).unwrap();
    assert!(apart.translation_m < 0.01, "{apart:?}");
}

#[test]
fn what_is_not_there_is_refused_with_the_reason() {
    let plan = session("aruco:4x4_50:0.08", 5);
    let source = plan.in_memory().unwrap();
    let observations = seen(&source, "aruco:5x5_100:0.08");
    let calibration: MarkerCalibration<EyeToHand> = calibrate(&observations, &Limits::default());
    let none = MarkerReason::FewViews { seen: 0, configurations: 5, needed: 4 };
    assert_eq!(calibration.reasons, [none]);
    assert!(calibration.camera_from_root.is_none());
    // Nobody needs colour where there is no marker.
    let plain = planned(small()).in_memory().unwrap();
    let error = observe(&request(&plain, "aruco:4x4_50:0.05"), &()).unwrap_err();
    assert!(matches!(error, MarkerFailure::NoPictures), "{error}");
}

/// Pictures from a camera on the hand, of a target that lies on the table.
fn from_the_hand(
    target: &Target,
    camera_from_end_effector: &Transform<Camera, EndEffector>,
    configurations: u64,
) -> InMemory {
    let camera = SENSOR.camera();
    let mut source = InMemory::new(camera.clone());
    let home = [0.0, -0.3, 0.0, -2.2, 0.0, 2.0, 0.8];
    let joints = |random: &mut Random| -> JointPositions {
        let turned = home.iter().map(|q| q + random.between(-0.22, 0.22));
        ARM.required_joints().iter().zip(turned).map(|(name, q)| ((*name).to_owned(), q)).collect()
    };
    let middle = joints(&mut Random::new(0));
    // Where the camera at home looks at, half a metre before it.
    let marker = {
        let base_from_camera =
            ARM.base_from_end_effector(&middle).unwrap() * camera_from_end_effector.inverse();
        let (wide, high) = target.size_m();
        let at = Vector3::new(-0.5 * wide, -0.5 * high, 0.5);
        base_from_camera * Transform::<Camera, Marker>::from_parts(at, UnitQuaternion::identity())
    };
    for index in 0..configurations {
        let joints = joints(&mut Random::new(index));
        let base_from_camera =
            ARM.base_from_end_effector(&joints).unwrap() * camera_from_end_effector.inverse();
        let marker_from_camera = marker.inverse() * base_from_camera;
        let (eye, parts) = (marker_from_camera.point(&Point3::origin()), [-0.25, 0.25]);
        let tone = |u: f64, v: f64| {
            let ray = marker_from_camera.direction(&camera.ray(&Point2::new(u, v)).unwrap());
            let at = eye + ray * (-eye.z / ray.z);
            match target.is_white_at(at.x, at.y) {
                Some(true) => 220.0,
                Some(false) => 25.0,
                None => 110.0,
            }
        };
        let pixel = |place: usize| {
            let (u, v) = ((place % 320) as f64, (place / 320) as f64);
            let all = parts.iter().flat_map(|dv| parts.iter().map(move |du| (du, dv)));
            [(all.map(|(du, dv)| tone(u + du, v + dv)).sum::<f64>() / 4.0) as u8; 3]
        };
        let rgb = (0..320 * 240).map(pixel).collect();
        let depth = DepthImage::new(320, 240, vec![0.5; 320 * 240]).unwrap();
        source.push(format!("{index}"), depth, joints).unwrap();
        source.set_color(index as usize, ColorImage { width: 320, height: 240, rgb }).unwrap();
    }
    source
}

#[test]
fn a_camera_on_the_hand_is_told_by_a_board_on_the_table() {
    let mount = Transform::from_parts(
        Vector3::new(0.02, -0.05, 0.04),
        rotation_exp(&Vector3::new(0.1, -0.2, 0.7)),
    );
    for text in ["charuco:4x4_50:6x5:0.04:0.03", "grid:36h11:3x2:0.06:0.015"] {
        let source = from_the_hand(&target(text), &mount, 12);
        let observations = seen(&source, text);
        let calibration: MarkerCalibration<EyeInHand> =
            calibrate(&observations, &Limits::default());
        assert_eq!(calibration.reasons, [], "{text}: {:?}", calibration.error);
        let (metres, radians) = calibration.camera_from_root.unwrap().distance_to(&mount);
        assert!(metres < 0.003 && radians < 0.005, "{text}: {metres} m, {radians} rad");
        // The marker is not on the hand: taken to be there, nothing fits.
        let other: MarkerCalibration<EyeToHand> = calibrate(&observations, &Limits::default());
        assert!(!other.reasons.is_empty(), "{text}: {:?}", other.error);
    }
}

#[test]
fn pictures_in_a_file_are_those_in_memory() {
    let plan = session("apriltag:36h11:0.08:3", 2);
    let recorded = crate::stage::Recorded::of_plan(&plan);
    let memory = plan.in_memory().unwrap();
    for index in 0..4 {
        let picture = recorded.recording.read_picture(index).unwrap().unwrap();
        assert_eq!(Some(picture), memory.read_picture(index).unwrap());
    }
}
