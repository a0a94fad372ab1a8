//! What lies behind everything else: the scene, toned down so that colours on it stand out.

use super::picture::{Picture, Rgb};
use eyebolt_geometry::DepthImage;
use eyebolt_recording::ColorImage;

/// How much of its colour and of its light a colour picture keeps, in 256ths.
const SATURATION: i32 = 90;
const LIGHT: i32 = 175;
/// Greys of the farthest and nearest depths; what has no depth is darker than both.
const FAR_GREY: f32 = 40.0;
const NEAR_GREY: f32 = 185.0;
const NO_DEPTH_GREY: u8 = 12;
/// Shares of the depths that may lie beyond either end of the greys.
const BEYOND: f64 = 0.02;
/// Every how many pixels one tells how depths are spread; not a divisor of usual widths.
const STRIDE: usize = 17;

/// The colour picture stretched to `width` x `height` and toned down.
pub(super) fn from_color(color: &ColorImage, width: u32, height: u32) -> Picture {
    // In 64 bits no product of two sizes overflows.
    let source =
        |at: u32, size: u32, of: u32| (u64::from(at) * u64::from(of) / u64::from(size)) as usize;
    let columns: Vec<usize> = (0..width).map(|u| source(u, width, color.width)).collect();
    let mut rgb = Vec::with_capacity(width as usize * height as usize);
    for v in 0..height {
        let start = source(v, height, color.height) * color.width as usize;
        let row = color.rgb.get(start..).unwrap_or_default();
        rgb.extend(columns.iter().map(|u| toned_down(row.get(*u).copied().unwrap_or_default())));
    }
    Picture::new(width, height, rgb)
}

fn toned_down([r, g, b]: Rgb) -> Rgb {
    let [r, g, b] = [i32::from(r), i32::from(g), i32::from(b)];
    let luma = (77 * r + 150 * g + 29 * b) >> 8;
    [r, g, b].map(|c| ((LIGHT * (256 * luma + SATURATION * (c - luma))) >> 16) as u8)
}

/// Depth as grey, near ones bright. Greys go with the inverse depth, as the arm stands near and
/// walls are far.
pub fn from_depth(depth: &DepthImage) -> Picture {
    let mut spread: Vec<f32> =
        depth.depth_m().iter().step_by(STRIDE).filter(|z| **z > 0.0).map(|z| 1.0 / z).collect();
    spread.sort_unstable_by(f32::total_cmp);
    let quantile = |share: f64| {
        let at = (share * spread.len().saturating_sub(1) as f64).round() as usize;
        spread.get(at).copied().unwrap_or(0.0)
    };
    let (far, near) = (quantile(BEYOND), quantile(1.0 - BEYOND));
    let scale = (NEAR_GREY - FAR_GREY) / (near - far).max(1e-6);
    let grey = |z: &f32| {
        if *z > 0.0 {
            (FAR_GREY + (1.0 / z - far) * scale).clamp(FAR_GREY, NEAR_GREY) as u8
        } else {
            NO_DEPTH_GREY
        }
    };
    let rgb = depth.depth_m().iter().map(|z| [grey(z); 3]).collect();
    Picture::new(depth.width(), depth.height(), rgb)
}
