use crate::strategies::{
    axis, config, difference, negated, rotation, rotation_difference, rotation_vector, tangent,
    transform, vector,
};
use eyebolt_geometry::{
    Base, Camera, Tangent, Transform, left_jacobian, rotation_exp, rotation_left_jacobian,
    rotation_left_jacobian_inverse, rotation_log,
};
use nalgebra::{Matrix3, Matrix6, Vector3};
use proptest::prelude::*;
use std::f64::consts::PI;

type CameraFromBase = Transform<Camera, Base>;

proptest! {
    #![proptest_config(config(512))]

    #[test]
    fn rotation_log_undoes_exp(v in rotation_vector()) {
        let back = rotation_log(&rotation_exp(&v));
        prop_assert!((back - v).norm() < 2e-15, "{:e}", (back - v).norm());
    }

    #[test]
    fn small_rotations_keep_their_digits(axis in axis(), exponent in -300.0..-4.0_f64) {
        let v = axis.into_inner() * 10_f64.powf(exponent);
        let back = rotation_log(&rotation_exp(&v));
        prop_assert!((back - v).norm() <= 1e-14 * v.norm());
    }

    #[test]
    fn rotation_exp_undoes_log(q in rotation()) {
        let v = rotation_log(&q);
        prop_assert!(v.norm() <= PI);
        prop_assert!(rotation_difference(&rotation_exp(&v), &q) < 1e-14);
        prop_assert_eq!(rotation_log(&negated(&q)), v);
    }

    #[test]
    fn exp_of_twice_is_exp_twice(v in rotation_vector()) {
        let once = rotation_exp(&v);
        prop_assert!(rotation_difference(&rotation_exp(&(v * 2.0)), &(once * once)) < 1e-14);
    }

    #[test]
    fn log_undoes_exp(t in tangent()) {
        prop_assume!(t.fixed_rows::<3>(3).norm() < PI - 1e-8);
        let back = CameraFromBase::exp(&t).log();
        prop_assert!((back - t).norm() < 1e-12, "{:e}", (back - t).norm());
    }

    #[test]
    fn exp_undoes_log(a in transform()) {
        prop_assert!(difference(&CameraFromBase::exp(&a.log()), &a) < 1e-13);
    }

    #[test]
    fn exp_of_minus_is_the_inverse(t in tangent()) {
        let (there, back) = (CameraFromBase::exp(&t), Transform::<Base, Camera>::exp(&-t));
        prop_assert!(difference(&there.inverse(), &back) < 1e-13);
    }

    #[test]
    fn adjoint_moves_tangents(a in transform(), t in tangent()) {
        let conjugated = a * Transform::<Base, Base>::exp(&t) * a.inverse();
        let moved = Transform::<Camera, Camera>::exp(&(a.adjoint() * t));
        prop_assert!(difference(&conjugated, &moved) < 1e-12);
    }

    #[test]
    fn adjoint_of_a_product_is_the_product(a in transform(), b in transform()) {
        let b = Transform::<Base, Camera>::from_isometry(*b.isometry());
        let product = a.adjoint() * b.adjoint();
        prop_assert!(((a * b).adjoint() - product).amax() < 1e-13);
    }

    #[test]
    fn retract_undoes_local(a in transform(), b in transform()) {
        prop_assert!(difference(&a.retract(&a.local(&b)), &b) < 1e-13);
    }

    #[test]
    fn local_undoes_retract(a in transform(), t in tangent()) {
        prop_assume!(t.fixed_rows::<3>(3).norm() < PI - 1e-8);
        prop_assert!((a.local(&a.retract(&t)) - t).norm() < 1e-13);
    }

    #[test]
    fn retract_turns_about_the_origin_of_from(a in transform(), r in rotation_vector()) {
        let moved = a.retract(&Tangent::new(0.0, 0.0, 0.0, r.x, r.y, r.z));
        prop_assert_eq!(moved.translation_m(), a.translation_m());
        let expected = rotation_exp(&r) * a.rotation();
        prop_assert!(rotation_difference(&moved.rotation(), &expected) < 1e-14);
    }

    #[test]
    fn left_jacobian_of_rotations_is_the_derivative(v in rotation_vector()) {
        let mut numeric = Matrix3::zeros();
        for axis in 0..3 {
            let step = Vector3::ith(axis, 1e-5);
            let back = rotation_exp(&v).inverse();
            let ahead = rotation_log(&(rotation_exp(&(v + step)) * back));
            let behind = rotation_log(&(rotation_exp(&(v - step)) * back));
            numeric.set_column(axis, &((ahead - behind) / 2e-5));
        }
        prop_assert!((numeric - rotation_left_jacobian(&v)).amax() < 1e-9);
    }

    #[test]
    fn inverse_jacobian_is_the_inverse(v in rotation_vector()) {
        let product = rotation_left_jacobian(&v) * rotation_left_jacobian_inverse(&v);
        prop_assert!((product - Matrix3::identity()).amax() < 1e-14);
    }

    #[test]
    fn left_jacobian_is_the_derivative(t in tangent()) {
        let back = CameraFromBase::exp(&t).inverse();
        let mut numeric = Matrix6::zeros();
        for axis in 0..6 {
            let step = Tangent::ith(axis, 1e-5);
            let ahead = (CameraFromBase::exp(&(t + step)) * back).log();
            let behind = (CameraFromBase::exp(&(t - step)) * back).log();
            numeric.set_column(axis, &((ahead - behind) / 2e-5));
        }
        prop_assert!((numeric - left_jacobian(&t)).amax() < 2e-9);
    }

    #[test]
    fn jacobians_are_smooth_where_the_series_end(axis in axis(), t in vector(2.0)) {
        let at = |angle: f64| {
            let r = axis.into_inner() * angle;
            left_jacobian(&Tangent::new(t.x, t.y, t.z, r.x, r.y, r.z))
        };
        prop_assert!((at(0.5 - 1e-15) - at(0.5 + 1e-15)).amax() < 1e-13);
    }
}

#[test]
fn half_a_turn_has_a_log_of_length_pi() {
    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
        let log = rotation_log(&rotation_exp(&(axis * PI)));
        assert!((log.norm() - PI).abs() < 1e-15 && (log.dot(&axis).abs() - PI).abs() < 1e-15);
    }
}

#[test]
fn a_screw_about_z_is_known() {
    // A quarter turn about z while moving 1 along the turning x ends at (2, 2) / pi.
    let moved = CameraFromBase::exp(&Tangent::new(1.0, 0.0, 0.0, 0.0, 0.0, PI / 2.0));
    let expected = Vector3::new(2.0 / PI, 2.0 / PI, 0.0);
    assert!((moved.translation_m() - expected).norm() < 1e-15);
}
