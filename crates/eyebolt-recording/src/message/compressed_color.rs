//! `sensor_msgs/CompressedImage` with a picture for people in it: JPEG or PNG.

use super::wire::WireProblem;
use crate::color::ColorImage;
use crate::png_image::PngImage;
use std::io::Cursor;
use std::path::Path;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

const PNG: [u8; 8] = [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'];
const JPEG: [u8; 3] = [0xff, 0xd8, 0xff];
/// Longest side of a picture, pixels.
const LONGEST_SIDE: usize = 8192;

/// The picture that `data` hold. What they are, their first bytes tell: the format that a message
/// claims is spelled in many ways.
pub(crate) fn color(data: &[u8]) -> Result<ColorImage, WireProblem> {
    if data.starts_with(&PNG) {
        // The path is for messages, and whoever reports the problem knows a better one.
        return PngImage::parse(Path::new(""), "data", data, None, true)
            .map(ColorImage::from)
            .map_err(|error| WireProblem::new("data", error.problem()));
    }
    if !data.starts_with(&JPEG) {
        return Err(WireProblem::new("data", "the picture is neither JPEG nor PNG"));
    }
    let failed = |error: &dyn std::fmt::Display| {
        WireProblem::new("data", format!("the JPEG cannot be decoded: {error}"))
    };
    let mut decoder = jpeg(data);
    let pixels = decoder.decode().map_err(|error| failed(&error))?;
    let (width, height) = decoder.dimensions().ok_or_else(|| failed(&"it has no size"))?;
    let rgb = pixels.as_chunks::<3>().0.to_vec();
    if rgb.len() != width * height {
        return Err(failed(&"it is cut short"));
    }
    // No longer than the longest side.
    Ok(ColorImage { width: width as u32, height: height as u32, rgb })
}

/// Width and height of the picture that `data` hold; `None` where they do not tell.
pub(crate) fn size(data: &[u8]) -> Option<(u32, u32)> {
    if data.starts_with(&PNG) {
        let number = |at: usize| Some(u32::from_be_bytes(*data.get(at..)?.first_chunk::<4>()?));
        // After the signature come the length and the name of the chunk.
        return Some((number(16)?, number(20)?));
    }
    let mut decoder = jpeg(data);
    decoder.decode_headers().ok()?;
    let (width, height) = decoder.dimensions()?;
    Some((u32::try_from(width).ok()?, u32::try_from(height).ok()?))
}

fn jpeg(data: &[u8]) -> JpegDecoder<Cursor<&[u8]>> {
    let options = DecoderOptions::default()
        .set_max_width(LONGEST_SIDE)
        .set_max_height(LONGEST_SIDE)
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    JpegDecoder::new_with_options(Cursor::new(data), options)
}
