//! Pictures in PNG.

use png::{BitDepth, ColorType, Encoder, EncodingError};

/// Depth in whole millimetres as 16-bit grey.
pub(super) fn depth(width: u32, height: u32, depth_m: &[f32]) -> Result<Vec<u8>, EncodingError> {
    // Saturates; what is not known is zero already.
    let values = depth_m.iter().map(|z| (1e3 * z).round() as u16);
    let data: Vec<u8> = values.flat_map(u16::to_be_bytes).collect();
    encode(width, height, ColorType::Grayscale, BitDepth::Sixteen, &data)
}

/// White where `set`, black elsewhere.
pub(super) fn mask(width: u32, height: u32, set: &[bool]) -> Result<Vec<u8>, EncodingError> {
    let data: Vec<u8> = set.iter().map(|set| if *set { 255 } else { 0 }).collect();
    encode(width, height, ColorType::Grayscale, BitDepth::Eight, &data)
}

/// A colour picture.
pub(super) fn rgb(width: u32, height: u32, rgb: &[[u8; 3]]) -> Result<Vec<u8>, EncodingError> {
    encode(width, height, ColorType::Rgb, BitDepth::Eight, rgb.as_flattened())
}

fn encode(
    width: u32,
    height: u32,
    color: ColorType,
    depth: BitDepth,
    data: &[u8],
) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    encoder.write_header()?.write_image_data(data)?;
    Ok(bytes)
}
