//! Random values of the kinds that the laws speak of.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

/// The same cases every time, and no files of failures.
pub fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Config::default() }
}

pub fn vector(limit: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-limit..limit, -limit..limit, -limit..limit].prop_map(Vector3::from)
}

pub fn point(limit: f32) -> impl Strategy<Value = Point3<f32>> {
    [-limit..limit, -limit..limit, -limit..limit].prop_map(Point3::from)
}

pub fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    vector(2.5).prop_map(UnitQuaternion::new)
}

pub fn isometry(limit: f64) -> impl Strategy<Value = Isometry3<f64>> {
    (vector(limit), rotation()).prop_map(|(t, r)| Isometry3::from_parts(Translation3::from(t), r))
}

/// What `task` gives in a pool of so many threads.
pub fn on_threads<T: Send>(threads: usize, task: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(task)
}
