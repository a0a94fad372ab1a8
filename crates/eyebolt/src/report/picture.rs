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
        self.encode(png::Compression::Fast)
    }

    /// As [`Self::encode_png`] in fewer bytes, which takes longer.
    pub(super) fn encode_small_png(&self) -> Vec<u8> {
        self.encode(png::Compression::Balanced)
    }

    /// Half as wide and high, each pixel the mean of four; a side that is 1 stays.
    pub(super) fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let row = self.width as usize;
        let mean = |at: usize| {
            let (u, v) = (2 * (at % width as usize), 2 * (at / width as usize));
            let pixels = [v * row + u, v * row + u + 1, (v + 1) * row + u, (v + 1) * row + u + 1];
            let near = pixels.map(|pixel| self.rgb.get(pixel).or(self.rgb.get(v * row + u)));
            let sum = |channel: usize| {
                let values = near.iter().flatten().map(|rgb| u32::from(rgb[channel]));
                values.sum::<u32>()
            };
            let count = near.iter().flatten().count().max(1) as u32;
            [0, 1, 2].map(|channel| ((sum(channel) + count / 2) / count) as u8)
        };
        let pixels = 0..width as usize * height as usize;
        Self::new(width, height, pixels.map(mean).collect())
    }

    fn encode(&self, compression: png::Compression) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(compression);
        // Only an empty picture, too few bytes or a full disk can fail, and there is none of them.
        let written = encoder.write_header().and_then(|mut writer| {
            writer.write_image_data(self.rgb.as_flattened())?;
            writer.finish()
        });
        written.expect("a picture has pixels, and memory takes them");
        bytes
    }
}
