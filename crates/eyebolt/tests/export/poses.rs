//! Random poses, and poses put together by hand.

use eyebolt::export::{FrameName, Named, Placement};
use eyebolt_geometry::Transform;
use nalgebra::{Matrix4, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use std::f64::consts::{FRAC_PI_2, PI};

/// The same cases every time, and no files of failures.
pub fn config(cases: u32) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(11), failure_persistence: None, ..Config::default() }
}

pub fn placement(parent: &str, child: &str, pose: Transform<Named, Named>) -> Placement {
    Placement {
        parent: FrameName::new(parent).unwrap(),
        child: FrameName::new(child).unwrap(),
        parent_from_child: pose,
        end_effector: FrameName::new("hand").unwrap(),
        child_is_optical: true,
        notes: Vec::new(),
    }
}

/// Rotations of all kinds: any, by small angles, by half turns, about one axis only, and with a pitch
/// of a right angle or near it.
pub fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    let axis = [-1.0..1.0, -1.0..1.0, -1.0..1.0_f64]
        .prop_filter_map("a direction", |v| Unit::try_new(Vector3::from(v), 0.1));
    let angle = prop_oneof![0.0..PI, (-17.0..0.0).prop_map(|e| 10_f64.powf(e)), Just(PI)];
    let free =
        (axis, angle).prop_map(|(axis, angle)| UnitQuaternion::from_axis_angle(&axis, angle));
    let right = prop_oneof![Just(0.0), (-17.0..-1.0).prop_map(|e| 10_f64.powf(e))];
    let locked = (-PI..PI, right, any::<bool>(), -PI..PI).prop_map(|(roll, off, up, yaw)| {
        let pitch = if up { FRAC_PI_2 - off } else { off - FRAC_PI_2 };
        let about = UnitQuaternion::from_axis_angle;
        about(&Vector3::z_axis(), yaw)
            * about(&Vector3::y_axis(), pitch)
            * about(&Vector3::x_axis(), roll)
    });
    let quarter = (0..4_u8, 0..4_u8, 0..4_u8).prop_map(|turns| {
        let turn =
            |axis, turns| UnitQuaternion::from_axis_angle(&axis, f64::from(turns) * FRAC_PI_2);
        turn(Vector3::z_axis(), turns.0)
            * turn(Vector3::y_axis(), turns.1)
            * turn(Vector3::x_axis(), turns.2)
    });
    prop_oneof![3 => free, 3 => locked, 1 => quarter]
}

pub fn pose() -> impl Strategy<Value = Transform<Named, Named>> {
    let metres = || prop_oneof![-3.0..3.0, -1e-12..1e-12, Just(0.0), Just(-2.0), -5e3..5e3_f64];
    ([metres(), metres(), metres()], rotation())
        .prop_map(|(t, r)| Transform::from_parts(Vector3::from(t), r))
}

/// Homogeneous matrix of a translation and a unit quaternion, by the textbook.
pub fn of_quaternion([x, y, z]: [f64; 3], [qx, qy, qz, qw]: [f64; 4]) -> Matrix4<f64> {
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        1.0 - 2.0 * (qy * qy + qz * qz), 2.0 * (qx * qy - qz * qw), 2.0 * (qx * qz + qy * qw), x,
        2.0 * (qx * qy + qz * qw), 1.0 - 2.0 * (qx * qx + qz * qz), 2.0 * (qy * qz - qx * qw), y,
        2.0 * (qx * qz - qy * qw), 2.0 * (qy * qz + qx * qw), 1.0 - 2.0 * (qx * qx + qy * qy), z,
        0.0, 0.0, 0.0, 1.0,
    );
    matrix
}

/// Homogeneous matrix of a translation and angles about the fixed axes: `Rz(yaw) Ry(pitch) Rx(roll)`.
pub fn of_roll_pitch_yaw([x, y, z]: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Matrix4<f64> {
    let ((sr, cr), (sp, cp), (sy, cy)) = (roll.sin_cos(), pitch.sin_cos(), yaw.sin_cos());
    #[rustfmt::skip]
    let (about_x, about_y, about_z) = (
        Matrix4::new(1.0, 0.0, 0.0, 0.0,  0.0, cr, -sr, 0.0,  0.0, sr, cr, 0.0,  0.0, 0.0, 0.0, 1.0),
        Matrix4::new(cp, 0.0, sp, 0.0,  0.0, 1.0, 0.0, 0.0,  -sp, 0.0, cp, 0.0,  0.0, 0.0, 0.0, 1.0),
        Matrix4::new(cy, -sy, 0.0, 0.0,  sy, cy, 0.0, 0.0,  0.0, 0.0, 1.0, 0.0,  0.0, 0.0, 0.0, 1.0),
    );
    Matrix4::new_translation(&Vector3::new(x, y, z)) * about_z * about_y * about_x
}
