//! Closed-form eigenvector of a symmetric 3 x 3 matrix, for one plane per pixel.

use nalgebra::{Matrix3, Vector3};

/// The unit eigenvector of the smallest eigenvalue of the positive semidefinite `matrix`.
///
/// Eigenvalues by the trigonometric solution of the cubic (Smith, "Eigenvalues of a symmetric
/// 3 x 3 matrix", Communications of the ACM 4(4), 1961). `None` where no direction stands out: the
/// two smallest eigenvalues are equal to 1e-6 of the largest, as for points on a line.
pub(crate) fn smallest_eigenvector(matrix: &Matrix3<f64>) -> Option<Vector3<f64>> {
    let mean = matrix.trace() / 3.0;
    let shifted = matrix - Matrix3::identity() * mean;
    let spread = (shifted.norm_squared() / 6.0).sqrt();
    if !(spread > 0.0 && mean.is_finite()) {
        return None;
    }
    let half_det = (0.5 * (shifted / spread).determinant()).clamp(-1.0, 1.0);
    let angle = half_det.acos() / 3.0;
    let third = 2.0 * std::f64::consts::FRAC_PI_3;
    let largest = mean + 2.0 * spread * angle.cos();
    let smallest = mean + 2.0 * spread * (angle + third).cos();
    let middle = 3.0 * mean - largest - smallest;
    if middle - smallest <= 1e-6 * largest {
        return None;
    }
    // Two columns of the rest span the other eigenvectors; the longest cross product is the best.
    let rest = matrix - Matrix3::identity() * smallest;
    let [a, b, c] = [0, 1, 2].map(|i| rest.column(i).into_owned());
    let best = [a.cross(&b), b.cross(&c), c.cross(&a)]
        .into_iter()
        .max_by(|x, y| x.norm_squared().total_cmp(&y.norm_squared()))?;
    best.try_normalize(0.0)
}
