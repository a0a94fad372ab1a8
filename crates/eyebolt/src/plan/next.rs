//! From what is known to what is to be recorded next.

use super::camera::RoughCamera;
use super::candidates::{Candidate, Drawn, candidates};
use super::choose::Design;
use super::free::Surroundings;
use super::gain::{Known, Measured};
use super::movable::{MovableArm, Positions};
use super::path::Roads;
use super::request::{MOST_PLANNED, PlanRequest};
use super::route::{Route, route};
use super::scene::SeenScene;
use super::trajectory::{TimedPoint, timed};
use super::watcher::Watcher;
use crate::calibrate::Deviation;
use eyebolt_registration::{ExpectedNoise, PredictedInformation, Start};
use eyebolt_render::Random;
use nalgebra::{Point3, Vector3};

/// What to record next.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// In the order in which the arm takes them.
    pub configurations: Vec<Planned>,
    /// Error to expect with what was recorded before; `None` if nothing was.
    pub before: Option<Deviation>,
    /// The arm's way through all of them, with a rest in each.
    pub trajectory: Vec<TimedPoint>,
    /// What became of the configurations that were drawn.
    pub drawn: Drawn,
    /// How many of them were to choose from.
    pub candidates: usize,
    /// How many of those that would have been chosen the arm did not get to.
    pub unreachable: usize,
    /// Whether the way begins where the arm is.
    pub from_start: bool,
    /// Where errors are measured, base frame.
    pub workspace_in_base: Point3<f64>,
}

/// A configuration to be recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// Where the joints are, in the order of [`MovableArm::joints`].
    pub positions: Positions,
    /// Error to expect when this and all before it are recorded.
    pub expected: Deviation,
    /// Share of the surface of the links that move that is within the image and in range.
    pub in_view_share: f64,
    /// Share of the cameras that may be the one which see it.
    pub seen_by: f64,
    /// Share of the surface of the links that move which is where the camera never saw; `None` where nothing was recorded.
    pub unseen_share: Option<f64>,
    /// How many places there are on the way to it besides the ends; `None` where its beginning is not known.
    pub via: Option<usize>,
}

/// Candidates for each camera that may be the one.
const CANDIDATES: usize = 400;
const CANDIDATES_OF_SEVERAL: usize = 160;
/// For so many candidates that the arm does not get to, one configuration less is wanted.
const GIVE_UP: usize = 3;

/// Which random numbers are for what.
const FOR_CANDIDATES: u64 = 1;
const FOR_WAYS: u64 = 2;

/// Plans what `request` asks for. There may be fewer configurations than were asked for, or none: [`Plan::drawn`] and
/// [`Plan::unreachable`] say why.
pub fn plan_next(request: &PlanRequest<'_>) -> Plan {
    let PlanRequest { arm, cameras, recorded, .. } = request;
    let watchers = watchers(request);
    let surroundings = surroundings(request);
    let wanted = if cameras.len() > 1 { CANDIDATES_OF_SEVERAL } else { CANDIDATES };
    let random = Random::new(request.seed);
    let (found, drawn) =
        candidates(arm, &watchers, &surroundings, wanted, random.at(FOR_CANDIDATES));
    let positions: Vec<Positions> = found.iter().map(|one| one.positions.clone()).collect();
    let workspace_in_base = workspace_of(request, &positions);
    let (design, scale) = design(request, &watchers, workspace_in_base);
    let reached = reach(request, &surroundings, &design, &found, random.at(FOR_WAYS));
    let before = recorded.is_some() || request.calibrated.is_some();
    let mut plan = Plan {
        configurations: Vec::new(),
        before: before.then(|| design.expected(&design.known, scale)),
        trajectory: timed(&reached.route.ways, &request.speed, request.rest_s),
        drawn,
        candidates: found.len(),
        unreachable: reached.unreachable,
        from_start: reached.from_start,
        workspace_in_base,
    };
    let mut sums = design.known.clone();
    let offset = usize::from(!reached.from_start);
    for (turn, place) in reached.route.order.iter().enumerate() {
        let candidate = &found[reached.chosen[*place]];
        for (sum, own) in sums.iter_mut().zip(&candidate.information) {
            *sum += own;
        }
        let way = turn.checked_sub(offset).and_then(|way| reached.route.ways.get(way));
        plan.configurations.push(Planned {
            positions: candidate.positions.clone(),
            expected: design.expected(&sums, scale),
            in_view_share: candidate.in_view_share,
            seen_by: candidate.seen_by,
            unseen_share: arm
                .posture(&candidate.positions)
                .and_then(|posture| surroundings.unseen_share(arm, &posture)),
            via: way.map(|way| way.len().saturating_sub(2)),
        });
    }
    plan
}

/// The first `count` configurations that [`plan_next`] has to choose from for `request`: at random, free and in view.
pub fn free_and_in_view(request: &PlanRequest<'_>, count: usize) -> Vec<Positions> {
    let watchers = watchers(request);
    let random = Random::new(request.seed).at(FOR_CANDIDATES);
    let (found, _) = candidates(request.arm, &watchers, &surroundings(request), count, random);
    found.into_iter().map(|candidate| candidate.positions).collect()
}

/// Error to expect of what `request` knows with `configurations` recorded besides, in view or not; by the model alone.
pub fn expected_with(request: &PlanRequest<'_>, configurations: &[Positions]) -> Deviation {
    let watchers = watchers(request);
    let (design, _) = design(request, &watchers, workspace_of(request, configurations));
    let mut sums = design.known.clone();
    for (sum, watcher) in sums.iter_mut().zip(&watchers) {
        let mut rasters = watcher.rasters();
        for positions in configurations {
            let Some(posture) = request.arm.posture_with_axes(positions) else { continue };
            *sum += watcher.information(request.arm, &posture, &mut rasters[0]);
        }
    }
    design.expected(&sums, [1.0; 2])
}

/// The middle of where the end-effector is in `configurations`, base frame.
pub fn middle_of(arm: &MovableArm, configurations: &[Positions]) -> Point3<f64> {
    let tip = |positions: &Positions| {
        let there = arm.arm().base_from_end_effector(&arm.all_joints(positions));
        there.ok().map(|there| there.translation_m())
    };
    let tips: Vec<Vector3<f64>> = configurations.iter().filter_map(tip).collect();
    Point3::from(tips.iter().sum::<Vector3<f64>>() / tips.len().max(1) as f64)
}

fn watchers<'a>(request: &PlanRequest<'a>) -> Vec<Watcher<'a>> {
    let at = |camera: &RoughCamera| match &request.recorded {
        Some(recorded) => recorded.at,
        None => Start::from(camera.camera_from_base),
    };
    let cameras = request.cameras.iter();
    cameras.map(|camera| Watcher::new(camera, at(camera), ExpectedNoise::default())).collect()
}

/// Nothing that the camera saw is to be nearer to the arm than this, metres, and besides not by twice what the camera's place
/// may be off.
const CLEARANCE_M: f64 = 0.03;

fn surroundings(request: &PlanRequest<'_>) -> Surroundings {
    let error_m = request.calibrated.map_or(0.0, |known| known.expected.translation_m);
    let clearance_m = CLEARANCE_M + (2.0 * error_m).min(0.1);
    let scene = request.recorded.as_ref();
    let camera =
        |known: &RoughCamera| Point3::from(known.camera_from_base.inverse().translation_m());
    Surroundings {
        camera_in_base: match request.cameras {
            [only] => Some(camera(only)),
            _ => None,
        },
        table: request.table,
        scene: scene.map(|seen| SeenScene::new(seen.observations, &seen.at, clearance_m)),
        seen_only: request.seen_only,
    }
}

/// Where errors are measured: as the calibration does, or in the middle of where the end-effector may be.
fn workspace_of(request: &PlanRequest<'_>, found: &[Positions]) -> Point3<f64> {
    if let Some(known) = &request.calibrated {
        return known.workspace_in_base;
    }
    if let Some(recorded) = &request.recorded {
        return recorded.observations.workspace();
    }
    middle_of(request.arm, found)
}

/// What is known before, and by how much more the calibration of it expects to be off than the model does.
fn design(
    request: &PlanRequest<'_>,
    watchers: &[Watcher<'_>],
    workspace_in_base: Point3<f64>,
) -> (Design, [f64; 2]) {
    let mut known = vec![Known::default().information(); watchers.len()];
    let measured = request
        .cameras
        .iter()
        .map(|camera| Measured { camera_from_base: camera.camera_from_base, workspace_in_base });
    let measured: Vec<Measured> = measured.collect();
    if let Some(recorded) = &request.recorded {
        let observations = recorded.observations;
        let moves = |link: usize| request.arm.moves_called(&observations.arm.links()[link].name);
        for (known, watcher) in known.iter_mut().zip(watchers) {
            let [mut raster, _] = watcher.rasters();
            for seen in &observations.configurations {
                *known +=
                    watcher.information_of(&observations.arm, &seen.posture, moves, &mut raster);
            }
        }
    } else if let Some(calibrated) = &request.calibrated {
        for known in &mut known {
            add_pose(known, calibrated.covariance);
        }
    }
    let design = Design { known, measured };
    let told = request.calibrated.filter(|_| request.recorded.is_some());
    let scale = told.map_or([1.0; 2], |told| {
        let model = design.expected(&design.known, [1.0; 2]);
        let ratio = |told: f64, model: f64| if model > 0.0 { told / model } else { 1.0 };
        [
            ratio(told.expected.translation_m, model.translation_m),
            ratio(told.expected.rotation_rad, model.rotation_rad),
        ]
    });
    (design, scale)
}

/// No calibration is better than this along each axis, metres and radians: shapes and joints at rest are not.
const LEAST: f64 = 2e-4;

fn add_pose(known: &mut PredictedInformation, covariance: nalgebra::Matrix6<f64>) {
    let least = nalgebra::Matrix6::<f64>::identity() * LEAST.powi(2);
    let Some(own) = (covariance + least).try_inverse() else { return };
    let mut block = known.fixed_view_mut::<6, 6>(0, 0);
    block += own;
}

/// Those chosen that the arm gets to, and how.
struct Reached {
    chosen: Vec<usize>,
    route: Route,
    unreachable: usize,
    from_start: bool,
}

fn reach(
    request: &PlanRequest<'_>,
    surroundings: &Surroundings,
    design: &Design,
    found: &[Candidate],
    random: Random,
) -> Reached {
    let roads = Roads::new(request.arm, surroundings);
    let start = request.start.as_deref().filter(|start| roads.is_free(start));
    let mut excluded = vec![false; found.len()];
    let mut unreachable = 0;
    loop {
        let wanted = request.count.min(MOST_PLANNED).saturating_sub(unreachable / GIVE_UP);
        let chosen = design.choose(found, wanted, &excluded);
        let places: Vec<Positions> =
            chosen.iter().map(|place| found[*place].positions.clone()).collect();
        match route(&roads, &places, start, &request.speed, random) {
            Ok(route) => {
                return Reached { chosen, route, unreachable, from_start: start.is_some() };
            }
            Err(lonely) => {
                excluded[chosen[lonely]] = true;
                unreachable += 1;
            }
        }
    }
}
