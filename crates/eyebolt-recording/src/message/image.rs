//! `sensor_msgs/Image`.

use super::header::Header;
use super::wire::{WireProblem, WireReader};
use super::writer::WireWriter;
use eyebolt_geometry::Mask;

/// An uncompressed picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ImageMessage<'a> {
    pub(crate) header: Header<'a>,
    pub(crate) height: u32,
    pub(crate) width: u32,
    /// As in `16UC1` or `rgb8`.
    pub(crate) encoding: &'a str,
    pub(crate) big_endian: bool,
    /// Bytes from one row to the next.
    pub(crate) step: u32,
    pub(crate) data: &'a [u8],
}

/// Whether pictures of this encoding can be depth: `16UC1` (millimetres) or `32FC1` (metres).
pub(crate) fn is_depth_encoding(encoding: &str) -> bool {
    matches!(encoding, "16UC1" | "mono16" | "32FC1")
}

/// Largest picture, pixels: twice that of any depth camera.
const MOST_PIXELS: usize = 1 << 25;

impl<'a> ImageMessage<'a> {
    pub(crate) fn read(reader: &mut WireReader<'a>) -> Result<Self, WireProblem> {
        Ok(Self {
            header: Header::read(reader)?,
            height: reader.u32("height")?,
            width: reader.u32("width")?,
            encoding: reader.string("encoding")?,
            big_endian: reader.bool("is_bigendian")?,
            step: reader.u32("step")?,
            data: reader.blob("data")?,
        })
    }

    pub(crate) fn write(&self) -> Vec<u8> {
        let mut writer = WireWriter::new();
        self.header.write(&mut writer);
        writer.u32(self.height);
        writer.u32(self.width);
        writer.string(self.encoding);
        writer.bool(self.big_endian);
        writer.u32(self.step);
        writer.blob(self.data);
        writer.finish()
    }

    /// Depth in metres as stored, of `width * height` pixels, and whether it was millimetres.
    pub(crate) fn depth_m(&self) -> Result<(Vec<f32>, bool), WireProblem> {
        let big = self.big_endian;
        match self.encoding {
            "16UC1" | "mono16" => {
                let rows = self.rows(2)?;
                let depth = rows.flat_map(|row| {
                    let values = row.as_chunks::<2>().0.iter().map(move |bytes| match big {
                        true => u16::from_be_bytes(*bytes),
                        false => u16::from_le_bytes(*bytes),
                    });
                    values.map(millimetres)
                });
                Ok((depth.collect(), true))
            }
            "32FC1" => {
                let rows = self.rows(4)?;
                let depth = rows.flat_map(|row| {
                    row.as_chunks::<4>().0.iter().map(move |bytes| match big {
                        true => f32::from_be_bytes(*bytes),
                        false => f32::from_le_bytes(*bytes),
                    })
                });
                Ok((depth.collect(), false))
            }
            other => {
                let problem = format!("\"{other}\" is no depth; 16UC1 and 32FC1 are read");
                Err(WireProblem::new("encoding", problem))
            }
        }
    }

    /// Whether a pixel has depth, of a picture in an encoding of depth.
    pub(crate) fn has_depth(&self) -> Result<bool, WireProblem> {
        let number = |bytes: [u8; 4]| match self.big_endian {
            true => f32::from_be_bytes(bytes),
            false => f32::from_le_bytes(bytes),
        };
        Ok(match self.encoding {
            "32FC1" => self
                .rows(4)?
                .flat_map(|row| row.as_chunks::<4>().0)
                .any(|bytes| number(*bytes).is_finite() && number(*bytes) > 0.0),
            // In either order of the bytes.
            _ => self
                .rows(2)?
                .flat_map(|row| row.as_chunks::<2>().0)
                .any(|bytes| !matches!(bytes, [0, 0] | [u8::MAX, u8::MAX])),
        })
    }

    /// Depth as stored of about `count` pixels, the same ones in every picture of a size.
    pub(crate) fn depth_samples(&self, count: usize) -> Result<Vec<f32>, WireProblem> {
        let pixel_size = if self.encoding == "32FC1" { 4 } else { 2 };
        let rows = self.rows(pixel_size)?;
        let pixels = self.width as usize * self.height as usize;
        // One more, so that samples do not stand in columns.
        let stride = pixels / count.max(1) + 1;
        let mut samples = Vec::with_capacity(pixels / stride + 1);
        let (mut next, mut start) = (0, 0);
        for row in rows {
            let end = start + self.width as usize;
            while next < end {
                samples.push(self.number(row, next - start, pixel_size));
                next += stride;
            }
            start = end;
        }
        Ok(samples)
    }

    /// The number of a pixel of `size` bytes in a row.
    fn number(&self, row: &[u8], pixel: usize, size: usize) -> f32 {
        let bytes = row.get(pixel * size..(pixel + 1) * size).unwrap_or_default();
        match (bytes, self.big_endian) {
            ([a, b], false) => f32::from(u16::from_le_bytes([*a, *b])),
            ([a, b], true) => f32::from(u16::from_be_bytes([*a, *b])),
            ([a, b, c, d], false) => f32::from_le_bytes([*a, *b, *c, *d]),
            ([a, b, c, d], true) => f32::from_be_bytes([*a, *b, *c, *d]),
            _ => 0.0,
        }
    }

    /// Whether the data hold the picture, where its encoding is known.
    pub(crate) fn check(&self) -> Result<(), WireProblem> {
        let pixel_size = match self.encoding {
            "mono8" | "8UC1" => 1,
            "16UC1" | "mono16" => 2,
            "rgb8" | "bgr8" => 3,
            "32FC1" | "rgba8" | "bgra8" => 4,
            _ => return Ok(()),
        };
        self.rows(pixel_size).map(drop)
    }

    /// The picture as `[red, green, blue]`; `None` for encodings of no colour picture.
    pub(crate) fn rgb(&self) -> Result<Option<Vec<[u8; 3]>>, WireProblem> {
        fn pixels<const N: usize>(
            image: &ImageMessage<'_>,
            color: impl Fn([u8; N]) -> [u8; 3],
        ) -> Result<Option<Vec<[u8; 3]>>, WireProblem> {
            let rows = image.rows(N)?;
            let pixels = rows.flat_map(|row| row.as_chunks::<N>().0.iter().map(|p| color(*p)));
            Ok(Some(pixels.collect()))
        }
        match self.encoding {
            "rgb8" => pixels(self, |[r, g, b]| [r, g, b]),
            "bgr8" => pixels(self, |[b, g, r]| [r, g, b]),
            "rgba8" => pixels(self, |[r, g, b, _]| [r, g, b]),
            "bgra8" => pixels(self, |[b, g, r, _]| [r, g, b]),
            "mono8" | "8UC1" => pixels(self, |[v]| [v; 3]),
            _ => Ok(None),
        }
    }

    /// The pixels that are not zero, of a picture with one byte a pixel.
    pub(crate) fn mask(&self) -> Result<Mask, WireProblem> {
        if !matches!(self.encoding, "mono8" | "8UC1") {
            let problem = format!("\"{}\" is no mask; mono8 and 8UC1 are read", self.encoding);
            return Err(WireProblem::new("encoding", problem));
        }
        let set: Vec<bool> = self.rows(1)?.flatten().map(|value| *value != 0).collect();
        if !set.contains(&true) {
            return Err(WireProblem::new("data", "no pixel of the mask is set"));
        }
        Mask::new(self.width, self.height, set)
            .map_err(|error| WireProblem::new("data", error.to_string()))
    }

    /// The rows without what pads them.
    fn rows(&self, pixel_size: usize) -> Result<impl Iterator<Item = &'a [u8]>, WireProblem> {
        let (width, height, step) = (self.width as usize, self.height as usize, self.step as usize);
        if width == 0 || height == 0 || width.saturating_mul(height) > MOST_PIXELS {
            let problem = format!("{width} x {height} pixels");
            return Err(WireProblem::new("width", problem));
        }
        let row = width * pixel_size;
        if step < row {
            let problem = format!("{step} bytes do not hold {width} pixels of {pixel_size} bytes");
            return Err(WireProblem::new("step", problem));
        }
        // The last row may lack its padding.
        let least = step.saturating_mul(height - 1).saturating_add(row);
        if self.data.len() < least {
            let problem =
                format!("{} bytes do not hold {height} rows of {step} bytes", self.data.len());
            return Err(WireProblem::new("data", problem));
        }
        Ok(self.data.chunks(step).take(height).filter_map(move |bytes| bytes.get(..row)))
    }
}

/// Metres of a depth in millimetres; the largest number stands for "nothing seen".
pub(super) fn millimetres(value: u16) -> f32 {
    if value == u16::MAX { 0.0 } else { f32::from(value) * 1e-3 }
}
