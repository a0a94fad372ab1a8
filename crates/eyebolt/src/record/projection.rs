//! The camera whose images a recording's frames become.

use super::error::RecordError;
use crate::observations::ImageSource;
use eyebolt_geometry::{
    Camera, Cloud, DepthImage, Distortion, PinholeCamera, Transform, fit_projection,
};
use eyebolt_recording::{Frame, FrameSource, Range};
use nalgebra::{UnitQuaternion, Vector3};

/// A camera, and how its frame is turned against the optical frame that answers are for.
#[derive(Debug)]
pub(crate) struct Projection {
    pub camera: PinholeCamera,
    pub optical_from_camera: Transform<Camera, Camera>,
    pub source: ImageSource,
}

/// The camera of the recording; else the one that the grid of its clouds tells; else one that looks
/// at the middle of the cloud of `frame`. Masks of the recording count only with `use_masks`.
///
/// # Errors
///
/// No camera can be told, or one of more pixels than any has.
pub(crate) fn find(
    source: &dyn FrameSource,
    frame: &Frame,
    use_masks: bool,
) -> Result<Projection, RecordError> {
    let found = any_size(source, frame, use_masks)?;
    let pixels = found.camera.pixel_count();
    if pixels > MOST_PIXELS {
        let frame = frame.name.clone();
        let problem = format!("the camera has {pixels} pixels, more than {MOST_PIXELS}");
        return Err(RecordError::Projection { frame, problem });
    }
    Ok(found)
}

/// Images of more pixels would fill the memory.
const MOST_PIXELS: usize = 100_000_000;

fn any_size(
    source: &dyn FrameSource,
    frame: &Frame,
    use_masks: bool,
) -> Result<Projection, RecordError> {
    let cloud = match &frame.range {
        Range::Cloud(cloud) => Some(cloud),
        Range::Depth(_) => None,
    };
    if let Some(camera) = source.camera() {
        let source = match cloud {
            Some(_) => ImageSource::ProjectedClouds,
            None => ImageSource::DepthImages,
        };
        let optical_from_camera = Transform::identity();
        return Ok(Projection { camera: camera.clone(), optical_from_camera, source });
    }
    let failed = |problem: String| RecordError::Projection { frame: frame.name.clone(), problem };
    let Some(cloud) = cloud else { return Err(failed("depth images need a camera".to_owned())) };
    match fit_projection(cloud) {
        Ok(fit) => Ok(Projection {
            camera: fit.camera,
            optical_from_camera: turn(&fit.camera_from_cloud.inverse()),
            source: ImageSource::OrganisedClouds { residual_px: fit.residual_px },
        }),
        // Masks belong to the pixels of the grid, so the grid has to be understood.
        Err(problem) if use_masks && frame.mask.is_some() => Err(failed(problem.to_string())),
        Err(_) => looking_at(cloud).ok_or_else(|| failed(TOO_WIDE.to_owned())),
    }
}

const TOO_WIDE: &str = "the cloud has too few points, or does not lie within 70 degrees of one \
                        direction from its origin, so no camera can have seen it";

fn turn(rotation: &UnitQuaternion<f64>) -> Transform<Camera, Camera> {
    Transform::from_parts(Vector3::zeros(), *rotation)
}

/// Points for each pixel of an image that a cloud without a grid is drawn to: few enough holes.
const POINTS_PER_PIXEL: f64 = 3.0;
/// Tangent of the widest angle from the axis.
const WIDEST: f64 = 2.75;
/// Fewer points show no arm.
const FEWEST_POINTS: usize = 500;
/// Share of the points that has to be in view; stray ones need not.
const IN_VIEW: f64 = 0.98;

/// The range of `values` without the outermost hundredth on either side, widened by as much.
fn nearly_all(values: &mut [f64]) -> Option<(f64, f64)> {
    let strays = values.len() / 100;
    values.sort_unstable_by(f64::total_cmp);
    let (low, high) = (*values.get(strays)?, *values.get(values.len().checked_sub(1 + strays)?)?);
    let border = 0.02 * (high - low);
    Some((low - border, high + border))
}

/// A camera at the origin that looks at the middle of `cloud` and has it all in view.
fn looking_at(cloud: &Cloud) -> Option<Projection> {
    let sum: Vector3<f64> =
        cloud.valid().filter_map(|p| p.coords.cast::<f64>().try_normalize(1e-6)).sum();
    let axis = sum.try_normalize(1e-6)?;
    let camera_from_cloud =
        UnitQuaternion::rotation_between(&axis, &Vector3::z()).unwrap_or_else(|| {
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        });
    let (mut across, mut down): (Vec<f64>, Vec<f64>) = cloud
        .valid()
        .map(|point| camera_from_cloud * point.coords.cast::<f64>())
        .filter(|p| p.z > 0.0 && p.x.abs() < WIDEST * p.z && p.y.abs() < WIDEST * p.z)
        .map(|p| (p.x / p.z, p.y / p.z))
        .unzip();
    if (across.len() as f64) < IN_VIEW * cloud.count_valid() as f64 {
        return None;
    }
    let (low_x, high_x) = nearly_all(&mut across)?;
    let (low_y, high_y) = nearly_all(&mut down)?;
    let count = cloud.count_valid();
    let (width, height) = (high_x - low_x, high_y - low_y);
    // Points along a line have no image.
    if count < FEWEST_POINTS || width.min(height) < 0.01 * width.max(height) {
        return None;
    }
    let focal = (count as f64 / POINTS_PER_PIXEL / (width * height)).sqrt();
    let pixels = |extent: f64| (extent * focal).ceil() as u32 + 1;
    let (cx, cy) = (-low_x * focal, -low_y * focal);
    let camera =
        PinholeCamera::new(pixels(width), pixels(height), focal, focal, cx, cy, Distortion::None);
    Some(Projection {
        camera: camera.ok()?,
        optical_from_camera: turn(&camera_from_cloud.inverse()),
        source: ImageSource::DrawnClouds,
    })
}

impl Projection {
    /// What this camera saw in one frame.
    pub fn depth_image(&self, range: Range) -> DepthImage {
        match range {
            Range::Depth(image) => image,
            Range::Cloud(cloud) => self.cloud_depth(&cloud),
        }
    }

    /// Depth of a cloud along the camera's axis: pixel by pixel where the grid is the camera's,
    /// projected otherwise.
    pub fn cloud_depth(&self, cloud: &Cloud) -> DepthImage {
        let turned = cloud.rotated(&self.optical_from_camera.rotation().inverse());
        let (width, height) = (self.camera.width(), self.camera.height());
        if turned.grid() == Some((width, height)) {
            let depth = turned.points().iter().map(|p| p.z).collect();
            if let Ok(image) = DepthImage::new(width, height, depth) {
                return image;
            }
        }
        turned.to_depth_image(&self.camera)
    }
}
