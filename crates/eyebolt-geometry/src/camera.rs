//! Pinhole camera with lens distortion.

use crate::distortion::Distortion;
use nalgebra::{Matrix2x3, Point2, Point3, Vector2, Vector3};

/// Why numbers do not make a camera.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// The image has no pixels.
    #[error("image size is {width} x {height}: both must be at least 1")]
    Size {
        /// Pixels in a row.
        width: u32,
        /// Number of rows.
        height: u32,
    },
    /// A focal length is not a positive finite number.
    #[error("focal length fx = {fx}, fy = {fy} pixels: both must be positive and finite")]
    FocalLength {
        /// Horizontal focal length, pixels.
        fx: f64,
        /// Vertical focal length, pixels.
        fy: f64,
    },
    /// The principal point is not finite.
    #[error("principal point cx = {cx}, cy = {cy}: both must be finite")]
    PrincipalPoint {
        /// Horizontal, pixels.
        cx: f64,
        /// Vertical, pixels.
        cy: f64,
    },
    /// A distortion coefficient is not finite.
    #[error("distortion coefficients must be finite")]
    Distortion,
    /// A binning factor of zero, or larger than the image.
    #[error("cannot bin {width} x {height} pixels by {factor}")]
    Factor {
        /// The factor asked for.
        factor: u32,
        /// Pixels in a row.
        width: u32,
        /// Number of rows.
        height: u32,
    },
}

/// Radius `|(x, y)| / z` beyond which no distorted lens is trusted: 84 degrees off the axis.
const LARGEST_RADIUS: f64 = 10.0;

/// A camera with central projection: intrinsics in pixels, in the optical frame (x right, y down,
/// z forward).
///
/// Pixel `(u, v)` has its centre at integer coordinates, as in OpenCV and ROS; the image spans
/// `-0.5 .. width - 0.5`.
#[derive(Clone, Debug, PartialEq)]
pub struct PinholeCamera {
    width: u32,
    height: u32,
    fx: f64,
    fy: f64,
    cx: f64,
    cy: f64,
    distortion: Distortion,
    radius_limit: f64,
}

impl PinholeCamera {
    /// A camera from its image size, its intrinsics in pixels and its lens.
    ///
    /// Coefficients that are all zero become [`Distortion::None`].
    ///
    /// # Errors
    ///
    /// An empty image, a focal length that is not positive, or a number that is not finite.
    pub fn new(
        width: u32,
        height: u32,
        fx: f64,
        fy: f64,
        cx: f64,
        cy: f64,
        distortion: Distortion,
    ) -> Result<Self, CameraError> {
        if width == 0 || height == 0 {
            return Err(CameraError::Size { width, height });
        }
        if !(fx > 0.0 && fx.is_finite() && fy > 0.0 && fy.is_finite()) {
            return Err(CameraError::FocalLength { fx, fy });
        }
        if !(cx.is_finite() && cy.is_finite()) {
            return Err(CameraError::PrincipalPoint { cx, cy });
        }
        let coefficients = distortion.coefficients();
        if !coefficients.iter().all(|k| k.is_finite()) {
            return Err(CameraError::Distortion);
        }
        let straight = coefficients.iter().all(|k| *k == 0.0);
        let distortion = if straight { Distortion::None } else { distortion };
        let radius_limit = distortion.radius_limit(LARGEST_RADIUS);
        Ok(Self { width, height, fx, fy, cx, cy, distortion, radius_limit })
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Horizontal focal length, pixels.
    pub fn fx(&self) -> f64 {
        self.fx
    }

    /// Vertical focal length, pixels.
    pub fn fy(&self) -> f64 {
        self.fy
    }

    /// Horizontal principal point, pixels.
    pub fn cx(&self) -> f64 {
        self.cx
    }

    /// Vertical principal point, pixels.
    pub fn cy(&self) -> f64 {
        self.cy
    }

    /// The lens.
    pub fn distortion(&self) -> &Distortion {
        &self.distortion
    }

    /// How many pixels an image has.
    pub fn pixel_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Pixel coordinates of `point_in_camera` (metres), inside the image or not.
    ///
    /// `None` for a point that is not in front of the camera, or so far off the axis that the
    /// model of the lens folds back.
    pub fn project(&self, point_in_camera: &Point3<f64>) -> Option<Point2<f64>> {
        let x = self.normalised(point_in_camera)?;
        Some(self.pixel(&self.distortion.distort(&x)))
    }

    /// [`Self::project`] and the derivative of the pixel by the point, pixels per metre.
    pub fn project_with_jacobian(
        &self,
        point_in_camera: &Point3<f64>,
    ) -> Option<(Point2<f64>, Matrix2x3<f64>)> {
        let x = self.normalised(point_in_camera)?;
        let (moved, by_x) = self.distortion.distort_with_jacobian(&x);
        let z = point_in_camera.z;
        let x_by_point = Matrix2x3::new(1.0, 0.0, -x.x, 0.0, 1.0, -x.y) / z;
        let mut jacobian = by_x * x_by_point;
        jacobian.row_mut(0).scale_mut(self.fx);
        jacobian.row_mut(1).scale_mut(self.fy);
        Some((self.pixel(&moved), jacobian))
    }

    /// The ray with z = 1 that is seen at `pixel`; times a depth it is a point in the camera frame.
    ///
    /// `None` where the model of the lens has no ray for that pixel.
    pub fn ray(&self, pixel: &Point2<f64>) -> Option<Vector3<f64>> {
        let moved = Vector2::new((pixel.x - self.cx) / self.fx, (pixel.y - self.cy) / self.fy);
        let x = self.distortion.undistort(&moved)?;
        (x.norm() <= self.radius_limit).then(|| Vector3::new(x.x, x.y, 1.0))
    }

    /// Whether `pixel` lies on the image.
    pub fn contains(&self, pixel: &Point2<f64>) -> bool {
        let inside = |value: f64, size: u32| value >= -0.5 && value < f64::from(size) - 0.5;
        inside(pixel.x, self.width) && inside(pixel.y, self.height)
    }

    /// The camera of an image binned by `factor` x `factor` pixels; a rest at the right and bottom
    /// edge is cut off.
    ///
    /// The centre of bin `i` is at `factor * i + (factor - 1) / 2` of the full image.
    ///
    /// # Errors
    ///
    /// A factor of zero, or one that leaves no pixel.
    pub fn scaled(&self, factor: u32) -> Result<Self, CameraError> {
        let (width, height) = (self.width, self.height);
        if factor == 0 || factor > width || factor > height {
            return Err(CameraError::Factor { factor, width, height });
        }
        let by = f64::from(factor);
        let shift = 0.5 * (by - 1.0);
        Ok(Self {
            width: width / factor,
            height: height / factor,
            fx: self.fx / by,
            fy: self.fy / by,
            cx: (self.cx - shift) / by,
            cy: (self.cy - shift) / by,
            ..*self
        })
    }

    /// `x / z, y / z` of a point that the lens can see.
    fn normalised(&self, point: &Point3<f64>) -> Option<Vector2<f64>> {
        let x = Vector2::new(point.x / point.z, point.y / point.z);
        // False for NaN too.
        (point.z > 0.0 && x.norm() <= self.radius_limit).then_some(x)
    }

    fn pixel(&self, moved: &Vector2<f64>) -> Point2<f64> {
        Point2::new(self.fx * moved.x + self.cx, self.fy * moved.y + self.cy)
    }
}
