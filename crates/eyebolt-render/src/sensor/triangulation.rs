//! Depth from the angle between two rays: structured light and stereo.

use super::exposure::{Exposure, Lateral, Readout};
use super::field::{Field, Layers};
use super::figures::Triangulation;
use super::geometry::Geometry;
use super::laws::{LateralNoise, odds};
use super::specimen::Specimen;
use super::window::{APART_PX, Disparities, Neighbour, matches, near_edges, nearest_in_front};
use crate::view::IdealView;
use eyebolt_geometry::PinholeCamera;
use rayon::prelude::*;

/// By how much the share of a window that is needed varies, and the largest angle: a few of the
/// pixels of a window, and what a hand's breadth of a curved surface turns.
const SHARE_SPREAD: f32 = 0.05;
const ANGLE_SPREAD_RAD: f32 = 0.05;

/// What `specimen` with `figures` measures of `view` of `camera`, where `second_sees` tells what
/// is in sight of the second lens.
pub fn expose(
    figures: &Triangulation,
    view: &IdealView,
    camera: &PinholeCamera,
    second_sees: &[bool],
    specimen: &Specimen,
) -> Exposure {
    let size = [view.width, view.height];
    let product = camera.fx() * figures.baseline_m;
    let geometry = Geometry::new(view, camera, product, specimen);
    let lit = geometry.in_sight(figures, size, second_sees);
    let image =
        Disparities { size, px: &lit, truth_px: &geometry.disparity_px, slope: &geometry.slope };
    let (value, from) = fatten(figures, &image);
    let matches = matches(&image, &geometry.angle_rad, figures.window.half_px);
    let confidence = from.par_iter().map(|at| {
        let share = (matches[*at].share - figures.window.least_share as f32) / SHARE_SPREAD;
        let angle = figures.largest_angle_rad as f32 - matches[*at].angle_rad;
        share.min(angle / ANGLE_SPREAD_RAD)
    });
    let sigma = value.par_iter().zip(&from).map(|(px, at)| {
        let depth_m = product / f64::from(*px);
        let angle = f64::from(matches[*at].angle_rad);
        figures.axial.disparity_px(depth_m, angle, product, figures.step_px) as f32
    });
    let exposure = Exposure {
        size,
        readout: Readout::Disparity { product: product as f32, step_px: figures.step_px as f32 },
        range_m: [0.0, f32::INFINITY],
        confidence: confidence.collect(),
        sigma: sigma.collect(),
        value,
        lateral: None,
        half_px: figures.half_correlation_px as f32,
    };
    let exposure = with_lateral(exposure, figures, &geometry.angle_rad, specimen);
    with_fixed_error(exposure, figures, specimen)
}

/// Disparity that is found at each pixel, and the pixel that it belongs to.
fn fatten(figures: &Triangulation, image: &Disparities<'_>) -> (Vec<f32>, Vec<usize>) {
    let reach_px = figures.fattening_px + figures.rim_px;
    if reach_px == 0.0 {
        return (image.px.to_vec(), (0..image.px.len()).collect());
    }
    let found = |(here, nearest): (usize, &Option<Neighbour>)| match nearest {
        None => (image.px[here], here),
        Some(front) if f64::from(front.distance_px) <= figures.fattening_px => {
            (image.px[front.at], front.at)
        }
        Some(_) => (0.0, here),
    };
    nearest_in_front(image, reach_px).par_iter().enumerate().map(found).unzip()
}

/// Displaces edges.
fn with_lateral(
    exposure: Exposure,
    figures: &Triangulation,
    angle_rad: &[f32],
    specimen: &Specimen,
) -> Exposure {
    let LateralNoise { base_px, grazing_px, half_correlation_px } = figures.lateral;
    if base_px == 0.0 {
        return exposure;
    }
    let reach = (3.0 * base_px).ceil() as usize;
    let near = near_edges(exposure.size, &exposure.value, APART_PX, reach);
    let sigma_px = near.iter().zip(angle_rad).map(|(near, angle)| {
        let total_px = base_px + grazing_px * odds(f64::from(*angle));
        // Pixels are whole: their rounding adds to the noise.
        let sigma_px = (total_px.powi(2) - 1.0 / 12.0).max(0.0).sqrt();
        if *near { sigma_px.min(reach as f64) as f32 } else { 0.0 }
    });
    let half_px = half_correlation_px as f32;
    let field = |place| Field::new(specimen.random.at(place), exposure.size, half_px);
    let lateral = Lateral {
        sigma_px: sigma_px.collect(),
        half_px,
        apart: APART_PX,
        fixed: [field(1), field(2)],
        fixed_share: figures.fixed_share as f32,
    };
    Exposure { lateral: Some(lateral), ..exposure }
}

/// Takes the part of the noise that all frames have alike out of the noise and into the values.
fn with_fixed_error(
    mut exposure: Exposure,
    figures: &Triangulation,
    specimen: &Specimen,
) -> Exposure {
    let [fresh, fixed] = [1.0 - figures.fixed_share, figures.fixed_share].map(|s| s.sqrt() as f32);
    let layers = Layers::new(
        specimen.random.at(0),
        exposure.size,
        figures.half_correlation_px as f32,
        figures.half_correlation_disparity_px as f32,
        &exposure.value,
    );
    let width = exposure.size[0];
    let pixels = exposure.value.par_iter_mut().zip(exposure.sigma.par_iter_mut()).enumerate();
    pixels.filter(|(_, (value, _))| **value > 0.0).for_each(|(at, (value, sigma))| {
        *value += *sigma * fixed * layers.at(at % width, at / width, *value);
        *sigma *= fresh;
    });
    exposure
}
