//! Lens distortion with the coefficients of OpenCV and ROS.

use nalgebra::{Matrix2, Vector2};

/// How a lens bends rays away from a pinhole's, in normalised image coordinates `x / z`, `y / z`.
///
/// The model is the one of OpenCV's `projectPoints` (OpenCV documentation, "Camera Calibration and
/// 3D Reconstruction").
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Distortion {
    /// A perfect pinhole.
    #[default]
    None,
    /// Brown's model, `plumb_bob` in ROS; its `d` is `[k1, k2, p1, p2, k3]`.
    #[expect(missing_docs, reason = "the coefficients are named as in OpenCV")]
    PlumbBob { k1: f64, k2: f64, p1: f64, p2: f64, k3: f64 },
    /// `rational_polynomial` in ROS; its `d` is `[k1, k2, p1, p2, k3, k4, k5, k6]`.
    #[expect(missing_docs, reason = "the coefficients are named as in OpenCV")]
    RationalPolynomial { k1: f64, k2: f64, p1: f64, p2: f64, k3: f64, k4: f64, k5: f64, k6: f64 },
}

impl Distortion {
    /// `plumb_bob` from `d = [k1, k2, p1, p2, k3]`.
    pub fn plumb_bob(d: [f64; 5]) -> Self {
        let [k1, k2, p1, p2, k3] = d;
        Self::PlumbBob { k1, k2, p1, p2, k3 }
    }

    /// `rational_polynomial` from `d = [k1, k2, p1, p2, k3, k4, k5, k6]`.
    pub fn rational_polynomial(d: [f64; 8]) -> Self {
        let [k1, k2, p1, p2, k3, k4, k5, k6] = d;
        Self::RationalPolynomial { k1, k2, p1, p2, k3, k4, k5, k6 }
    }

    /// All eight coefficients `[k1, k2, p1, p2, k3, k4, k5, k6]`, absent ones zero.
    pub fn coefficients(&self) -> [f64; 8] {
        match *self {
            Self::None => [0.0; 8],
            Self::PlumbBob { k1, k2, p1, p2, k3 } => [k1, k2, p1, p2, k3, 0.0, 0.0, 0.0],
            Self::RationalPolynomial { k1, k2, p1, p2, k3, k4, k5, k6 } => {
                [k1, k2, p1, p2, k3, k4, k5, k6]
            }
        }
    }

    /// Where the lens moves the normalised point `x`.
    pub fn distort(&self, x: &Vector2<f64>) -> Vector2<f64> {
        if matches!(self, Self::None) { *x } else { self.distort_with_jacobian(x).0 }
    }

    /// [`Self::distort`] and its derivative by `x`.
    pub fn distort_with_jacobian(&self, at: &Vector2<f64>) -> (Vector2<f64>, Matrix2<f64>) {
        if matches!(self, Self::None) {
            return (*at, Matrix2::identity());
        }
        let [_, _, p1, p2, ..] = self.coefficients();
        let (x, y, r2) = (at.x, at.y, at.norm_squared());
        let (radial, slope) = self.radial(r2);
        let tangential = Vector2::new(
            2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y,
        );
        let cross = 2.0 * (slope * x * y + p1 * x + p2 * y);
        let jacobian = Matrix2::new(
            radial + 2.0 * slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x,
            cross,
            cross,
            radial + 2.0 * slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x,
        );
        (at * radial + tangential, jacobian)
    }

    /// The point that the lens moves to `distorted`, to 1e-13, by Newton's method with halved steps.
    ///
    /// `None` where the iteration does not arrive.
    pub fn undistort(&self, distorted: &Vector2<f64>) -> Option<Vector2<f64>> {
        if matches!(self, Self::None) {
            return Some(*distorted);
        }
        let mut x = *distorted;
        let (mut moved, mut jacobian) = self.distort_with_jacobian(&x);
        let mut error = (moved - distorted).norm();
        for _ in 0..50 {
            if error <= 1e-13 * (1.0 + distorted.norm()) {
                return Some(x);
            }
            let step = jacobian.try_inverse()? * (moved - distorted);
            let mut share = 1.0;
            loop {
                let next = x - step * share;
                (moved, jacobian) = self.distort_with_jacobian(&next);
                let next_error = (moved - distorted).norm();
                if next_error < error {
                    (x, error) = (next, next_error);
                    break;
                }
                share *= 0.5;
                if share < 1e-3 {
                    return None;
                }
            }
        }
        None
    }

    /// Radius in normalised coordinates up to which the radial part grows, searched up to `limit`.
    ///
    /// Beyond it the model folds back: rays far outside the view would land inside the image.
    pub(crate) fn radius_limit(&self, limit: f64) -> f64 {
        const STEPS: u32 = 4000;
        if matches!(self, Self::None) {
            return f64::INFINITY;
        }
        let grows = |radius: f64| {
            let r2 = radius * radius;
            let (radial, slope) = self.radial(r2);
            radial > 0.0 && radial + 2.0 * slope * r2 > 0.0
        };
        let radius = |step: u32| limit * f64::from(step) / f64::from(STEPS);
        match (1..=STEPS).find(|step| !grows(radius(*step))) {
            Some(step) => radius(step - 1),
            None => limit,
        }
    }

    /// The radial factor at the squared radius `r2`, and its derivative by `r2`.
    fn radial(&self, r2: f64) -> (f64, f64) {
        let [k1, k2, _, _, k3, k4, k5, k6] = self.coefficients();
        let above = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
        let below = 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6));
        let above_slope = k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3);
        let below_slope = k4 + r2 * (2.0 * k5 + r2 * 3.0 * k6);
        let radial = above / below;
        (radial, (above_slope - radial * below_slope) / below)
    }
}
