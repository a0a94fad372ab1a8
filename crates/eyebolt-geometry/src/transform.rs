//! A rigid transform that knows which frames it runs between.

use crate::frame::CoordinateFrame;
use nalgebra::{
    Isometry3, Matrix3, Matrix4, Point3, Quaternion, Rotation3, Translation3, UnitQuaternion,
    Vector3,
};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Mul;

/// Rigid transform `to_from_from`: maps coordinates in frame `From` to coordinates in frame `To`.
///
/// Rotation and translation stay together; metres and radians.
///
/// ```
/// use eyebolt_geometry::{Base, Camera, EndEffector, Transform};
/// # let camera_from_base = Transform::<Camera, Base>::identity();
/// # let base_from_ee = Transform::<Base, EndEffector>::identity();
/// // Only transforms that meet in the same frame compose.
/// let camera_from_ee: Transform<Camera, EndEffector> = camera_from_base * base_from_ee;
/// ```
pub struct Transform<To, From> {
    isometry: Isometry3<f64>,
    frames: PhantomData<fn(From) -> To>,
}

impl<To: CoordinateFrame, From: CoordinateFrame> Transform<To, From> {
    /// The transform whose matrix is `isometry`'s. The caller vouches for the frames.
    pub fn from_isometry(isometry: Isometry3<f64>) -> Self {
        Self { isometry, frames: PhantomData }
    }

    /// The transform that changes no coordinates. Never a fallback for a missing answer.
    pub fn identity() -> Self {
        Self::from_isometry(Isometry3::identity())
    }

    /// Rotation first, then translation (metres).
    pub fn from_parts(translation_m: Vector3<f64>, rotation: UnitQuaternion<f64>) -> Self {
        Self::from_isometry(Isometry3::from_parts(Translation3::from(translation_m), rotation))
    }

    /// From a translation in metres and a Hamilton quaternion `[x, y, z, w]`, normalised here.
    ///
    /// `None` if a number is not finite or the quaternion is too short to have a direction.
    pub fn from_xyzw(translation_m: [f64; 3], rotation_xyzw: [f64; 4]) -> Option<Self> {
        let [x, y, z, w] = rotation_xyzw;
        let rotation = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9)?;
        let translation_m = Vector3::from(translation_m);
        let finite = translation_m.iter().chain(rotation.coords.iter()).all(|v| v.is_finite());
        finite.then(|| Self::from_parts(translation_m, rotation))
    }

    /// From a homogeneous 4x4 matrix, metres.
    ///
    /// `None` unless the last row is `0 0 0 1` and the upper left block is a rotation to
    /// `tolerance` (largest entry of `R^T R - I`); the nearest rotation is taken.
    pub fn from_matrix(matrix: &Matrix4<f64>, tolerance: f64) -> Option<Self> {
        let block: Matrix3<f64> = matrix.fixed_view::<3, 3>(0, 0).into_owned();
        let bottom = matrix.row(3) - nalgebra::RowVector4::new(0.0, 0.0, 0.0, 1.0);
        let skew = (block.transpose() * block - Matrix3::identity()).amax();
        let valid = matrix.iter().all(|v| v.is_finite())
            && bottom.amax() <= tolerance
            && skew <= tolerance
            && block.determinant() > 0.0;
        if !valid {
            return None;
        }
        let svd = block.svd(true, true);
        let nearest = svd.u? * svd.v_t?;
        let rotation =
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(nearest));
        Some(Self::from_parts(matrix.fixed_view::<3, 1>(0, 3).into_owned(), rotation))
    }

    /// The same transform as nalgebra's type.
    pub fn isometry(&self) -> &Isometry3<f64> {
        &self.isometry
    }

    /// Homogeneous 4x4 matrix.
    pub fn matrix(&self) -> Matrix4<f64> {
        self.isometry.to_homogeneous()
    }

    /// Origin of `From` in `To`, metres.
    pub fn translation_m(&self) -> Vector3<f64> {
        self.isometry.translation.vector
    }

    /// Rotation from `From` to `To`.
    pub fn rotation(&self) -> UnitQuaternion<f64> {
        self.isometry.rotation
    }

    /// Hamilton quaternion `[x, y, z, w]` with `w >= 0`, as every file and interface shows it.
    pub fn rotation_xyzw(&self) -> [f64; 4] {
        let q = self.isometry.rotation;
        let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
        [sign * q.i, sign * q.j, sign * q.k, sign * q.w]
    }

    /// The way back.
    pub fn inverse(&self) -> Transform<From, To> {
        Transform::from_isometry(self.isometry.inverse())
    }

    /// Moves a point given in `From` to `To`.
    pub fn point(&self, point_in_from: &Point3<f64>) -> Point3<f64> {
        self.isometry * point_in_from
    }

    /// Turns a direction given in `From` to `To`.
    pub fn direction(&self, direction_in_from: &Vector3<f64>) -> Vector3<f64> {
        self.isometry.rotation * direction_in_from
    }

    /// How far `other` is from `self`: distance of the origins in metres and angle in radians.
    pub fn distance_to(&self, other: &Self) -> (f64, f64) {
        (
            (self.translation_m() - other.translation_m()).norm(),
            self.rotation().angle_to(&other.rotation()),
        )
    }
}

impl<A: CoordinateFrame, B: CoordinateFrame, C: CoordinateFrame> Mul<Transform<B, C>>
    for Transform<A, B>
{
    type Output = Transform<A, C>;

    fn mul(self, other: Transform<B, C>) -> Transform<A, C> {
        Transform::from_isometry(self.isometry * other.isometry)
    }
}

// Derives would ask the frames for the same traits; the frames have no values.
impl<To, From> Clone for Transform<To, From> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<To, From> Copy for Transform<To, From> {}

impl<To, From> PartialEq for Transform<To, From> {
    fn eq(&self, other: &Self) -> bool {
        self.isometry == other.isometry
    }
}

impl<To: CoordinateFrame, From: CoordinateFrame> fmt::Debug for Transform<To, From> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let t = self.translation_m();
        let [x, y, z, w] = self.rotation_xyzw();
        write!(
            f,
            "{}_from_{} {{ translation_m: [{}, {}, {}], rotation_xyzw: [{x}, {y}, {z}, {w}] }}",
            To::NAME,
            From::NAME,
            t.x,
            t.y,
            t.z
        )
    }
}
