//! Whether the arm fits better with the names of two joints exchanged.
//!
//! Exchanged names of the last joints move little of the arm, and not where the base is: the answer may
//! be right and everything that hangs on it wrong.

use crate::observations::Observations;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{Margin, Start, View};
use nalgebra::Point3;
use rayon::prelude::*;

/// Points of a link's surface that are looked at.
const POINTS: usize = 80;
/// With fewer points in sight a configuration says nothing.
const LEAST_POINTS: usize = 20;
/// Surfaces seen at a flatter angle than this cosine are at their edge.
const LEAST_COSINE: f64 = 0.3;
/// What an exchange has to take off the misfit, as a share of it. On recordings of real arms every exchange
/// of right names adds a tenth at least, and the right one of exchanged names takes off a twentieth.
const LEAST_GAIN: f64 = 0.03;

/// The names of two joints whose recorded positions fit clearly better the other way round, among those
/// after the first, whose exchange would turn the base. `used` are the configurations that `at` was found
/// from.
pub(super) fn exchanged(
    observations: &Observations,
    used: &[usize],
    at: &Start,
) -> Option<[String; 2]> {
    let joints = observations.arm.joints();
    let pairs = (0..joints.len()).flat_map(|a| (a + 1..joints.len()).map(move |b| [a, b]));
    let pairs: Vec<[usize; 2]> = pairs.filter(|[a, _]| !joints[*a].defines_base).collect();
    let firsts = pairs.last().map_or(0, |[last, _]| last + 1);
    let given: Vec<Vec<Option<f64>>> = (0..firsts)
        .into_par_iter()
        .map(|first| misfits(observations, used, at, first, first))
        .collect();
    let gain = |[first, second]: &[usize; 2]| {
        gain(&given[*first], &misfits(observations, used, at, *first, *second))
    };
    let gains: Vec<f64> = pairs.par_iter().map(gain).collect();
    let (pair, gain) = pairs.iter().zip(gains).max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    tracing::debug!(?pair, gain, "the exchange of two joints that fits best");
    (gain > LEAST_GAIN).then(|| pair.map(|joint| joints[joint].name.clone()))
}

/// By how much less is off with the exchange than as `given`, as a share of that; each for each
/// configuration.
fn gain(given: &[Option<f64>], exchanged: &[Option<f64>]) -> f64 {
    let both = given.iter().zip(exchanged).filter_map(|(given, exchanged)| given.zip(*exchanged));
    let (given, exchanged) = both.fold((0.0, 0.0), |sum, both| (sum.0 + both.0, sum.1 + both.1));
    if given > 0.0 { (given - exchanged) / given } else { 0.0 }
}

/// Misfit of the links that joint `first` moves in each of the configurations `used`, with the positions
/// of `first` and `second` exchanged; as recorded if they are the same.
fn misfits(
    observations: &Observations,
    used: &[usize],
    at: &Start,
    first: usize,
    second: usize,
) -> Vec<Option<f64>> {
    let arm = &observations.arm;
    let moved: Vec<usize> =
        (0..arm.links().len()).filter(|link| arm.joints()[first].carries[*link]).collect();
    let of_one = |index: &usize| {
        let configuration = &observations.configurations[*index];
        let [a, b] = positions(&configuration.joints_rad, [first, second])?;
        let mut offsets = at.joint_offsets;
        offsets.rad[first] += b - a;
        offsets.rad[second] += a - b;
        let posture = &configuration.posture.moved(arm, &offsets);
        let depth_factor = at.depth_factor();
        let view = View { posture, depth_factor, ..observations.view(configuration) };
        misfit(observations, &view, &moved, &at.camera_from_base)
    };
    used.iter().map(of_one).collect()
}

fn positions(joints_rad: &[f64], pair: [usize; 2]) -> Option<[f64; 2]> {
    Some([*joints_rad.get(pair[0])?, *joints_rad.get(pair[1])?])
}

/// Mean misfit in depth of the points of `links` that face the camera, as a share of what is surely
/// another surface; `None` if hardly any of them is in sight.
fn misfit(
    observations: &Observations,
    view: &View<'_>,
    links: &[usize],
    camera_from_base: &Transform<Camera, Base>,
) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0_usize);
    for link in links {
        let surface = &observations.arm.links()[*link].model.surface;
        let camera_from_link = *camera_from_base * view.posture.base_from_link()[*link];
        for sample in surface.iter().step_by(surface.len().div_ceil(POINTS).max(1)) {
            let point = camera_from_link.point(&sample.point.cast());
            let normal = camera_from_link.direction(&sample.normal.cast());
            if -normal.dot(&point.coords) < LEAST_COSINE * point.coords.norm() {
                continue;
            }
            if let Some(off) = misfit_at(view, &point) {
                sum += off;
                count += 1;
            }
        }
    }
    (count >= LEAST_POINTS).then(|| sum / count as f64)
}

/// Misfit at one point, 0 to 1; `None` where nothing can be said.
fn misfit_at(view: &View<'_>, point_in_camera: &Point3<f64>) -> Option<f64> {
    let pixel = view.camera.project(point_in_camera).filter(|p| view.camera.contains(p))?;
    let (u, v) = ((pixel.x + 0.5) as usize, (pixel.y + 0.5) as usize);
    let at = v * view.depth.width() as usize + u;
    if view.mask.is_some_and(|mask| !mask.as_slice()[at]) {
        return Some(1.0);
    }
    let (seen, z) = (view.depth_m(at), point_in_camera.z as f32);
    let share = (seen - z).abs() / Margin::Refined.at_m(z);
    (seen > 0.0).then_some(f64::from(share.min(1.0)))
}
