//! Tsai and Lenz: a linear equation for the rotation's Rodrigues vector.

use super::motion::Motion;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use std::f64::consts::PI;

/// The rotation of `camera_from_root`.
///
/// The vector is infinite where that is half a turn, so the equation is solved about each of four rotations,
/// of which one is always within 120 degrees; the smallest answer counts.
pub(super) fn rotation(motions: &[Motion]) -> Option<Matrix3<f64>> {
    let half_turns =
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| UnitQuaternion::new(axis * PI));
    let about = [UnitQuaternion::identity()].into_iter().chain(half_turns);
    let solved = about.filter_map(|about| Some((vector(motions, &about)?, about)));
    let (vector, about) = solved.min_by(|a, b| a.0.norm().total_cmp(&b.0.norm()))?;
    let found = UnitQuaternion::new_normalize(Quaternion::from_parts(1.0, vector));
    Some((found * about).to_rotation_matrix().into_inner())
}

/// The vector `tan(angle / 2) axis` of the rotation that is left after `about`.
fn vector(motions: &[Motion], about: &UnitQuaternion<f64>) -> Option<Vector3<f64>> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for motion in motions {
        // Twice the vector part of the quaternion, `2 sin(angle / 2) axis`.
        let axis = |q: &UnitQuaternion<f64>| q.imag() * (2.0 * q.w.signum());
        let (camera, root) = (axis(&motion.camera.rotation), about * axis(&motion.root.rotation));
        let rows = (camera + root).cross_matrix();
        normal += rows.transpose() * rows * motion.weight;
        right += rows.transpose() * (root - camera) * motion.weight;
    }
    Some(normal.cholesky()?.solve(&right))
}
