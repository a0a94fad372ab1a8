//! The chosen configurations in an order in which the arm gets from each to the next.

use super::movable::Positions;
use super::order::cheapest;
use super::path::Roads;
use super::speed::Speed;
use eyebolt_render::Random;
use rayon::prelude::*;

/// Places in their order, with the way to each.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Route {
    pub(super) order: Vec<usize>,
    /// To each of them from the one before, both ends included; nothing to the first where the arm's place is not known.
    pub(super) ways: Vec<Vec<Positions>>,
}

/// What is known of the way between two places.
#[derive(Clone)]
enum Way {
    /// It takes at least as long as the straight one.
    Unchecked(f64),
    Free(Vec<Positions>, f64),
    None,
}

impl Way {
    fn cost(&self) -> f64 {
        match self {
            Self::Unchecked(seconds) | Self::Free(_, seconds) => *seconds,
            Self::None => f64::INFINITY,
        }
    }
}

/// The route through all of `places`, from `start` if that is known, that takes the least time; or the place that the arm
/// does not get to.
///
/// Ways are checked when a route needs them, and routes sought anew with what that told (as in Bohlin and Kavraki, "Path
/// planning using lazy PRM", ICRA 2000).
pub(super) fn route(
    roads: &Roads<'_>,
    places: &[Positions],
    start: Option<&[f64]>,
    speed: &Speed,
    random: Random,
) -> Result<Route, usize> {
    let count = places.len();
    // The start is a place like the others, the last one.
    let all: Vec<&[f64]> = places.iter().map(Vec::as_slice).chain(start).collect();
    let straight = |a: usize, b: usize| Way::Unchecked(speed.straight_s(all[a], all[b]));
    let mut ways: Vec<Vec<Way>> =
        (0..all.len()).map(|a| (0..all.len()).map(|b| straight(a, b)).collect()).collect();
    loop {
        let costs: Vec<Vec<f64>> =
            ways[..count].iter().map(|row| row[..count].iter().map(Way::cost).collect()).collect();
        let from_start: Option<Vec<f64>> =
            ways.get(count).map(|row| row[..count].iter().map(Way::cost).collect());
        let Some(order) = cheapest(&costs, from_start.as_deref()) else {
            return Err(loneliest(&ways, count));
        };
        let legs = legs(&order, start.map(|_| count));
        let unchecked: Vec<(usize, usize)> = legs
            .iter()
            .copied()
            .filter(|(a, b)| matches!(ways[*a][*b], Way::Unchecked(_)))
            .collect();
        if unchecked.is_empty() {
            return Ok(Route { ways: taken(&legs, &ways), order });
        }
        let found: Vec<Option<Vec<Positions>>> = unchecked
            .par_iter()
            .map(|(a, b)| {
                let stream = random.at(*a as u64).at(*b as u64);
                roads.way(all[*a], all[*b], stream)
            })
            .collect();
        for ((a, b), way) in unchecked.into_iter().zip(found) {
            let known = way.map_or(Way::None, |way| {
                let seconds = speed.way_s(&way);
                Way::Free(way, seconds)
            });
            ways[b][a] = reversed(&known);
            ways[a][b] = known;
        }
    }
}

/// From each place of `order` to the next, from `start` to the first before.
fn legs(order: &[usize], start: Option<usize>) -> Vec<(usize, usize)> {
    let first = start.into_iter().zip(order.first().copied());
    first.chain(order.windows(2).map(|pair| (pair[0], pair[1]))).collect()
}

fn taken(legs: &[(usize, usize)], ways: &[Vec<Way>]) -> Vec<Vec<Positions>> {
    let free = |(a, b): &(usize, usize)| match &ways[*a][*b] {
        Way::Free(way, _) => way.clone(),
        Way::Unchecked(_) | Way::None => Vec::new(),
    };
    legs.iter().map(free).collect()
}

fn reversed(way: &Way) -> Way {
    match way {
        Way::Free(way, seconds) => Way::Free(way.iter().rev().cloned().collect(), *seconds),
        other => other.clone(),
    }
}

/// The place that most ways to were sought in vain.
fn loneliest(ways: &[Vec<Way>], count: usize) -> usize {
    let failed = |place: &usize| ways.iter().filter(|row| matches!(row[*place], Way::None)).count();
    (0..count).max_by_key(failed).unwrap_or(0)
}
