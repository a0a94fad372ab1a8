//! A picture to draw on and to store.

/// Red, green, blue.
pub(super) type Rgb = [u8; 3];

/// An 8-bit RGB picture, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    height: u32,
    rgb: Vec<[u8; 3]>,
}

impl Picture {
    /// A picture of these pixels, row by row; neither side may be 0.
    pub(super) fn new(width: u32, height: u32, rgb: Vec<Rgb>) -> Self {
        assert_eq!(rgb.len(), width as usize * height as usize, "one colour for each pixel");
        Self { width, height, rgb }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// `[red, green, blue]` of every pixel, row by row.
    pub fn rgb(&self) -> &[[u8; 3]] {
        &self.rgb
    }

    /// Covers row-major pixel `at` with `color`, of which 1 hides all and 0 nothing. Pixels off the
    /// picture are left out.
    pub(super) fn blend(&mut self, at: usize, color: Rgb, opacity: f32) {
        let Some(pixel) = self.rgb.get_mut(at) else { return };
        let share = (opacity * 256.0) as i32;
        for (below, above) in pixel.iter_mut().zip(color) {
            let step = (i32::from(above) - i32::from(*below)) * share;
            *below = (i32::from(*below) + ((step + 128) >> 8)) as u8;
        }
    }

    /// [`Self::blend`] of all pixels of a rectangle, as far as it lies on the picture.
    pub(super) fn fill(
        &mut self,
        [left, top]: [u32; 2],
        [width, height]: [u32; 2],
        color: Rgb,
        opacity: f32,
    ) {
        let right = left.saturating_add(width).min(self.width);
        for v in top..top.saturating_add(height).min(self.height) {
            let row = v as usize * self.width as usize;
            for u in left..right {
                self.blend(row + u as usize, color, opacity);
            }
        }
    }

    /// The picture as a PNG file; the same bytes for the same picture.
    pub fn encode_png(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        // Only an empty picture, too few bytes or a full disk can fail, and there is none of them.
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(self.rgb.as_flattened())?;
            writer.finish()
        });
        written.expect("a picture has pixels, and memory takes them");
        bytes
    }
}
