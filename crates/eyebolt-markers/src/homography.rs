//! Maps between planes.

use nalgebra::{Matrix3, Point2, SMatrix, SVector, SymmetricEigen, Vector3};

/// A projective map of one plane to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Homography(pub Matrix3<f64>);

impl Homography {
    /// The map of the unit square's corners (0, 0), (1, 0), (1, 1), (0, 1) to `corners`.
    pub fn of_unit_square(corners: &[Point2<f64>; 4]) -> Option<Self> {
        // P. Heckbert, "Fundamentals of texture mapping", 1989.
        let [a, b, c, d] = *corners;
        let (d1, d2, sum) = (b - c, d - c, a - b + (c - d));
        let below = d1.x * d2.y - d1.y * d2.x;
        let g = (sum.x * d2.y - sum.y * d2.x) / below;
        let h = (d1.x * sum.y - d1.y * sum.x) / below;
        let (u, v) = (b - a + b.coords * g, d - a + d.coords * h);
        let matrix = Matrix3::new(u.x, v.x, a.x, u.y, v.y, a.y, g, h, 1.0);
        matrix.iter().all(|v| v.is_finite()).then_some(Self(matrix))
    }

    /// The map that takes `from` to `to` best, algebraically, of four points or more (direct linear
    /// transform with Hartley's normalisation); `None` if they do not determine one.
    pub fn fit(pairs: &[(Point2<f64>, Point2<f64>)]) -> Option<Self> {
        if pairs.len() < 4 {
            return None;
        }
        let from = normaliser(pairs.iter().map(|pair| &pair.0))?;
        let to = normaliser(pairs.iter().map(|pair| &pair.1))?;
        let mut moment = SMatrix::<f64, 9, 9>::zeros();
        for (a, b) in pairs {
            let (a, b) = (from * a.to_homogeneous(), to * b.to_homogeneous());
            for (factor, row) in [(b.x, 0), (b.y, 3)] {
                let mut equation = SVector::<f64, 9>::zeros();
                equation.fixed_rows_mut::<3>(row).copy_from(&a);
                equation.fixed_rows_mut::<3>(6).copy_from(&(a * -factor));
                moment += equation * equation.transpose();
            }
        }
        let eigen = SymmetricEigen::try_new(moment, f64::EPSILON, 1000)?;
        let smallest = eigen.eigenvalues.imin();
        // Points on a line leave more than one map.
        let others = (0..9).filter(|i| *i != smallest).map(|i| eigen.eigenvalues[i]);
        if others.fold(f64::INFINITY, f64::min) <= 1e-9 * eigen.eigenvalues.max() {
            return None;
        }
        let h = eigen.eigenvectors.column(smallest);
        let matrix = Matrix3::from_row_iterator(h.iter().copied());
        let matrix = to.try_inverse()? * matrix * from;
        matrix.iter().all(|v| v.is_finite()).then_some(Self(matrix))
    }

    /// Where `point` is mapped to; nowhere finite if it is on the horizon.
    #[inline]
    pub fn map(&self, point: &Point2<f64>) -> Point2<f64> {
        let to = self.0 * Vector3::new(point.x, point.y, 1.0);
        Point2::new(to.x / to.z, to.y / to.z)
    }
}

/// The map that takes points to mean zero and a mean distance of sqrt(2) from it.
fn normaliser<'a>(points: impl Iterator<Item = &'a Point2<f64>> + Clone) -> Option<Matrix3<f64>> {
    let count = points.clone().count() as f64;
    let mean = points.clone().map(|p| p.coords).sum::<nalgebra::Vector2<f64>>() / count;
    let distance = points.map(|p| (p.coords - mean).norm()).sum::<f64>() / count;
    let scale = std::f64::consts::SQRT_2 / distance;
    (scale.is_finite() && scale > 0.0).then(|| {
        Matrix3::new(scale, 0.0, -scale * mean.x, 0.0, scale, -scale * mean.y, 0.0, 0.0, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_mapped_to_corners_by_both() {
        let corners = [(10.0, 12.0), (60.0, 20.0), (55.0, 70.0), (5.0, 50.0)];
        let corners = corners.map(|(x, y)| Point2::new(x, y));
        let square =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point2::new(x, y));
        let direct = Homography::of_unit_square(&corners).unwrap();
        let pairs: Vec<_> = square.into_iter().zip(corners).collect();
        let fitted = Homography::fit(&pairs).unwrap();
        for (from, to) in pairs {
            assert!((direct.map(&from) - to).norm() < 1e-12);
            assert!((fitted.map(&from) - to).norm() < 1e-6);
        }
    }

    #[test]
    fn points_on_a_line_determine_none() {
        let point = |i: f64| Point2::new(i, 2.0 * i);
        let pairs: Vec<_> = (0..6).map(|i| (point(f64::from(i)), point(f64::from(i)))).collect();
        assert_eq!(Homography::fit(&pairs), None);
        assert_eq!(Homography::of_unit_square(&[Point2::origin(); 4]), None);
    }
}
