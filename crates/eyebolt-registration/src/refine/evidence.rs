//! Residuals of one step, and how large they are.

use super::RefineView;
use super::places::Place;
use super::weighing::Scales;
use crate::arm::ArmModel;
use crate::factors::{Factor, PosedArm, State, outline_factor, surface_factor};
use crate::robust::median;
use eyebolt_render::{Raster, outer_contour};
use rayon::prelude::*;

const LEAST_SURFACE_SIGMA_M: f64 = 0.001;
const LEAST_OUTLINE_SIGMA_PX: f64 = 0.7;
/// Contour points looked at in a view.
const CONTOUR_POINTS: usize = 1500;

/// Residuals of one view at one state.
pub(super) struct Evidence {
    pub surface: Vec<Factor>,
    pub outline: Vec<Factor>,
    /// Cracks of the contour that each outline factor stands for.
    pub cracks_per_factor: f64,
    /// Points of the arm, and how many pixels each stands for.
    pub points: usize,
    pub pixels_per_point: f64,
    /// Where each link is.
    pub places: Vec<Place>,
}

impl Evidence {
    /// A link that several views show in the same place has the same errors in all: it counts once.
    pub fn share(&self, factor: &Factor) -> f64 {
        self.places[factor.link].share
    }
}

/// Residuals of all views at `state`.
pub(super) fn gather(
    arm: &ArmModel,
    views: &[RefineView<'_>],
    rasters: &mut [Raster],
    places: &[Vec<Place>],
    state: &State,
) -> Vec<Evidence> {
    let pairs = views.par_iter().zip(rasters.par_iter_mut());
    let pairs = pairs.zip(places);
    pairs.map(|((view, raster), places)| gather_one(arm, view, raster, state, places)).collect()
}

fn gather_one(
    arm: &ArmModel,
    view: &RefineView<'_>,
    raster: &mut Raster,
    state: &State,
    places: &[Place],
) -> Evidence {
    let camera = view.view.camera;
    let posture = &view.view.posture.moved(arm, &state.joint_offsets);
    let posed = PosedArm { arm, posture, state };
    raster.draw(camera, &posture.meshes(arm, &state.camera_from_base));
    let cracks = outer_contour(raster, camera);
    let stride = cracks.len().div_ceil(CONTOUR_POINTS).max(1);
    let outline = cracks
        .iter()
        .step_by(stride)
        .filter_map(|crack| outline_factor(&posed, camera, &view.silhouette, crack))
        .collect();
    let surface = view.arm_points.iter().filter_map(|p| surface_factor(&posed, p)).collect();
    Evidence {
        surface,
        outline,
        cracks_per_factor: stride as f64,
        points: view.arm_points.len(),
        pixels_per_point: view.pixels_per_point,
        places: places.to_vec(),
    }
}

/// Deviation of the residuals that are within the robust scales, from their median size.
pub(super) fn deviations(evidence: &[Evidence], scales: &Scales) -> Scales {
    let spread = |values: Vec<f64>, least: f64| {
        let mut values = values;
        median(&mut values).map_or(least, |m| (1.4826 * m).max(least))
    };
    let near = |factors: &mut dyn Iterator<Item = &Factor>, scale: f64| -> Vec<f64> {
        factors.map(|f| f.residual.abs()).filter(|r| *r < 2.0 * scale).collect()
    };
    let surface = near(&mut evidence.iter().flat_map(|e| &e.surface), scales.surface_m);
    let outline = near(&mut evidence.iter().flat_map(|e| &e.outline), scales.outline_px);
    Scales {
        surface_m: spread(surface, LEAST_SURFACE_SIGMA_M),
        outline_px: spread(outline, LEAST_OUTLINE_SIGMA_PX),
    }
}
