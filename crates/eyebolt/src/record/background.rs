//! The scene without the arm, where the recording has seen it.

use super::error::RecordError;
use super::merge::median_depth;
use super::projection::Projection;
use super::reader::{MOST_FRAMES, check_size};
use crate::evenly::evenly;
use crate::observations::{Background, Configuration, ImageSource};
use eyebolt_geometry::DepthImage;
use eyebolt_recording::FrameSource;
use eyebolt_registration::Margin;

/// Of the pixels that both a configuration and the background have seen, so many show the same, if
/// it is the same scene from the same place: an arm and its shadow fill no more than the rest.
const LEAST_AGREEMENT: f64 = 0.5;

/// Median of the background frames of `source`, as far as they are of what `configurations` see.
pub(super) fn read(
    source: &dyn FrameSource,
    projection: &Projection,
    configurations: &[Configuration],
) -> Result<Background, RecordError> {
    let count = source.background_count();
    // Clouds that tell their camera, or have one made up, are not of the background's pixels.
    let same_pixels =
        matches!(projection.source, ImageSource::DepthImages | ImageSource::ProjectedClouds);
    if count == 0 || !same_pixels {
        return Ok(Background::None);
    }
    let indices: Vec<usize> = (0..count).collect();
    let mut images: Vec<DepthImage> = Vec::new();
    for index in evenly(&indices, MOST_FRAMES) {
        match source.read_background(index) {
            Err(error) if source.may_leave_out(&error) => {
                tracing::debug!(index, ?error, "background frame left out");
            }
            read => {
                let image = read?;
                check_size(&format!("background {index}"), &image, &projection.camera)?;
                images.push(image);
            }
        }
    }
    let Some(background) = median_depth(&images) else { return Ok(Background::None) };
    let of_this_scene = |configuration: &Configuration| {
        agreement(&background, &configuration.depth) >= LEAST_AGREEMENT
    };
    Ok(match configurations.iter().all(of_this_scene) {
        true => Background::Seen(background),
        false => Background::OfAnotherScene,
    })
}

/// Share of the pixels with depth in both images where it is the same.
fn agreement(background: &DepthImage, seen: &DepthImage) -> f64 {
    let pairs = background.depth_m().iter().zip(seen.depth_m());
    let (mut both, mut same) = (0_usize, 0_usize);
    for (behind, z) in pairs.filter(|(behind, z)| **behind > 0.0 && **z > 0.0) {
        both += 1;
        same += usize::from((z - behind).abs() < Margin::Moved.at_m(*behind));
    }
    same as f64 / both.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(depth_m: [f32; 4]) -> DepthImage {
        DepthImage::new(2, 2, depth_m.into()).unwrap()
    }

    #[test]
    fn pixels_without_depth_say_nothing() {
        let background = image([1.0, 2.0, 0.0, 1.5]);
        assert_eq!(agreement(&background, &background), 1.0);
        assert_eq!(agreement(&background, &image([1.0, 0.5, 3.0, 0.0])), 0.5);
        assert_eq!(agreement(&background, &image([0.0; 4])), 0.0);
    }
}
