//! From a refined pose to a calibration.

use super::calibration::Calibration;
use super::error;
use super::exchanged::exchanged;
use super::jackknife::Jackknife;
use super::limits::Limits;
use super::still_part::still_part;
use super::unknown_parts::unknown_parts;
use super::verdict::{Findings, judge, nothing_found};
use crate::observations::Observations;
use crate::progress::{Cancelled, Progress};
use crate::refine::{Found, Workspace, stands};
use eyebolt_registration::SURFACES;

/// Measures what `found` leaves over, estimates how far off it is, and judges it by `limits`.
///
/// # Errors
///
/// Cancelled.
pub fn calibrate(
    observations: &Observations,
    found: Found<'_>,
    limits: &Limits,
    jackknife: Jackknife,
    progress: &dyn Progress,
) -> Result<Calibration, Cancelled> {
    let Found { mut configurations, masks, refined } = found;
    let outside_limits = &observations.outside_limits;
    let Some(refined) = refined else {
        let verdict = nothing_found(&configurations, outside_limits, limits);
        return Ok(Calibration { configurations, ..Calibration::without_pose(verdict) });
    };
    let refinement = refined.refinement;
    let mut workspace = Workspace::with(observations, &masks, refined.indices, refined.rasters);
    workspace.measure(&refinement, &mut configurations);
    progress.advance(1, 3)?;
    let end = refinement.end();
    let deviation_m = refinement.deviations[SURFACES];
    let still =
        still_part(observations, &workspace.indices, &mut workspace.rasters, &end, deviation_m);
    let error =
        error::estimate(&mut workspace, &refinement, &refined.seen, jackknife, still.as_ref());
    progress.advance(2, 3)?;
    let rival = refined.rival.is_some_and(|rival| stands(&mut workspace, &rival, &end));
    let exchanged = exchanged(observations, &workspace.indices, &end);
    let unknown_parts = unknown_parts(observations, &masks, &workspace.indices, &end);
    let findings = Findings {
        refinement: &refinement,
        joints: observations.arm.joints(),
        outcomes: &configurations,
        outside_limits,
        error: &error,
        still_part: still.as_ref(),
        exchanged,
        rival,
    };
    let verdict = judge(&findings, limits);
    tracing::debug!(?verdict, rival, expected = ?error.expected, "judged");
    Ok(Calibration {
        camera_from_base: Some(observations.optical_from_camera * refinement.camera_from_base),
        refinement: Some(refinement),
        configurations,
        camera_moved: refined.camera_moved,
        unknown_parts,
        still_part: still,
        error: Some(error),
        verdict,
    })
}
