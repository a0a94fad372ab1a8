//! A depth image with fewer pixels.

use eyebolt_geometry::{DepthImage, PinholeCamera};
use nalgebra::Point2;
use rayon::prelude::*;
use std::ops::Range;

/// A depth image, or a part of one, binned to about as many columns as a network takes.
///
/// Networks see an image at one width whatever the camera's, and geometry by its metres, not by its
/// pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Thinned {
    /// Pixels in a row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Pixels of the full image along an edge of a bin.
    pub step: usize,
    /// Column and row of the full image where the first bin begins.
    pub corner: [usize; 2],
    /// Depth, row by row, metres; 0 where there is none.
    pub depth_m: Vec<f32>,
    /// Of each pixel `x / z` and `y / z` of the ray through its middle.
    pub rays: Vec<[f32; 2]>,
}

/// Of a bin's pixels, at least one of so many has to have depth.
const ONE_OF: usize = 4;

impl Thinned {
    /// `depth` of `camera` in about `columns` columns: each pixel the lower median of its bin, which is
    /// a depth that was measured, not one between the arm and the wall.
    pub fn new(depth: &DepthImage, camera: &PinholeCamera, columns: usize) -> Self {
        let step = step(camera, columns);
        let (width, height) = (camera.width() as usize, camera.height() as usize);
        Self::part(depth, camera, [0..width, 0..height], step)
    }

    /// These columns and rows of `depth`, in bins of `step` pixels along an edge; what is left beside
    /// the last whole one is not seen.
    pub fn part(
        depth: &DepthImage,
        camera: &PinholeCamera,
        [columns, lines]: [Range<usize>; 2],
        step: usize,
    ) -> Self {
        let [width, height] = [&columns, &lines].map(|range| range.len() / step);
        let corner = [columns.start, lines.start];
        let full = depth.depth_m();
        let stride = depth.width() as usize;
        let rows = (0..height).into_par_iter().flat_map_iter(|v| {
            let mut bin = Vec::with_capacity(step * step);
            (0..width).map(move |u| {
                bin.clear();
                for row in corner[1] + v * step..corner[1] + (v + 1) * step {
                    let start = row * stride + corner[0] + u * step;
                    bin.extend(full[start..start + step].iter().filter(|z| **z > 0.0));
                }
                median(&mut bin, step * step)
            })
        });
        let depth_m = rows.collect();
        Self {
            width,
            height,
            step,
            corner,
            depth_m,
            rays: rays(camera, [width, height], corner, step),
        }
    }

    /// Point of a pixel in the camera's frame, metres.
    pub fn point(&self, at: usize) -> [f32; 3] {
        let ([x, y], z) = (self.rays[at], self.depth_m[at]);
        [x * z, y * z, z]
    }

    /// Row-major pixels that have depth.
    pub fn seen(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.depth_m.len()).filter(|at| self.depth_m[*at] > 0.0)
    }
}

/// Edge of a bin in pixels of `camera`, for about `columns` columns.
pub fn step(camera: &PinholeCamera, columns: usize) -> usize {
    let (width, height) = (camera.width() as usize, camera.height() as usize);
    let rounded = (width as f64 / columns.max(1) as f64).round() as usize;
    rounded.clamp(1, width.min(height))
}

/// `x / z` and `y / z` of the middle of each bin; of pixels that the lens does not see, those on the axis.
fn rays(
    camera: &PinholeCamera,
    [width, height]: [usize; 2],
    [left, top]: [usize; 2],
    step: usize,
) -> Vec<[f32; 2]> {
    let middle = |start: usize, bin: usize| (start + bin * step) as f64 + 0.5 * (step as f64 - 1.0);
    let place = |u: usize, v: usize| Point2::new(middle(left, u), middle(top, v));
    let pixels = (0..height).flat_map(|v| (0..width).map(move |u| place(u, v)));
    pixels
        .map(|pixel| camera.ray(&pixel).map_or([0.0; 2], |ray| [ray.x as f32, ray.y as f32]))
        .collect()
}

fn median(bin: &mut [f32], pixels: usize) -> f32 {
    if bin.len() * ONE_OF < pixels || bin.is_empty() {
        return 0.0;
    }
    let middle = (bin.len() - 1) / 2;
    *bin.select_nth_unstable_by(middle, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyebolt_geometry::Distortion;

    #[test]
    fn bins_hold_a_measured_depth_and_keep_their_rays() {
        let camera = PinholeCamera::new(8, 4, 6.0, 6.0, 3.5, 1.5, Distortion::None).unwrap();
        let mut depth_m = vec![2.0; 32];
        // A bin with an edge through it, and one with a single pixel of four.
        (depth_m[0], depth_m[1]) = (1.0, 1.0);
        (depth_m[2], depth_m[3], depth_m[10]) = (0.0, 0.0, 0.0);
        let depth = DepthImage::new(8, 4, depth_m).unwrap();
        let thinned = Thinned::new(&depth, &camera, 4);
        assert_eq!((thinned.width, thinned.height, thinned.step), (4, 2, 2));
        assert_eq!(thinned.depth_m[..2], [1.0, 2.0]);
        let binned = camera.scaled(2).unwrap();
        for (at, [x, y]) in thinned.rays.iter().enumerate() {
            let ray = binned.ray(&Point2::new((at % 4) as f64, (at / 4) as f64)).unwrap();
            assert!((ray.x as f32 - x).abs() < 1e-6 && (ray.y as f32 - y).abs() < 1e-6);
        }
    }
}
