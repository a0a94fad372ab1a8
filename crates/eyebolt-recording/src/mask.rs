//! Masks of the arm in PNG.

use crate::error::RecordingError;
use crate::png_image::{Expected, PngImage};
use eyebolt_geometry::Mask;
use png::{BitDepth, ColorType};
use std::path::Path;

const FIELD: &str = "mask";

/// Reads a mask of the size of the range image. Pixels that are not black and not transparent are
/// the arm.
pub(crate) fn read_mask(path: &Path, range: Expected<'_>) -> Result<Mask, RecordingError> {
    let image = PngImage::read(path, FIELD, Some(range), false)?;
    let has_alpha = matches!(image.color, ColorType::GrayscaleAlpha | ColorType::Rgba);
    let sample = if image.depth == BitDepth::Sixteen { 2 } else { 1 };
    let set: Vec<bool> = match (image.pixel_size(), has_alpha) {
        // By far the most common, and the fastest.
        (1, _) => image.data.iter().map(|value| *value != 0).collect(),
        (size, false) => image.data.chunks_exact(size).map(any_set).collect(),
        (size, true) => image
            .data
            .chunks_exact(size)
            .filter_map(|pixel| pixel.split_at_checked(size - sample))
            .map(|(color, alpha)| any_set(color) && any_set(alpha))
            .collect(),
    };
    if !set.contains(&true) {
        return Err(RecordingError::invalid(
            path,
            FIELD,
            "no pixel is set",
            "Mark the arm in it, or leave this frame out of the recording",
        ));
    }
    Mask::new(image.width, image.height, set).map_err(|error| {
        RecordingError::invalid(path, FIELD, error.to_string(), "Store the whole mask")
    })
}

fn any_set(samples: &[u8]) -> bool {
    samples.iter().any(|value| *value != 0)
}
