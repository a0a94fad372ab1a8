//! Daniilidis: rotation and translation at once, as a unit dual quaternion.

use super::horaud_dornaika::{left, right, upper};
use super::motion::Motion;
use nalgebra::{
    Isometry3, Quaternion, SMatrix, SVector, SymmetricEigen, Translation3, UnitQuaternion, Vector4,
};

/// `camera_from_root`.
pub(super) fn solve(motions: &[Motion]) -> Option<Isometry3<f64>> {
    let mut moment = SMatrix::<f64, 8, 8>::zeros();
    for motion in motions {
        let (camera, camera_dual) = dual_quaternion(&motion.camera);
        let (root, root_dual) = dual_quaternion(&motion.root);
        // The scalar parts are alike whatever the unknown is (the screw congruence): no equations.
        let real = (left(&camera) - right(&root)).fixed_rows::<3>(1).into_owned();
        let dual = (left(&camera_dual) - right(&root_dual)).fixed_rows::<3>(1).into_owned();
        let mut rows = SMatrix::<f64, 6, 8>::zeros();
        rows.fixed_view_mut::<3, 4>(0, 0).copy_from(&real);
        rows.fixed_view_mut::<3, 4>(3, 0).copy_from(&dual);
        rows.fixed_view_mut::<3, 4>(3, 4).copy_from(&real);
        moment += rows.transpose() * rows * motion.weight;
    }
    let eigen = SymmetricEigen::try_new(moment, f64::EPSILON, 1000)?;
    let mut order: Vec<usize> = (0..8).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let column = |i: usize| eigen.eigenvectors.column(order[i]).into_owned();
    unit(&column(0), &column(1))
}

/// The unit dual quaternion in the plane of two vectors `[real, dual]`.
fn unit(a: &SVector<f64, 8>, b: &SVector<f64, 8>) -> Option<Isometry3<f64>> {
    let half =
        |v: &SVector<f64, 8>, row: usize| -> Vector4<f64> { v.fixed_rows::<4>(row).into_owned() };
    let (u1, v1, u2, v2) = (half(a, 0), half(a, 4), half(b, 0), half(b, 4));
    // The real part is orthogonal to the dual part: a quadratic equation for the direction (s, t).
    let (p, q, r) = (u1.dot(&v1), u1.dot(&v2) + u2.dot(&v1), u2.dot(&v2));
    let root = (q * q - 4.0 * p * r).max(0.0).sqrt();
    let stable = -0.5 * (q + if q < 0.0 { -root } else { root });
    let directions = [(stable, p), (r, stable)];
    let length = |(s, t): (f64, f64)| (u1 * s + u2 * t).norm() / s.hypot(t);
    let (s, t) = directions
        .into_iter()
        .filter(|(s, t)| s.hypot(*t) > 0.0)
        .max_by(|x, y| length(*x).total_cmp(&length(*y)))
        // No equation: any direction is as good.
        .unwrap_or((1.0, 0.0));
    let (real, dual) = (u1 * s + u2 * t, v1 * s + v2 * t);
    let norm = real.norm();
    let quaternion = |v: Vector4<f64>| Quaternion::new(v[0], v[1], v[2], v[3]) / norm;
    let (real, dual) = (quaternion(real), quaternion(dual));
    let rotation = UnitQuaternion::try_new(real, 1e-9)?;
    let translation = (dual * real.conjugate()).imag() * 2.0;
    Some(Isometry3::from_parts(Translation3::from(translation), rotation))
}

/// Real and dual part of a motion.
fn dual_quaternion(motion: &Isometry3<f64>) -> (Quaternion<f64>, Quaternion<f64>) {
    let real = upper(&motion.rotation);
    let translation = Quaternion::from_parts(0.0, motion.translation.vector);
    (real, translation * real * 0.5)
}
