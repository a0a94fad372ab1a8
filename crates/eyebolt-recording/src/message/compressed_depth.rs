//! `sensor_msgs/CompressedImage` with depth in it, as `compressed_depth_image_transport` writes it.

use super::compressed_color;
use super::header::Header;
use super::image::millimetres;
use super::rvl;
use super::wire::{WireProblem, WireReader};
use super::writer::WireWriter;
use crate::png_image::PngImage;
use png::{BitDepth, ColorType};
use std::path::Path;

/// A compressed picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CompressedImageMessage<'a> {
    pub(crate) header: Header<'a>,
    /// As in `16UC1; compressedDepth png`.
    pub(crate) format: &'a str,
    pub(crate) data: &'a [u8],
}

/// A decompressed depth image.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DecodedDepth {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) depth_m: Vec<f32>,
    /// Whether it was stored in millimetres.
    pub(crate) in_millimetres: bool,
}

/// Before the picture: a number for the format, and the two parameters of inverse depth.
const CONFIG_BYTES: usize = 12;

impl<'a> CompressedImageMessage<'a> {
    pub(crate) fn read(reader: &mut WireReader<'a>) -> Result<Self, WireProblem> {
        Ok(Self {
            header: Header::read(reader)?,
            format: reader.string("format")?,
            data: reader.blob("data")?,
        })
    }

    pub(crate) fn write(&self) -> Vec<u8> {
        let mut writer = WireWriter::new();
        self.header.write(&mut writer);
        writer.string(self.format);
        writer.blob(self.data);
        writer.finish()
    }

    /// Whether the picture is depth.
    pub(crate) fn is_depth(&self) -> bool {
        self.format.contains("compressedDepth")
    }

    /// Width and height of the picture, where its first bytes tell.
    pub(crate) fn size(&self) -> Option<(u32, u32)> {
        if !self.is_depth() {
            return compressed_color::size(self.data);
        }
        let picture = self.data.get(CONFIG_BYTES..)?;
        let number = |at: usize| Some(u32::from_le_bytes(*picture.get(at..)?.first_chunk::<4>()?));
        match self.format.rsplit(' ').next() {
            Some("rvl") => Some((number(0)?, number(4)?)),
            _ => compressed_color::size(picture),
        }
    }

    /// The depth in metres. Formats: `16UC1` or `32FC1`, `; compressedDepth`, then `png` (also where
    /// nothing is said) or `rvl`.
    pub(crate) fn depth(&self) -> Result<DecodedDepth, WireProblem> {
        let (encoding, how) = self.format.split_once(';').unwrap_or((self.format, ""));
        let config = self.data.first_chunk::<CONFIG_BYTES>();
        let (Some(config), true) = (config, self.is_depth()) else {
            let problem = format!("\"{}\" is no compressed depth", self.format);
            return Err(WireProblem::new("format", problem));
        };
        let picture = self.data.get(CONFIG_BYTES..).unwrap_or_default();
        let (width, height, values) = match how.rsplit(' ').next() {
            Some("rvl") => rvl::decode(picture)?,
            _ => png(picture)?,
        };
        let (depth_m, in_millimetres) = match encoding.trim() {
            "16UC1" | "mono16" => (values.into_iter().map(millimetres).collect(), true),
            "32FC1" => {
                let [_, _, _, _, a0, a1, a2, a3, b0, b1, b2, b3] = *config;
                let a = f32::from_le_bytes([a0, a1, a2, a3]);
                let b = f32::from_le_bytes([b0, b1, b2, b3]);
                (values.into_iter().map(|value| from_inverse(value, a, b)).collect(), false)
            }
            other => {
                let problem = format!("\"{other}\" is no depth; 16UC1 and 32FC1 are read");
                return Err(WireProblem::new("format", problem));
            }
        };
        Ok(DecodedDepth { width, height, depth_m, in_millimetres })
    }
}

/// Depth from its quantised inverse.
fn from_inverse(value: u16, a: f32, b: f32) -> f32 {
    if value == 0 { 0.0 } else { a / (f32::from(value) - b) }
}

fn png(bytes: &[u8]) -> Result<(u32, u32, Vec<u16>), WireProblem> {
    // The path is for messages, and whoever reports the problem knows a better one.
    let image = PngImage::parse(Path::new(""), "data", bytes, None, false)
        .map_err(|error| WireProblem::new("data", error.problem()))?;
    if (image.color, image.depth) != (ColorType::Grayscale, BitDepth::Sixteen) {
        let problem = format!("the PNG is {}, not 16-bit grey", image.kind());
        return Err(WireProblem::new("data", problem));
    }
    let samples = image.data.as_chunks::<2>().0;
    let values = samples.iter().map(|bytes| u16::from_be_bytes(*bytes)).collect();
    Ok((image.width, image.height, values))
}
