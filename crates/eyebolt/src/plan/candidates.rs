//! Configurations that could be recorded: drawn at random, free and in view.

use super::free::{Blocked, Surroundings};
use super::movable::{MovableArm, Positions};
use super::watcher::{Sight, Watcher};
use eyebolt_registration::PredictedInformation;
use eyebolt_render::{Random, Raster};
use rayon::prelude::*;
use std::fmt;

/// A configuration that could be recorded.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) positions: Positions,
    /// What each camera's view of it tells; nothing where that does not see it.
    pub(super) information: Vec<PredictedInformation>,
    /// Share of the moving links' surface within the image, on average over the cameras that see it.
    pub(super) in_view_share: f64,
    /// Share of the cameras that see it.
    pub(super) seen_by: f64,
}

/// What became of the configurations that were drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Drawn {
    /// How many there were.
    pub drawn: u64,
    /// Whose end-effector, or half of whose links, is not in view, or hidden or turned away.
    pub out_of_view: u64,
    /// That touch themselves.
    pub touching_itself: u64,
    /// That touch the table, or whatever the base stands on.
    pub touching_table: u64,
    /// That come near to the camera.
    pub near_camera: u64,
    /// That come near to what the camera saw, or to what it saw hidden.
    pub near_scene: u64,
    /// With parts where the camera never saw, where that is not allowed.
    pub unseen: u64,
}

impl fmt::Display for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let share = |count: u64| 100.0 * count as f64 / self.drawn.max(1) as f64;
        write!(
            f,
            "Of {} that were drawn at random, {:.1} % have the end-effector or half of the arm out of view, hidden or \
             turned away, {:.1} % touch themselves, {:.1} % the table, {:.1} % what the camera saw, {:.1} % come near to \
             the camera, and {:.1} % are where it has not seen",
            self.drawn,
            share(self.out_of_view),
            share(self.touching_itself),
            share(self.touching_table),
            share(self.near_scene),
            share(self.near_camera),
            share(self.unseen)
        )
    }
}

impl Drawn {
    fn add(&mut self, why: Unfit) {
        let count = match why {
            Unfit::OutOfView => &mut self.out_of_view,
            Unfit::Blocked(Blocked::Itself) => &mut self.touching_itself,
            Unfit::Blocked(Blocked::Table) => &mut self.touching_table,
            Unfit::Blocked(Blocked::Camera) => &mut self.near_camera,
            Unfit::Blocked(Blocked::Scene) => &mut self.near_scene,
            Unfit::Blocked(Blocked::Unseen) => &mut self.unseen,
        };
        *count += 1;
    }
}

/// Why a configuration is no candidate.
#[derive(Clone, Copy)]
enum Unfit {
    OutOfView,
    Blocked(Blocked),
}

/// Drawn at most, and at a time.
const MOST_DRAWN: u64 = 60_000;
const BATCH: u64 = 1024;
/// Of several cameras that may be the one, so many have to see it.
const SEEN_BY: f64 = 0.5;

/// Up to `wanted` candidates, and what became of the others.
pub(super) fn candidates(
    arm: &MovableArm,
    watchers: &[Watcher<'_>],
    surroundings: &Surroundings,
    wanted: usize,
    random: Random,
) -> (Vec<Candidate>, Drawn) {
    let mut found = Vec::new();
    let mut drawn = Drawn::default();
    while found.len() < wanted && drawn.drawn < MOST_DRAWN {
        let batch = (drawn.drawn..drawn.drawn + BATCH).into_par_iter().map_init(
            || watchers.iter().map(Watcher::rasters).collect::<Vec<_>>(),
            |rasters, place| {
                let positions = anywhere(arm, &mut random.at(place));
                candidate(arm, watchers, surroundings, positions, rasters)
            },
        );
        for one in batch.collect::<Vec<_>>() {
            match one {
                Ok(candidate) => found.push(candidate),
                Err(why) => drawn.add(why),
            }
        }
        drawn.drawn += BATCH;
    }
    found.truncate(wanted);
    (found, drawn)
}

/// Positions anywhere within the limits.
pub(super) fn anywhere(arm: &MovableArm, random: &mut Random) -> Positions {
    arm.joints().iter().map(|joint| random.between(joint.between[0], joint.between[1])).collect()
}

fn candidate(
    arm: &MovableArm,
    watchers: &[Watcher<'_>],
    surroundings: &Surroundings,
    positions: Positions,
    rasters: &mut [[Raster; 2]],
) -> Result<Candidate, Unfit> {
    let enough = |count: usize| count as f64 >= SEEN_BY * watchers.len() as f64;
    let may_show: Vec<bool> = watchers.iter().map(|w| w.may_show(arm, &positions)).collect();
    if !enough(may_show.iter().filter(|may| **may).count()) {
        return Err(Unfit::OutOfView);
    }
    let posture = arm.posture_with_axes(&positions).ok_or(Unfit::OutOfView)?;
    surroundings.check(arm, &posture).map_err(Unfit::Blocked)?;
    let seen = watchers.iter().zip(rasters).zip(may_show);
    let sights: Vec<Option<Sight>> = seen
        .map(|((watcher, rasters), may)| {
            may.then(|| watcher.look(arm, &posture, rasters)).flatten()
        })
        .collect();
    let seeing: Vec<&Sight> = sights.iter().flatten().collect();
    if seeing.is_empty() || !enough(seeing.len()) {
        return Err(Unfit::OutOfView);
    }
    let in_view: f64 = seeing.iter().map(|sight| sight.in_view_share).sum();
    Ok(Candidate {
        in_view_share: in_view / seeing.len() as f64,
        seen_by: seeing.len() as f64 / watchers.len() as f64,
        information: sights
            .into_iter()
            .map(|sight| sight.map_or_else(PredictedInformation::zeros, |s| s.information))
            .collect(),
        positions,
    })
}
