//! Exponential and logarithm of rotations and rigid transforms, and the chart used for fitting.
//!
//! Formulas: Barfoot and Furgale, "Associating uncertainty with three-dimensional poses for use in
//! estimation problems", IEEE Transactions on Robotics 30(3), 2014, with their order of a tangent:
//! translation first, then rotation.

use crate::frame::CoordinateFrame;
use crate::transform::Transform;
use nalgebra::{Matrix3, Matrix6, Quaternion, UnitQuaternion, Vector3, Vector6};

/// Tangent vector `[x, y, z, rx, ry, rz]`: metres, then a rotation vector in radians.
pub type Tangent = Vector6<f64>;

/// Below this angle, the power series lose less than the closed forms.
const SERIES_BELOW_RAD: f64 = 0.5;

/// The rotation about `rotation_vector` by its length in radians.
pub fn rotation_exp(rotation_vector: &Vector3<f64>) -> UnitQuaternion<f64> {
    let half = 0.5 * rotation_vector.norm();
    // sin(half) / (2 half); two terms of the series are exact to rounding below 1e-4.
    let scale = if half < 1e-4 { 0.5 - half * half / 12.0 } else { 0.5 * half.sin() / half };
    let v = rotation_vector * scale;
    UnitQuaternion::new_normalize(Quaternion::new(half.cos(), v.x, v.y, v.z))
}

/// The shortest rotation vector of `rotation`, radians, of length 0 to pi.
///
/// At exactly pi both signs are right; one of them is returned.
pub fn rotation_log(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let sign = if rotation.w < 0.0 { -1.0 } else { 1.0 };
    let (v, w) = (rotation.imag() * sign, rotation.w * sign);
    let sine = v.norm();
    // The arc tangent keeps full precision both near 0 and near pi, where w is small.
    if sine < 1e-8 { v * (2.0 / w) } else { v * (2.0 * sine.atan2(w) / sine) }
}

/// Left Jacobian `J` of SO(3): `exp(r + d) = exp(J(r) d) exp(r)` to first order in `d`.
pub fn rotation_left_jacobian(rotation_vector: &Vector3<f64>) -> Matrix3<f64> {
    let c = Coefficients::at(rotation_vector.norm());
    let r = rotation_vector.cross_matrix();
    Matrix3::identity() + r * c.b + r * r * c.c
}

/// Inverse of [`rotation_left_jacobian`], for rotation vectors shorter than 2 pi.
pub fn rotation_left_jacobian_inverse(rotation_vector: &Vector3<f64>) -> Matrix3<f64> {
    let angle = rotation_vector.norm();
    let x = angle * angle;
    let square = if angle < SERIES_BELOW_RAD {
        let tail = 1.0 / 47_900_160.0 + x * (691.0 / 1_307_674_368_000.0 + x / 74_724_249_600.0);
        1.0 / 12.0 + x * (1.0 / 720.0 + x * (1.0 / 30_240.0 + x * (1.0 / 1_209_600.0 + x * tail)))
    } else {
        let half = 0.5 * angle;
        (1.0 - half * half.cos() / half.sin()) / x
    };
    let r = rotation_vector.cross_matrix();
    Matrix3::identity() - r * 0.5 + r * r * square
}

/// Left Jacobian of SE(3): `exp(t + d) = exp(J(t) d) exp(t)` to first order in `d`.
pub fn left_jacobian(tangent: &Tangent) -> Matrix6<f64> {
    let (translation, rotation) = halves(tangent);
    let c = Coefficients::at(rotation.norm());
    let (p, r) = (translation.cross_matrix(), rotation.cross_matrix());
    let rpr = r * p * r;
    let q = p * 0.5
        + (r * p + p * r + rpr) * c.c
        + (r * r * p + p * r * r - rpr * 3.0) * c.d
        + (rpr * r + r * rpr) * c.e;
    let j = Matrix3::identity() + r * c.b + r * r * c.c;
    blocks(&j, &q)
}

/// The two halves of a tangent: translation, rotation vector.
fn halves(tangent: &Tangent) -> (Vector3<f64>, Vector3<f64>) {
    (tangent.fixed_rows::<3>(0).into_owned(), tangent.fixed_rows::<3>(3).into_owned())
}

/// `[diagonal, corner; 0, diagonal]`.
fn blocks(diagonal: &Matrix3<f64>, corner: &Matrix3<f64>) -> Matrix6<f64> {
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(diagonal);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(diagonal);
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(corner);
    matrix
}

/// The scalar functions of the angle that the Jacobians are made of.
struct Coefficients {
    /// `(1 - cos a) / a^2`
    b: f64,
    /// `(a - sin a) / a^3`
    c: f64,
    /// `(a^2 + 2 cos a - 2) / (2 a^4)`
    d: f64,
    /// `(2 a - 3 sin a + a cos a) / (2 a^5)`
    e: f64,
}

impl Coefficients {
    fn at(angle: f64) -> Self {
        let x = angle * angle;
        if angle < SERIES_BELOW_RAD {
            return Self::series(x);
        }
        let (sin, cos) = angle.sin_cos();
        let half_sin = (0.5 * angle).sin();
        Self {
            b: 2.0 * half_sin * half_sin / x,
            c: (angle - sin) / (x * angle),
            d: (x + 2.0 * cos - 2.0) / (2.0 * x * x),
            e: (2.0 * angle - 3.0 * sin + angle * cos) / (2.0 * x * x * angle),
        }
    }

    /// Seven terms in `x`, the squared angle: exact to rounding below [`SERIES_BELOW_RAD`].
    fn series(x: f64) -> Self {
        let mut sums = Self { b: 0.0, c: 0.0, d: 0.0, e: 0.0 };
        // `term` is (-x)^k / (2 k + 2)!
        let mut term = 0.5;
        for k in 0..7 {
            let n = 2.0 * f64::from(k) + 2.0;
            sums.b += term;
            sums.c += term / (n + 1.0);
            sums.d += term / ((n + 1.0) * (n + 2.0));
            sums.e += term * (f64::from(k) + 1.0) / ((n + 1.0) * (n + 2.0) * (n + 3.0));
            term *= -x / ((n + 1.0) * (n + 2.0));
        }
        sums
    }
}

impl<To: CoordinateFrame, From: CoordinateFrame> Transform<To, From> {
    /// Exponential map of SE(3). The caller vouches for the frames.
    pub fn exp(tangent: &Tangent) -> Self {
        let (translation, rotation) = halves(tangent);
        let translation_m = rotation_left_jacobian(&rotation) * translation;
        Self::from_parts(translation_m, rotation_exp(&rotation))
    }

    /// Logarithm of SE(3), with a rotation vector no longer than pi.
    pub fn log(&self) -> Tangent {
        let rotation = rotation_log(&self.rotation());
        let translation = rotation_left_jacobian_inverse(&rotation) * self.translation_m();
        join(&translation, &rotation)
    }

    /// The matrix `Ad` of `t exp(d) t^-1 = exp(Ad d)`, translation first.
    pub fn adjoint(&self) -> Matrix6<f64> {
        let rotation = self.rotation().to_rotation_matrix().into_inner();
        blocks(&rotation, &(self.translation_m().cross_matrix() * rotation))
    }

    /// Moves by `delta`: `translation += delta[0..3]`, `rotation = exp(delta[3..6]) * rotation`.
    ///
    /// Every fit and every covariance is in these coordinates: the origin of `From` along the axes
    /// of `To` in metres, and a rotation vector along the axes of `To` in radians. The two halves
    /// do not mix, so a standard deviation of either means what it says.
    #[must_use]
    pub fn retract(&self, delta: &Tangent) -> Self {
        let (translation, rotation) = halves(delta);
        let mut turned = rotation_exp(&rotation) * self.rotation();
        turned.renormalize();
        Self::from_parts(self.translation_m() + translation, turned)
    }

    /// The `delta` for which `self.retract(&delta)` is `other`, with a rotation up to pi.
    pub fn local(&self, other: &Self) -> Tangent {
        let translation = other.translation_m() - self.translation_m();
        join(&translation, &rotation_log(&(other.rotation() * self.rotation().inverse())))
    }
}

/// Tangent of a translation and a rotation vector.
fn join(translation: &Vector3<f64>, rotation: &Vector3<f64>) -> Tangent {
    let (t, r) = (translation, rotation);
    Tangent::new(t.x, t.y, t.z, r.x, r.y, r.z)
}
