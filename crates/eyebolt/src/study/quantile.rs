//! How large an error may be, by its covariance.

use super::chi_square;
use crate::calibrate::{Deviation, ErrorEstimate, covariance_at};
use eyebolt_geometry::{Base, Camera, Transform};
use nalgebra::{Matrix3, Point3};

/// Probabilities whose quantiles are held against errors.
pub const LEVELS: [f64; 3] = [0.50, 0.90, 0.95];

/// What the length of a normal error of mean 0 and `covariance` stays below with `probability`.
///
/// The square of the length is a sum of squared normals, weighted by the eigenvalues; it is taken for a
/// multiple of a chi-square variable of the same mean and variance (Satterthwaite, *An approximate
/// distribution of estimates of variance components*, Biometrics Bulletin 2, 1946).
pub fn quantile(covariance: &Matrix3<f64>, probability: f64) -> f64 {
    // The traces of the matrix and of its square are the sums of the eigenvalues and their squares.
    let (mean, half_variance) = (covariance.trace(), (covariance * covariance).trace());
    if mean <= 0.0 || half_variance <= 0.0 {
        return 0.0;
    }
    let freedom = mean * mean / half_variance;
    (half_variance / mean * chi_square::quantile(freedom, probability)).sqrt()
}

/// The quantiles of the error of `camera_from_base` at [`LEVELS`], where translations are those of a
/// point of the base.
pub(super) fn quantiles(
    error: &ErrorEstimate,
    camera_from_base: &Transform<Camera, Base>,
    at_in_base: &Point3<f64>,
) -> [Deviation; 3] {
    let translation = covariance_at(&error.covariance, camera_from_base, at_in_base);
    let rotation = error.covariance.fixed_view::<3, 3>(3, 3).into_owned();
    LEVELS.map(|level| Deviation {
        translation_m: quantile(&translation, level),
        rotation_rad: quantile(&rotation, level),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_render::Random;
    use nalgebra::Vector3;

    fn lengths(sigma: Vector3<f64>) -> Vec<f64> {
        let mut random = Random::new(4);
        let mut draw = || Vector3::from_fn(|row, _| sigma[row] * random.normal()).norm();
        let mut lengths: Vec<f64> = (0..100_000).map(|_| draw()).collect();
        lengths.sort_by(f64::total_cmp);
        lengths
    }

    #[test]
    fn equal_and_single_axes_are_exact() {
        for (sigma, freedom) in [(Vector3::repeat(2.0), 3.0), (Vector3::new(2.0, 0.0, 0.0), 1.0)] {
            let covariance = Matrix3::from_diagonal(&sigma.component_mul(&sigma));
            for level in LEVELS {
                let expected = 2.0 * chi_square::quantile(freedom, level).sqrt();
                assert!((quantile(&covariance, level) - expected).abs() < 1e-9);
            }
        }
        assert_eq!(quantile(&Matrix3::zeros(), 0.9), 0.0);
    }

    #[test]
    fn of_100_000_drawn_errors_as_many_are_below_as_it_says() {
        for sigma in
            [Vector3::new(3.0, 1.0, 0.5), Vector3::new(1.0, 2.0, 2.0), Vector3::new(5.0, 1.0, 1.0)]
        {
            // Turned, so that no axis is an eigenvector.
            let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.8, 1.1);
            let diagonal = Matrix3::from_diagonal(&sigma.component_mul(&sigma));
            let covariance = turn * diagonal * turn.inverse();
            let lengths = lengths(sigma);
            for level in LEVELS {
                let bound = quantile(&covariance, level);
                let below = lengths.partition_point(|length| *length <= bound) as f64;
                let share = below / lengths.len() as f64;
                assert!((share - level).abs() < 0.02, "{sigma:?} {level}: {share}");
            }
        }
    }
}
