//! Park and Martin: the rotation that turns the robot's rotation vectors into the marker's.

use super::motion::Motion;
use eyebolt_geometry::rotation_log;
use nalgebra::Matrix3;

/// The rotation of `camera_from_root`; least squares over the rotation vectors, by singular values (which
/// is the paper's `(M^T M)^(-1/2) M^T`, and stays a rotation where two axes are all there is).
pub(super) fn rotation(motions: &[Motion]) -> Option<Matrix3<f64>> {
    let product = |m: &Motion| {
        let (camera, root) = (rotation_log(&m.camera.rotation), rotation_log(&m.root.rotation));
        camera * root.transpose() * m.weight
    };
    let moment: Matrix3<f64> = motions.iter().map(product).sum();
    let svd = moment.try_svd(true, true, f64::EPSILON, 1000)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    let mut sign = Matrix3::identity();
    // Singular values are in descending order: the last direction is the least sure.
    sign[(2, 2)] = (u * v_t).determinant().signum();
    Some(u * sign * v_t)
}
