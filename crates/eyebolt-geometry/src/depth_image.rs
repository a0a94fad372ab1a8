//! Depth images.

use crate::image::{ImageError, check_size};

/// Depth along z of the optical frame, metres, row by row; 0 where there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthImage {
    width: u32,
    height: u32,
    depth_m: Vec<f32>,
}

impl DepthImage {
    /// From depths in metres, row by row. NaN, infinity and negative numbers become 0: no depth.
    ///
    /// # Errors
    ///
    /// An empty image, or another number of depths than `width * height`.
    pub fn new(width: u32, height: u32, mut depth_m: Vec<f32>) -> Result<Self, ImageError> {
        check_size(width, height, depth_m.len())?;
        for depth in &mut depth_m {
            // Negative zero becomes zero too.
            if !(depth.is_finite() && *depth > 0.0) {
                *depth = 0.0;
            }
        }
        Ok(Self { width, height, depth_m })
    }

    /// From depths that are known to be clean and to fill the image.
    pub(crate) fn from_clean(width: u32, height: u32, depth_m: Vec<f32>) -> Self {
        Self { width, height, depth_m }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All depths in metres, row by row; 0 where there is none.
    pub fn depth_m(&self) -> &[f32] {
        &self.depth_m
    }

    /// All depths in metres, row by row; 0 where there is none.
    pub fn into_depth_m(self) -> Vec<f32> {
        self.depth_m
    }

    /// Depth of pixel `(u, v)` in metres; 0 where there is none and off the image.
    pub fn at(&self, u: u32, v: u32) -> f32 {
        if u >= self.width || v >= self.height {
            return 0.0;
        }
        self.depth_m.get(v as usize * self.width as usize + u as usize).copied().unwrap_or(0.0)
    }

    /// Share of the pixels that have a depth, 0 to 1.
    pub fn share_valid(&self) -> f64 {
        let valid = self.depth_m.iter().filter(|d| **d > 0.0).count();
        valid as f64 / self.depth_m.len() as f64
    }
}
