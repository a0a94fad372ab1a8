//! What is darker than its surroundings.

use crate::grey::GreyImage;

/// A pixel has to be this much darker than the mean around it, of 255: less is noise.
const DARKER_BY: u32 = 7;

/// Dark pixels as 1 and others as 0, with a frame of zeros one pixel wide around them.
#[derive(Debug)]
pub(super) struct Binary {
    /// Width with the frame.
    pub stride: usize,
    /// `stride * (height + 2)` values.
    pub values: Vec<i8>,
}

/// Compares each pixel with the mean of the square of `2 radius + 1` pixels around it; the picture's
/// edge goes on beyond it. Takes the same time for any radius.
pub(super) fn darker_than_around(image: &GreyImage, radius: usize) -> Binary {
    let (width, height) = (image.width(), image.height());
    let stride = width + 2;
    let mut values = vec![0; stride * (height + 2)];
    let area = ((2 * radius + 1) * (2 * radius + 1)) as u32;
    let mut columns = vec![0_u32; width];
    let row = |v: isize| image.row(v.clamp(0, height as isize - 1) as usize);
    let radius = radius as isize;
    for v in -radius..radius {
        columns.iter_mut().zip(row(v)).for_each(|(sum, value)| *sum += u32::from(*value));
    }
    for (v, out) in values.chunks_exact_mut(stride).skip(1).take(height).enumerate() {
        let v = v as isize;
        columns.iter_mut().zip(row(v + radius)).for_each(|(sum, value)| *sum += u32::from(*value));
        let inner = out.get_mut(1..=width).unwrap_or_default();
        compare(&columns, row(v), radius, area, inner);
        columns.iter_mut().zip(row(v - radius)).for_each(|(sum, value)| *sum -= u32::from(*value));
    }
    Binary { stride, values }
}

/// One row: `columns` are sums over the square's height.
fn compare(columns: &[u32], row: &[u8], radius: isize, area: u32, out: &mut [i8]) {
    let last = columns.len() as isize - 1;
    let column = |u: isize| columns.get(u.clamp(0, last) as usize).copied().unwrap_or_default();
    let mut sum: u32 = (-radius..radius).map(column).sum();
    for (u, (value, out)) in row.iter().zip(out).enumerate() {
        let u = u as isize;
        sum += column(u + radius);
        // value + DARKER_BY <= the mean, rounded.
        let dark = (2 * (u32::from(*value) + DARKER_BY) - 1) * area <= 2 * sum;
        *out = i8::from(dark);
        sum -= column(u - radius);
    }
}
