//! Yes or no for every pixel.

use crate::image::{ImageError, check_size};

/// A set of pixels, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mask {
    width: u32,
    height: u32,
    set: Vec<bool>,
}

impl Mask {
    /// From one value per pixel, row by row.
    ///
    /// # Errors
    ///
    /// An empty image, or another number of values than `width * height`.
    pub fn new(width: u32, height: u32, set: Vec<bool>) -> Result<Self, ImageError> {
        check_size(width, height, set.len())?;
        Ok(Self { width, height, set })
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// One value per pixel, row by row.
    pub fn as_slice(&self) -> &[bool] {
        &self.set
    }

    /// Whether pixel `(u, v)` is in the set; no pixel off the image is.
    pub fn at(&self, u: u32, v: u32) -> bool {
        let index = v as usize * self.width as usize + u as usize;
        u < self.width && v < self.height && self.set.get(index).copied().unwrap_or(false)
    }

    /// How many pixels are in the set.
    pub fn count(&self) -> usize {
        self.set.iter().filter(|s| **s).count()
    }

    /// The pixels that are not in the set.
    #[must_use]
    pub fn inverted(&self) -> Self {
        Self { set: self.set.iter().map(|s| !s).collect(), ..*self }
    }

    /// Every pixel with a pixel of the set within `radius` in both directions.
    ///
    /// Takes the same time for any radius.
    #[must_use]
    pub fn dilated(&self, radius: u32) -> Self {
        self.grown(radius, true)
    }

    /// Every pixel with only pixels of the set within `radius` in both directions; what lies off
    /// the image takes nothing away.
    #[must_use]
    pub fn eroded(&self, radius: u32) -> Self {
        self.grown(radius, false)
    }

    /// Grows the pixels equal to `value` over their square neighbourhood: rows, then columns.
    fn grown(&self, radius: u32, value: bool) -> Self {
        let width = self.width as usize;
        let radius = radius as usize;
        let mut rows = Vec::with_capacity(self.set.len());
        for row in self.set.chunks_exact(width) {
            grow_row(row, radius, value, &mut rows);
        }
        Self { set: grow_columns(&rows, width, radius, value), ..*self }
    }
}

/// Appends `row` with its pixels equal to `value` grown by `radius` on either side.
fn grow_row(row: &[bool], radius: usize, value: bool, out: &mut Vec<bool>) {
    let mut inside = row.iter().take(radius).filter(|s| **s == value).count();
    for u in 0..row.len() {
        inside += usize::from(row.get(u.saturating_add(radius)) == Some(&value));
        let left = u.checked_sub(radius.saturating_add(1)).and_then(|i| row.get(i));
        inside -= usize::from(left == Some(&value));
        out.push(if inside > 0 { value } else { !value });
    }
}

/// Grows the pixels equal to `value` by `radius` up and down, counting all columns side by side.
fn grow_columns(rows: &[bool], width: usize, radius: usize, value: bool) -> Vec<bool> {
    let height = rows.len() / width;
    let row = |v: usize| rows.chunks_exact(width).nth(v).unwrap_or(&[]);
    let mut inside = vec![0_u32; width];
    let add = |inside: &mut [u32], v: usize| {
        for (count, s) in inside.iter_mut().zip(row(v)) {
            *count += u32::from(*s == value);
        }
    };
    for v in 0..radius.min(height) {
        add(&mut inside, v);
    }
    let mut out = Vec::with_capacity(rows.len());
    for v in 0..height {
        add(&mut inside, v.saturating_add(radius));
        if let Some(gone) = v.checked_sub(radius.saturating_add(1)) {
            for (count, s) in inside.iter_mut().zip(row(gone)) {
                *count -= u32::from(*s == value);
            }
        }
        out.extend(inside.iter().map(|count| if *count > 0 { value } else { !value }));
    }
    out
}
