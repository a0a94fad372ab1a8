//! Colour pictures in PNG, for people to look at.

use crate::error::RecordingError;
use crate::png_image::{Expected, PngImage};
use eyebolt_geometry::{Camera, PinholeCamera, Transform};
use png::ColorType;
use std::path::Path;

/// An 8-bit RGB picture, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColorImage {
    /// Pixels in a row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// `width * height` pixels of `[red, green, blue]`.
    pub rgb: Vec<[u8; 3]>,
}

/// A colour picture in its own pixels, with the camera that took it.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPicture {
    /// The picture.
    pub picture: ColorImage,
    /// The camera that took it.
    pub camera: PinholeCamera,
    /// From its optical frame to the depth optical frame.
    pub depth_from_color: Transform<Camera, Camera>,
}

/// Reads a picture, grey ones too, of the size of the range image where that is known.
pub(crate) fn read_color(
    path: &Path,
    range: Option<Expected<'_>>,
) -> Result<ColorImage, RecordingError> {
    PngImage::read(path, "color", range, true).map(ColorImage::from)
}

/// Of 8 bits a sample.
impl From<PngImage> for ColorImage {
    fn from(image: PngImage) -> Self {
        let rgb = match image.color {
            ColorType::Rgb => image.data.as_chunks::<3>().0.to_vec(),
            ColorType::Rgba => {
                image.data.as_chunks::<4>().0.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect()
            }
            ColorType::GrayscaleAlpha => {
                image.data.as_chunks::<2>().0.iter().map(|[v, _]| [*v; 3]).collect()
            }
            // Palettes have become RGB.
            ColorType::Grayscale | ColorType::Indexed => {
                image.data.iter().map(|v| [*v; 3]).collect()
            }
        };
        Self { width: image.width, height: image.height, rgb }
    }
}
