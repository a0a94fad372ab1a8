//! Grey pictures.

use eyebolt_geometry::ImageError;

/// An 8-bit grey picture, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GreyImage {
    width: usize,
    height: usize,
    values: Vec<u8>,
}

impl GreyImage {
    /// From one value per pixel, row by row.
    ///
    /// # Errors
    ///
    /// An empty picture, or another number of values than `width * height`.
    pub fn new(width: u32, height: u32, values: Vec<u8>) -> Result<Self, ImageError> {
        let expected = u64::from(width) * u64::from(height);
        if expected == 0 || usize::try_from(expected) != Ok(values.len()) {
            return Err(ImageError::Size { width, height, values: values.len() });
        }
        Ok(Self { width: width as usize, height: height as usize, values })
    }

    /// From pixels of `[red, green, blue]`, with the weights of ITU-R BT.601, as OpenCV has them.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn from_rgb(width: u32, height: u32, rgb: &[[u8; 3]]) -> Result<Self, ImageError> {
        let grey = |[r, g, b]: &[u8; 3]| {
            // 14 bits behind the point; the weights sum to one.
            let sum = 4899 * u32::from(*r) + 9617 * u32::from(*g) + 1868 * u32::from(*b);
            ((sum + (1 << 13)) >> 14) as u8
        };
        Self::new(width, height, rgb.iter().map(grey).collect())
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// One value per pixel, row by row.
    pub fn values(&self) -> &[u8] {
        &self.values
    }

    /// Row `v`; empty below the picture.
    pub(crate) fn row(&self, v: usize) -> &[u8] {
        self.values.get(v * self.width..(v + 1) * self.width).unwrap_or_default()
    }

    /// The brightness between pixel centres, bilinear; `None` off the picture.
    #[inline]
    pub(crate) fn sample(&self, x: f64, y: f64) -> Option<f64> {
        // False for NaN too.
        if !(x >= 0.0 && y >= 0.0) {
            return None;
        }
        let (u, v) = (x as usize, y as usize);
        if u + 1 >= self.width || v + 1 >= self.height {
            return None;
        }
        let (fx, fy) = (x - u as f64, y - v as f64);
        let at = v * self.width + u;
        let [a, b] = *self.values.get(at..)?.first_chunk::<2>()?;
        let [c, d] = *self.values.get(at + self.width..)?.first_chunk::<2>()?;
        let mix = |a: u8, b: u8| f64::from(a) + fx * (f64::from(b) - f64::from(a));
        let (top, bottom) = (mix(a, b), mix(c, d));
        Some(top + fy * (bottom - top))
    }
}
