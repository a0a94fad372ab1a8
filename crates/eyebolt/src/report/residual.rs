//! How far what was seen lies from the posed model, pixel by pixel.

use super::picture::{Picture, Rgb};
use crate::observations::{Configuration, Observations};
use eyebolt_render::Raster;

/// The ends of the colour scale, millimetres.
pub(super) const CLIP_MM: f32 = 25.0;
/// The camera saw through the model where it saw this much farther, millimetres.
const THROUGH_MM: f32 = 2.0 * CLIP_MM;

const NEARER: Rgb = [20, 60, 255];
const EVEN: Rgb = [255, 255, 255];
const FARTHER: Rgb = [255, 30, 10];
pub(super) const THROUGH: Rgb = [255, 0, 220];

/// Width of the stripes over what was seen through, pixels.
const STRIPE_PX: usize = 4;

/// What the residuals of one configuration come to, millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Summary {
    /// Half of the residuals are larger.
    pub(super) median_mm: f32,
    /// Half of the residuals are nearer than this to zero.
    pub(super) half_within_mm: f32,
}

/// Paints the residuals of all pixels of the drawn model that have a depth, and sums them up;
/// `None` if there is none.
///
/// A residual is the distance along the pixel's ray from the model to what was seen, positive where
/// that is farther. The summary leaves out what is in front of the model or behind it by more than
/// counts as its surface.
pub(super) fn paint(
    picture: &mut Picture,
    observations: &Observations,
    configuration: &Configuration,
    raster: &Raster,
) -> Option<Summary> {
    let rays = observations.rays.rays();
    let depth_m = configuration.depth.depth_m();
    let mut on_surface_mm = Vec::new();
    for at in raster.pixels() {
        let (Some(model_m), Some(seen_m), Some([x, y])) =
            (raster.depth_m(at), depth_m.get(at), rays.get(at))
        else {
            continue;
        };
        let along_ray = (x * x + y * y + 1.0).sqrt();
        let residual_mm = (seen_m - model_m) * along_ray * 1e3;
        // Nothing was seen, or the lens has no ray there.
        if !(*seen_m > 0.0 && residual_mm.is_finite()) {
            continue;
        }
        if residual_mm > THROUGH_MM {
            picture.blend(at, THROUGH, through_opacity(at, raster.width()));
        } else {
            let (color, opacity) = shade(residual_mm);
            picture.blend(at, color, opacity);
        }
        if residual_mm.abs() <= THROUGH_MM {
            on_surface_mm.push(residual_mm);
        }
    }
    let median_mm = median(&mut on_surface_mm)?;
    on_surface_mm.iter_mut().for_each(|mm| *mm = mm.abs());
    Some(Summary { median_mm, half_within_mm: median(&mut on_surface_mm)? })
}

/// Colour and opacity of a residual: a hint of white at zero, which tells that there was depth.
pub(super) fn shade(residual_mm: f32) -> (Rgb, f32) {
    let share = (residual_mm / CLIP_MM).clamp(-1.0, 1.0).abs();
    (color(residual_mm), 0.15 + 0.4 * share)
}

/// Colour of a residual: from blue, nearer than the model, over white to red, farther.
pub(super) fn color(residual_mm: f32) -> Rgb {
    let t = (residual_mm / CLIP_MM).clamp(-1.0, 1.0);
    let end = if t < 0.0 { NEARER } else { FARTHER };
    let mix = |from: u8, to: u8| f32::from(from) + (f32::from(to) - f32::from(from)) * t.abs();
    let mut color = EVEN;
    for (channel, to) in color.iter_mut().zip(end) {
        *channel = mix(*channel, to) as u8;
    }
    color
}

/// Stripes, so that nobody takes it for a distance.
pub(super) fn through_opacity(at: usize, width: usize) -> f32 {
    let (u, v) = (at % width, at / width);
    if ((u + v) / STRIPE_PX).is_multiple_of(2) { 0.65 } else { 0.12 }
}

/// The middle one of some finite numbers, the upper one of two.
fn median(values: &mut [f32]) -> Option<f32> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f32::total_cmp).1)
}
