//! The camera of a folder, as far as its pictures tell of it.

use crate::camera_info::{CameraInfo, PictureForm};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::manifest::{Manifest, RangeKind};
use crate::npy::{Dtype, Npy};
use crate::png_image::PngImage;

/// The camera that `manifest` names, of pictures like that of the frame `first`.
pub(super) fn camera(
    manifest: &Manifest,
    first: Option<&String>,
) -> Result<Option<CameraInfo>, RecordingError> {
    let Some(path) = manifest.camera_info.as_deref() else { return Ok(None) };
    let picture =
        PictureForm { rectified: false, size: first.and_then(|name| size(manifest, name)) };
    let info = CameraInfo::read_for(path, picture)?;
    let told = info.depth_unit_m.and_then(DepthUnit::of_metres);
    let other = told.filter(|told| !told.is_about(manifest.unit));
    // Floats may be in metres, whatever the integers of others are.
    match other.filter(|_| manifest.kind == RangeKind::Depth && manifest.unit != DepthUnit::METRES)
    {
        None => Ok(Some(info)),
        Some(told) => {
            let problem =
                format!("{} is written here, but the camera's file says {told} m", manifest.unit);
            let remedy = "Correct the one that is wrong";
            Err(RecordingError::invalid(&manifest.path, "frames.depth_unit", problem, remedy))
        }
    }
}

/// Width and height of the picture of a frame; `None` if it cannot be read, which is told later.
fn size(manifest: &Manifest, name: &str) -> Option<(u32, u32)> {
    if manifest.kind != RangeKind::Depth {
        return None;
    }
    let path = manifest.range.path(name);
    if manifest.range.extension() == "png" {
        let image = PngImage::read(&path, "depth", None, false).ok()?;
        return Some((image.width, image.height));
    }
    let accepted = [Dtype::Float32, Dtype::Float64, Dtype::Uint16];
    let npy = Npy::read(&path, "depth", &accepted).ok()?;
    let &[height, width] = npy.shape() else { return None };
    Some((u32::try_from(width).ok()?, u32::try_from(height).ok()?))
}
