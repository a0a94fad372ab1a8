//! Random values of the kinds that the laws speak of.

use eyebolt_geometry::{Base, Camera, Tangent, Transform, rotation_exp};
use nalgebra::{Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use std::f64::consts::PI;

/// The same cases every time, and no files of failures.
pub fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() }
}

pub fn vector(limit: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-limit..limit, -limit..limit, -limit..limit].prop_map(Vector3::from)
}

pub fn axis() -> impl Strategy<Value = Unit<Vector3<f64>>> {
    vector(1.0).prop_filter_map("a direction", |v| Unit::try_new(v, 0.1))
}

/// Angles that cover the middle, both ends and the way to them.
pub fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![
        0.0..PI,
        (-18.0..0.0).prop_map(|e| 10_f64.powf(e)),
        (-9.0..0.0).prop_map(|e| PI - 10_f64.powf(e)),
        Just(0.0),
    ]
}

/// Vectors along every axis with a length from [`angle`].
pub fn rotation_vector() -> impl Strategy<Value = Vector3<f64>> {
    (axis(), angle()).prop_map(|(axis, angle)| axis.into_inner() * angle)
}

pub fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    rotation_vector().prop_map(|v| rotation_exp(&v))
}

/// Translations up to 2 m with a rotation vector from [`rotation_vector`].
pub fn tangent() -> impl Strategy<Value = Tangent> {
    (vector(2.0), rotation_vector()).prop_map(|(t, r)| Tangent::new(t.x, t.y, t.z, r.x, r.y, r.z))
}

pub fn transform() -> impl Strategy<Value = Transform<Camera, Base>> {
    (vector(2.0), rotation()).prop_map(|(t, r)| Transform::from_parts(t, r))
}

/// Largest difference between the entries of the two matrices.
pub fn difference<A: eyebolt_geometry::CoordinateFrame, B: eyebolt_geometry::CoordinateFrame>(
    a: &Transform<A, B>,
    b: &Transform<A, B>,
) -> f64 {
    (a.matrix() - b.matrix()).amax()
}

/// The other quaternion of the same rotation.
pub fn negated(q: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(-q.into_inner())
}

/// The same for rotations.
pub fn rotation_difference(a: &UnitQuaternion<f64>, b: &UnitQuaternion<f64>) -> f64 {
    (a.to_rotation_matrix().matrix() - b.to_rotation_matrix().matrix()).amax()
}
