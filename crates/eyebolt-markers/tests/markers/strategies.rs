//! Random values of the kinds that the laws speak of.

use eyebolt_geometry::{Base, CoordinateFrame, EndEffector, Transform, rotation_exp};
use nalgebra::{Unit, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

/// The same cases every time, and no files of failures.
pub fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() }
}

pub fn vector(limit: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-limit..limit, -limit..limit, -limit..limit].prop_map(Vector3::from)
}

fn axis() -> impl Strategy<Value = Unit<Vector3<f64>>> {
    vector(1.0).prop_filter_map("a direction", |v| Unit::try_new(v, 0.1))
}

/// Any rotation, up to half a turn, with a translation.
pub fn transform<A: CoordinateFrame, B: CoordinateFrame>(
    metres: f64,
    radians: std::ops::Range<f64>,
) -> impl Strategy<Value = Transform<A, B>> {
    (vector(metres), axis(), radians).prop_map(|(t, axis, angle)| {
        Transform::from_parts(t, rotation_exp(&(axis.into_inner() * angle)))
    })
}

/// Poses of the hand that differ in all directions.
pub fn poses() -> impl Strategy<Value = Vec<Transform<Base, EndEffector>>> {
    // A smaller failure would be one of poses that are all alike.
    prop::collection::vec(transform(0.5, 0.3..1.4), 4..12).no_shrink()
}
