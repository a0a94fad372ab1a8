//! Pictures in PNG.

use crate::error::RecordingError;
use crate::file::{DATA_LIMIT, read_bytes};
use png::{BitDepth, ColorType, DecodingError, Reader, Transformations};
use std::io::Cursor;
use std::path::Path;

/// Most pixels of a picture.
const MOST_PIXELS: u64 = 100_000_000;

/// Most bytes that DEFLATE makes of one, with some room for what is not picture data.
const LARGEST_EXPANSION: u64 = 1040;

/// A decoded picture: grey, grey + alpha, RGB or RGBA, of 8 or 16 bits (big-endian) a sample.
pub(crate) struct PngImage {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) color: ColorType,
    pub(crate) depth: BitDepth,
    pub(crate) data: Vec<u8>,
}

/// What a picture must be as large as: width, height and what has that size.
pub(crate) type Expected<'a> = (u32, u32, &'a str);

impl PngImage {
    /// Reads the picture at `path`, which is `field` to the recording.
    ///
    /// Palettes become RGB, samples of less than 8 bits become 8, and with `strip_16` those of 16
    /// too. A picture of another size than `expected` is refused before it is decoded.
    pub(crate) fn read(
        path: &Path,
        field: &str,
        expected: Option<Expected<'_>>,
        strip_16: bool,
    ) -> Result<Self, RecordingError> {
        let bytes = read_bytes(path, field, DATA_LIMIT)?;
        Self::parse(path, field, &bytes, expected, strip_16)
    }

    /// As [`PngImage::read`], from bytes; `path` is for messages.
    pub(crate) fn parse(
        path: &Path,
        field: &str,
        bytes: &[u8],
        expected: Option<Expected<'_>>,
        strip_16: bool,
    ) -> Result<Self, RecordingError> {
        let damaged = |error: DecodingError| {
            let problem = format!("the PNG cannot be decoded: {error}");
            RecordingError::invalid(path, field, problem, "Store it as PNG again")
        };
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_ignore_text_chunk(true);
        decoder.set_ignore_iccp_chunk(true);
        let strip = if strip_16 { Transformations::STRIP_16 } else { Transformations::IDENTITY };
        decoder.set_transformations(Transformations::EXPAND | strip);
        let info = decoder.read_header_info().map_err(damaged)?;
        check_size(path, field, info.size(), expected)?;
        check_expansion(path, field, info.raw_bytes() as u64, bytes.len() as u64)?;
        let mut reader = decoder.read_info().map_err(damaged)?;
        if reader.info().is_animated() {
            let remedy = "Store every frame as a PNG of its own";
            return Err(RecordingError::invalid(path, field, "the PNG is animated", remedy));
        }
        Self::decode(&mut reader).map_err(damaged)
    }

    fn decode(reader: &mut Reader<Cursor<&[u8]>>) -> Result<Self, DecodingError> {
        let size = reader.output_buffer_size().ok_or(DecodingError::LimitsExceeded)?;
        let mut data = vec![0; size];
        let info = reader.next_frame(&mut data)?;
        data.truncate(info.buffer_size());
        let (width, height) = (info.width, info.height);
        Ok(Self { width, height, color: info.color_type, depth: info.bit_depth, data })
    }

    /// Bytes of a pixel.
    pub(crate) fn pixel_size(&self) -> usize {
        self.color.samples() * if self.depth == BitDepth::Sixteen { 2 } else { 1 }
    }

    /// What kind of picture it is, for messages.
    pub(crate) fn kind(&self) -> String {
        let color = match self.color {
            ColorType::Grayscale => "grey",
            ColorType::GrayscaleAlpha => "grey with alpha",
            ColorType::Rgb => "RGB",
            ColorType::Rgba => "RGBA",
            ColorType::Indexed => "palette",
        };
        format!("{}-bit {color}", self.depth as u8)
    }
}

fn check_size(
    path: &Path,
    field: &str,
    (width, height): (u32, u32),
    expected: Option<Expected<'_>>,
) -> Result<(), RecordingError> {
    if u64::from(width) * u64::from(height) > MOST_PIXELS {
        return Err(RecordingError::invalid(
            path,
            field,
            format!("the picture is {width} x {height}, more than 100 megapixels"),
            "Name the right file, or scale the picture down",
        ));
    }
    match expected {
        Some((w, h, what)) if (w, h) != (width, height) => Err(RecordingError::invalid(
            path,
            field,
            format!("the picture is {width} x {height}, but {what} is {w} x {h}"),
            "Both must be of the same camera and size",
        )),
        _ => Ok(()),
    }
}

/// Refuses a picture too large for the bytes of its file before memory is asked for it.
fn check_expansion(path: &Path, field: &str, raw: u64, stored: u64) -> Result<(), RecordingError> {
    if raw / LARGEST_EXPANSION > stored {
        return Err(RecordingError::invalid(
            path,
            field,
            format!("{stored} bytes of PNG cannot hold the {raw} bytes of the picture"),
            "The file is damaged or cut short: copy or write it again",
        ));
    }
    Ok(())
}
