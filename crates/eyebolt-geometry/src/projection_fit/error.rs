//! Why a cloud does not tell its camera.

use crate::camera::CameraError;

/// Why a cloud does not tell its camera.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProjectionFitError {
    /// The cloud has no grid.
    #[error("the cloud is not organised as an image: give the camera's intrinsics")]
    NoGrid,
    /// Too few valid points.
    #[error("{valid} valid points, {required} are needed to fit the camera")]
    TooFewPoints {
        /// How many there are.
        valid: usize,
        /// How many are needed.
        required: usize,
    },
    /// The points lie in too small a part of the image, or are not in general position.
    #[error("the points do not determine a camera: they lie along a line or are not an image")]
    Degenerate,
    /// The image is mirrored: no rotation maps the cloud to the pixels.
    #[error("rows or columns of the cloud run the wrong way: the image is mirrored")]
    Mirrored,
    /// No pinhole at the origin explains the points.
    #[error(
        "no pinhole camera at the cloud's origin fits: {outliers} of {points} points are off by \
         more than 3 pixels, the others by {residual_px:.3} pixels rms"
    )]
    NotAPinhole {
        /// Root mean square error of the points that fit, pixels.
        residual_px: f64,
        /// Points that do not fit.
        outliers: usize,
        /// Points looked at.
        points: usize,
    },
    /// The numbers found do not make a camera.
    #[error("the fit gave no camera: {0}")]
    Camera(#[from] CameraError),
}
