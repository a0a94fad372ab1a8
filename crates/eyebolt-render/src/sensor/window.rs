//! What a matcher that compares windows makes of a disparity image.

use rayon::prelude::*;

/// Disparities that differ by more than this do not match together, pixels: the peak of a
/// correlation of random dots is about as wide as a dot, and a dot is about a pixel.
pub const APART_PX: f32 = 1.0;

/// A disparity image with the plane that lies at each of its pixels.
pub struct Disparities<'a> {
    /// Pixels in a row, and number of rows.
    pub size: [usize; 2],
    /// Disparity of each pixel; 0 where nothing can be matched.
    pub px: &'a [f32],
    /// Disparity of what is there, whether it can be matched or not; 0 where nothing is.
    pub truth_px: &'a [f32],
    /// How fast the disparity of the plane at each pixel grows along u and v.
    pub slope: &'a [[f32; 2]],
}

/// Another pixel, and how far away it is in the image.
#[derive(Clone, Copy, Debug)]
pub struct Neighbour {
    /// Row-major index.
    pub at: usize,
    /// Pixels.
    pub distance_px: f32,
}

/// What the window around a pixel has in common with its middle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Match {
    /// Share of its pixels whose disparity is that of the middle. What lies off the image or has no
    /// disparity does not match.
    pub share: f32,
    /// Mean angle between normal and ray of those that match, radians.
    pub angle_rad: f32,
}

/// The match of the window around each pixel, `2 half + 1` pixels wide and high, given the angle
/// between normal and ray at each pixel.
pub fn matches(image: &Disparities<'_>, angle_rad: &[f32], half: usize) -> Vec<Match> {
    let [width, height] = image.size;
    let whole = ((2 * half + 1) * (2 * half + 1)) as f32;
    let mut matches = vec![Match::default(); image.px.len()];
    matches.par_chunks_mut(width).enumerate().for_each(|(v, row)| {
        let rows = v.saturating_sub(half)..(v + half + 1).min(height);
        for (u, found) in row.iter_mut().enumerate() {
            let own = image.px[v * width + u];
            if own == 0.0 {
                continue;
            }
            let columns = u.saturating_sub(half)..(u + half + 1).min(width);
            let (mut count, mut angles) = (0.0, 0.0);
            for v in rows.clone() {
                let row = v * width + columns.start..v * width + columns.end;
                for (other, angle) in image.px[row.clone()].iter().zip(&angle_rad[row]) {
                    let like = *other > 0.0 && (*other - own).abs() < APART_PX;
                    count += if like { 1.0 } else { 0.0 };
                    angles += if like { *angle } else { 0.0 };
                }
            }
            *found = Match { share: count / whole, angle_rad: angles / count };
        }
    });
    matches
}

/// The nearest pixel of each within `reach_px` that matches something before the plane at the pixel.
pub fn nearest_in_front(image: &Disparities<'_>, reach_px: f64) -> Vec<Option<Neighbour>> {
    let [width, height] = image.size;
    let offsets = disc(reach_px);
    let greatest = greatest_around(image, reach_px.ceil() as usize);
    let mut nearest = vec![None; image.px.len()];
    nearest.par_chunks_mut(width).enumerate().for_each(|(v, row)| {
        for (u, found) in row.iter_mut().enumerate() {
            let here = v * width + u;
            let (own, [along_u, along_v]) = (image.truth_px[here], image.slope[here]);
            if greatest[here] <= own + APART_PX {
                continue;
            }
            *found = offsets.iter().find_map(|&(du, dv, distance_px)| {
                let u = u.checked_add_signed(du).filter(|u| *u < width)?;
                let v = v.checked_add_signed(dv).filter(|v| *v < height)?;
                let at = v * width + u;
                let plane = own + along_u * du as f32 + along_v * dv as f32;
                (image.px[at] > plane + APART_PX).then_some(Neighbour { at, distance_px })
            });
        }
    });
    nearest
}

/// Offsets of the pixels within `reach_px`, nearest first.
fn disc(reach_px: f64) -> Vec<(isize, isize, f32)> {
    let reach = reach_px.ceil() as isize;
    let square = (-reach..=reach).flat_map(|dv| (-reach..=reach).map(move |du| (du, dv)));
    let distance = |du: isize, dv: isize| ((du * du + dv * dv) as f64).sqrt();
    let mut offsets: Vec<_> = square
        .filter(|&(du, dv)| (du, dv) != (0, 0) && distance(du, dv) <= reach_px)
        .map(|(du, dv)| (du, dv, distance(du, dv) as f32))
        .collect();
    offsets.sort_by(|a, b| a.2.total_cmp(&b.2));
    offsets
}

/// The greatest disparity within `reach` pixels along u and v.
fn greatest_around(image: &Disparities<'_>, reach: usize) -> Vec<f32> {
    let [width, height] = image.size;
    let most = |values: &[f32]| values.iter().copied().fold(0.0, f32::max);
    let mut in_row = vec![0.0; image.px.len()];
    in_row.par_chunks_mut(width).zip(image.px.par_chunks(width)).for_each(|(to, from)| {
        for (u, greatest) in to.iter_mut().enumerate() {
            *greatest = most(&from[u.saturating_sub(reach)..(u + reach + 1).min(width)]);
        }
    });
    let mut around = vec![0.0; image.px.len()];
    around.par_chunks_mut(width).enumerate().for_each(|(v, to)| {
        for v in v.saturating_sub(reach)..(v + reach + 1).min(height) {
            for (greatest, other) in to.iter_mut().zip(&in_row[v * width..]) {
                *greatest = other.max(*greatest);
            }
        }
    });
    around
}

/// Where a pixel within `reach` pixels along u and v borders on one that is apart from it or on
/// one of the two that has no value.
pub fn near_edges(size: [usize; 2], values: &[f32], apart: f32, reach: usize) -> Vec<bool> {
    let [width, height] = size;
    let mut near = vec![false; values.len()];
    let differ = |a: f32, b: f32| (a - b).abs() > apart || (a == 0.0) != (b == 0.0);
    for v in 0..height {
        for u in 0..width {
            let here = values[v * width + u];
            let right = u + 1 < width && differ(here, values[v * width + u + 1]);
            let below = v + 1 < height && differ(here, values[(v + 1) * width + u]);
            if right || below {
                for v in v.saturating_sub(reach)..(v + reach + 1).min(height) {
                    let (first, last) = (u.saturating_sub(reach), (u + reach + 1).min(width));
                    near[v * width + first..v * width + last].fill(true);
                }
            }
        }
    }
    near
}
