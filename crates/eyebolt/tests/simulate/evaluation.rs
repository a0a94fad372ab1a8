//! What is said of a calibration against the truth.

use eyebolt::evaluate::{Evaluation, evaluate};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_recording::{CameraMoved, Truth};
use nalgebra::{Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;
use std::collections::BTreeMap;

type Pose = Transform<Camera, Base>;

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-size..size).prop_map(Vector3::from)
}

fn direction() -> impl Strategy<Value = Unit<Vector3<f64>>> {
    let long_enough = vector(1.0).prop_filter("a direction", |v| v.norm() > 0.1);
    long_enough.prop_map(Unit::new_normalize)
}

fn pose() -> impl Strategy<Value = Pose> {
    (vector(2.0), direction(), 0.0..3.1_f64).prop_map(|(translation, axis, angle)| {
        Transform::from_parts(translation, UnitQuaternion::from_axis_angle(&axis, angle))
    })
}

proptest! {
    #[test]
    fn nothing_is_off_by_nothing(pose in pose()) {
        let Evaluation { translation_mm, rotation_deg, camera_position_mm } =
            Evaluation::of(&pose, &pose);
        prop_assert!(translation_mm == 0.0 && rotation_deg < 1e-5 && camera_position_mm < 1e-9);
    }

    /// The order is that of the arguments of a distance.
    #[test]
    fn it_is_symmetric(a in pose(), b in pose()) {
        let (ab, ba) = (Evaluation::of(&a, &b), Evaluation::of(&b, &a));
        prop_assert!((ab.translation_mm - ba.translation_mm).abs() < 1e-9);
        prop_assert!((ab.rotation_deg - ba.rotation_deg).abs() < 1e-5);
        prop_assert!((ab.camera_position_mm - ba.camera_position_mm).abs() < 1e-9);
    }

    /// A shift of the base in the camera's frame moves both as far; a turn about the camera moves
    /// the base alone, and a turn about the base the camera alone.
    #[test]
    fn known_errors_are_found(pose in pose(), shift in vector(0.1), axis in direction(), angle in 0.01..1.5_f64) {
        let turn = UnitQuaternion::from_axis_angle(&axis, angle);
        let shifted = Transform::from_parts(pose.translation_m() + shift, pose.rotation());
        let found = Evaluation::of(&shifted, &pose);
        prop_assert!((found.translation_mm - 1e3 * shift.norm()).abs() < 1e-9);
        prop_assert!((found.camera_position_mm - 1e3 * shift.norm()).abs() < 1e-9);
        prop_assert!(found.rotation_deg < 1e-5);

        let about_base: Transform<Base, Base> = Transform::from_parts(Vector3::zeros(), turn);
        let found = Evaluation::of(&(pose * about_base), &pose);
        prop_assert!(found.translation_mm < 1e-9);
        prop_assert!((found.rotation_deg - angle.to_degrees()).abs() < 1e-6);

        let about_camera: Transform<Camera, Camera> = Transform::from_parts(Vector3::zeros(), turn);
        let found = Evaluation::of(&(about_camera * pose), &pose);
        prop_assert!(found.camera_position_mm < 1e-9);
        prop_assert!((found.rotation_deg - angle.to_degrees()).abs() < 1e-6);
    }

    #[test]
    fn every_pose_of_the_camera_is_compared_in_order(poses in prop::collection::vec(pose(), 1..4)) {
        let (first, later) = poses.split_first().unwrap();
        let moved = later.iter().zip(1..).map(|(pose, stamp_ns)| CameraMoved {
            stamp_ns,
            camera_from_base: *pose,
        });
        let truth = Truth {
            base: "link0".to_owned(),
            robot: "shackle".to_owned(),
            sensor: "ideal".to_owned(),
            preset: None,
            seed: 1,
            camera_from_base: *first,
            camera_from_base_after: moved.collect(),
            faults: BTreeMap::new(),
        };
        let last = poses.last().unwrap();
        let expected: Vec<_> = poses.iter().map(|pose| Evaluation::of(last, pose)).collect();
        prop_assert_eq!(evaluate(last, &truth), expected);
    }
}
