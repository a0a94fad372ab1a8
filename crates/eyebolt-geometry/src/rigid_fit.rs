//! The rigid motion between two sets of points.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// The second singular value must be at least this share of the first: else the points lie on a line, about
/// which any turn fits.
const LEAST_SPREAD: f64 = 1e-3;

/// A point, its counterpart, and how much the two count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correspondence {
    /// The point.
    pub from: Point3<f64>,
    /// Its counterpart.
    pub to: Point3<f64>,
    /// How much they count; not negative.
    pub weight: f64,
}

/// The motion that takes points closest to their counterparts, by weighted least squares (Arun, Huang and Blostein, *Least-
/// squares fitting of two 3-D point sets*, PAMI 9, 1987; reflections corrected as by Umeyama, PAMI 13, 1991).
///
/// `None` with fewer than three points of weight, with points on a line, or with a number that is not finite.
pub fn rigid_fit(pairs: &[Correspondence]) -> Option<Isometry3<f64>> {
    let total: f64 = pairs.iter().map(|pair| pair.weight).sum();
    if pairs.iter().filter(|pair| pair.weight > 0.0).count() < 3 || !total.is_finite() {
        return None;
    }
    let mean = |of: fn(&Correspondence) -> Point3<f64>| {
        pairs.iter().map(|pair| pair.weight * of(pair).coords).sum::<Vector3<f64>>() / total
    };
    let (from, to) = (mean(|pair| pair.from), mean(|pair| pair.to));
    let outer = |pair: &Correspondence| {
        pair.weight * (pair.to.coords - to) * (pair.from.coords - from).transpose()
    };
    let covariance: Matrix3<f64> = pairs.iter().map(outer).sum::<Matrix3<f64>>() / total;
    if !covariance.iter().all(|value| value.is_finite()) {
        return None;
    }
    let svd = covariance.svd(true, true);
    let (u, v_t) = (svd.u?, svd.v_t?);
    let values = svd.singular_values;
    // Finite, as the covariance is.
    if values[1] <= LEAST_SPREAD * values[0] {
        return None;
    }
    let mut turned = Matrix3::identity();
    turned[(2, 2)] = (u * v_t).determinant().signum();
    let rotation = Rotation3::from_matrix_unchecked(u * turned * v_t);
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    Some(Isometry3::from_parts(Translation3::from(to - rotation * from), rotation))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Point3<f64>> {
        prop::array::uniform3(-1.0..1.0).prop_map(Point3::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn finds_the_motion_that_moved_them(
            points in prop::collection::vec(point(), 4..20),
            axis in point(),
            shift in point(),
            weights in prop::collection::vec(0.1..2.0, 20),
        ) {
            let motion = Isometry3::new(shift.coords, 3.0 * axis.coords);
            let pairs: Vec<_> = points
                .iter()
                .zip(weights)
                .map(|(from, weight)| Correspondence { from: *from, to: motion * from, weight })
                .collect();
            let Some(found) = rigid_fit(&pairs) else { return Ok(()) };
            // Planar sets are as good as others; nearly collinear ones are ill-conditioned.
            let spread = points.iter().any(|p| (p - points[0]).norm() > 0.3);
            prop_assume!(spread);
            for point in &points {
                prop_assert!((found * point - motion * point).norm() < 1e-6);
            }
        }
    }

    #[test]
    fn points_on_a_plane_are_enough_and_those_on_a_line_are_not() {
        let motion = Isometry3::new(Vector3::new(0.1, 0.2, -0.3), Vector3::new(0.4, -1.2, 2.0));
        let pairs = |points: &[[f64; 3]]| -> Vec<Correspondence> {
            let from = points.iter().map(|point| Point3::from(*point));
            from.map(|from| Correspondence { from, to: motion * from, weight: 1.0 }).collect()
        };
        let flat = pairs(&[[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.2, 0.0], [0.1, 0.1, 0.0]]);
        let found = rigid_fit(&flat).unwrap();
        assert!(found.rotation.angle_to(&motion.rotation) < 1e-9);
        let line = pairs(&[[0.0; 3], [0.1, 0.1, 0.0], [0.2, 0.2, 0.0], [0.3, 0.3, 0.0]]);
        assert_eq!(rigid_fit(&line), None);
        assert_eq!(rigid_fit(&flat[..2]), None);
    }
}
