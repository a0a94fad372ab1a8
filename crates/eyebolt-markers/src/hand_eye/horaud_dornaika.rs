//! Horaud and Dornaika: the quaternion that fits all equations of rotations best.

use super::motion::Motion;
use nalgebra::{Matrix3, Matrix4, Quaternion, SymmetricEigen, UnitQuaternion};

/// The rotation of `camera_from_root`.
pub(super) fn rotation(motions: &[Motion]) -> Option<Matrix3<f64>> {
    let mut moment = Matrix4::zeros();
    for motion in motions {
        let rows = left(&upper(&motion.camera.rotation)) - right(&upper(&motion.root.rotation));
        moment += rows.transpose() * rows * motion.weight;
    }
    let eigen = SymmetricEigen::try_new(moment, f64::EPSILON, 1000)?;
    let v = eigen.eigenvectors.column(eigen.eigenvalues.imin());
    let found = Quaternion::new(v[0], v[1], v[2], v[3]);
    Some(UnitQuaternion::try_new(found, 1e-9)?.to_rotation_matrix().into_inner())
}

/// Of the two quaternions of a rotation, the one with a positive first number.
pub(super) fn upper(rotation: &UnitQuaternion<f64>) -> Quaternion<f64> {
    if rotation.w < 0.0 { -rotation.into_inner() } else { rotation.into_inner() }
}

/// The matrix of `p -> q p`, on `[w, x, y, z]`.
pub(super) fn left(q: &Quaternion<f64>) -> Matrix4<f64> {
    Matrix4::new(
        q.w, -q.i, -q.j, -q.k, //
        q.i, q.w, -q.k, q.j, //
        q.j, q.k, q.w, -q.i, //
        q.k, -q.j, q.i, q.w,
    )
}

/// The matrix of `p -> p q`.
pub(super) fn right(q: &Quaternion<f64>) -> Matrix4<f64> {
    Matrix4::new(
        q.w, -q.i, -q.j, -q.k, //
        q.i, q.w, q.k, -q.j, //
        q.j, -q.k, q.w, q.i, //
        q.k, q.j, -q.i, q.w,
    )
}
