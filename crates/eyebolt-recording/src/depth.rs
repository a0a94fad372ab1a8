//! Depth images in NPY and PNG.

use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::npy::{Dtype, Npy};
use crate::png_image::{Expected, PngImage};
use crate::unit_check::check_unit;
use eyebolt_geometry::DepthImage;
use png::{BitDepth, ColorType};
use std::path::Path;

const FIELD: &str = "depth";

/// What to do with a frame in which the camera saw nothing.
pub(crate) const LEAVE_OUT: &str = "Leave this frame out of the recording, or record it again";

/// Reads a depth image of the size of `camera`, stored in `unit`, that saw something.
pub(crate) fn read_depth(
    path: &Path,
    extension: &str,
    unit: DepthUnit,
    camera: Expected<'_>,
) -> Result<DepthImage, RecordingError> {
    let image = read_any_depth(path, extension, unit, camera)?;
    match image.depth_m().iter().any(|depth| *depth > 0.0) {
        true => Ok(image),
        false => Err(RecordingError::invalid(path, FIELD, "no pixel has depth", LEAVE_OUT)),
    }
}

/// As [`read_depth`], also of images that saw nothing.
pub(crate) fn read_any_depth(
    path: &Path,
    extension: &str,
    unit: DepthUnit,
    camera: Expected<'_>,
) -> Result<DepthImage, RecordingError> {
    let depth_m = match extension {
        "png" => from_png(path, unit, camera)?,
        _ => from_npy(path, unit, camera)?,
    };
    check_unit(path, FIELD, unit, depth_m.iter().copied())?;
    let (width, height, _) = camera;
    DepthImage::new(width, height, depth_m).map_err(|error| {
        RecordingError::invalid(path, FIELD, error.to_string(), "Store the whole image")
    })
}

fn from_npy(
    path: &Path,
    unit: DepthUnit,
    camera: Expected<'_>,
) -> Result<Vec<f32>, RecordingError> {
    let npy = Npy::read(path, FIELD, &[Dtype::Float32, Dtype::Float64, Dtype::Uint16])?;
    let (width, height, what) = camera;
    if npy.shape() != [height as usize, width as usize] {
        return Err(RecordingError::invalid(
            path,
            FIELD,
            format!(
                "the array is {} (rows x columns), but {what} is {height} x {width}",
                shape_text(npy.shape())
            ),
            "Both must be of the same camera and size",
        ));
    }
    if npy.dtype() == Dtype::Uint16 {
        check_integers(path, unit)?;
        return Ok(scaled(without_saturated(npy.values()), unit));
    }
    Ok(scaled(npy.values(), unit))
}

fn from_png(
    path: &Path,
    unit: DepthUnit,
    camera: Expected<'_>,
) -> Result<Vec<f32>, RecordingError> {
    check_integers(path, unit)?;
    let image = PngImage::read(path, FIELD, Some(camera), false)?;
    if (image.color, image.depth) != (ColorType::Grayscale, BitDepth::Sixteen) {
        let problem = format!("the PNG is {}, not 16-bit grey", image.kind());
        let remedy = "Store depth as 16-bit grey PNG in millimetres; a picture of it has lost it";
        return Err(RecordingError::invalid(path, FIELD, problem, remedy));
    }
    let (samples, _) = image.data.as_chunks::<2>();
    let values = samples.iter().map(|bytes| f32::from(u16::from_be_bytes(*bytes))).collect();
    Ok(scaled(without_saturated(values), unit))
}

/// The largest 16-bit number stands for "nothing seen" with many drivers, and never for 65 m.
fn without_saturated(mut values: Vec<f32>) -> Vec<f32> {
    for value in values.iter_mut().filter(|value| **value == f32::from(u16::MAX)) {
        *value = 0.0;
    }
    values
}

/// Whole metres are no depth.
fn check_integers(path: &Path, unit: DepthUnit) -> Result<(), RecordingError> {
    if unit != DepthUnit::METRES {
        return Ok(());
    }
    Err(RecordingError::invalid(
        path,
        FIELD,
        "the depths are 16-bit integers, which cannot be metres",
        "Set depth_unit = \"mm\" in recording.toml, or the metres of one",
    ))
}

/// `values` in metres.
pub(crate) fn scaled(mut values: Vec<f32>, unit: DepthUnit) -> Vec<f32> {
    if unit != DepthUnit::METRES {
        let factor = unit.metres() as f32;
        values.iter_mut().for_each(|value| *value *= factor);
    }
    values
}

/// Lengths of axes as in `540 x 960`.
pub(crate) fn shape_text(shape: &[usize]) -> String {
    let axes: Vec<_> = shape.iter().map(ToString::to_string).collect();
    if axes.is_empty() { "a single number".to_owned() } else { axes.join(" x ") }
}
