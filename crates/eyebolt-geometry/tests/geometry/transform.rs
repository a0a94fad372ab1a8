use crate::strategies::{config, difference, rotation, transform, vector};
use eyebolt_geometry::{Base, Camera, EndEffector, Link, Transform};
use nalgebra::{Matrix4, Point3, UnitQuaternion, Vector3};
use proptest::prelude::*;

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn composition_is_associative(a in transform(), b in transform(), c in transform()) {
        let b = Transform::<Base, EndEffector>::from_isometry(*b.isometry());
        let c = Transform::<EndEffector, Link>::from_isometry(*c.isometry());
        prop_assert!(difference(&((a * b) * c), &(a * (b * c))) < 1e-13);
    }

    #[test]
    fn inverse_undoes_from_both_sides(a in transform()) {
        let camera: Transform<Camera, Camera> = a * a.inverse();
        let base: Transform<Base, Base> = a.inverse() * a;
        prop_assert!(difference(&camera, &Transform::identity()) < 1e-13);
        prop_assert!(difference(&base, &Transform::identity()) < 1e-13);
    }

    #[test]
    fn composition_moves_points_one_after_the_other(
        a in transform(), b in transform(), p in vector(3.0),
    ) {
        let b = Transform::<Base, Link>::from_isometry(*b.isometry());
        let point_in_link = Point3::from(p);
        let at_once = (a * b).point(&point_in_link);
        prop_assert!((at_once - a.point(&b.point(&point_in_link))).norm() < 1e-13);
    }

    #[test]
    fn directions_ignore_the_translation(a in transform(), p in vector(3.0), q in vector(3.0)) {
        let points = a.point(&Point3::from(p)) - a.point(&Point3::from(q));
        prop_assert!((points - a.direction(&(p - q))).norm() < 1e-13);
    }

    #[test]
    fn matrix_and_quaternion_round_trip(a in transform()) {
        let from_matrix = Transform::from_matrix(&a.matrix(), 1e-9).unwrap();
        prop_assert!(difference(&a, &from_matrix) < 1e-12);
        let xyzw = a.rotation_xyzw();
        prop_assert!(xyzw[3] >= 0.0);
        let from_xyzw = Transform::from_xyzw(a.translation_m().into(), xyzw).unwrap();
        prop_assert!(difference(&a, &from_xyzw) < 1e-13);
    }

    #[test]
    fn distance_is_symmetric_and_blind_to_a_common_frame(
        a in transform(), b in transform(), r in rotation(),
    ) {
        let turn = Transform::<Camera, Camera>::from_parts(Vector3::new(1.0, 2.0, 3.0), r);
        let (m, rad) = a.distance_to(&b);
        for (other_m, other_rad) in [b.distance_to(&a), (turn * a).distance_to(&(turn * b))] {
            prop_assert!((m - other_m).abs() < 1e-12);
            prop_assert!((rad - other_rad).abs() < 1e-13);
        }
    }
}

#[test]
fn numbers_that_are_no_rotation_are_refused() {
    assert!(Transform::<Camera, Base>::from_xyzw([0.0; 3], [0.0; 4]).is_none());
    assert!(
        Transform::<Camera, Base>::from_xyzw([f64::NAN, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]).is_none()
    );
    assert!(Transform::<Camera, Base>::from_xyzw([0.0; 3], [f64::NAN, 0.0, 0.0, 1.0]).is_none());
    let mirror = Matrix4::from_diagonal(&[1.0, 1.0, -1.0, 1.0].into());
    assert!(Transform::<Camera, Base>::from_matrix(&mirror, 1e-6).is_none());
    let scale = Matrix4::from_diagonal(&[1.1, 1.1, 1.1, 1.0].into());
    assert!(Transform::<Camera, Base>::from_matrix(&scale, 1e-6).is_none());
    let mut infinite = Matrix4::identity();
    infinite[(0, 3)] = f64::INFINITY;
    assert!(Transform::<Camera, Base>::from_matrix(&infinite, 1e-6).is_none());
}

#[test]
fn debug_names_the_frames() {
    let turned = UnitQuaternion::from_euler_angles(0.0, 0.0, 0.0);
    let a = Transform::<Camera, Base>::from_parts(Vector3::new(1.0, 2.0, 3.0), turned);
    assert!(format!("{a:?}").starts_with("camera_from_base { translation_m: [1, 2, 3]"));
}
