//! Whether what never moves is where the description has it.
//!
//! No moving link tells where the base is: they fit as well with the description of another variant,
//! whose base is higher or lower, and the answer, which is of the base frame, is off by the difference.
//! Only the links before the first joint can tell, and few of all pixels are theirs, so that robust weights
//! pass over them. They are judged apart: by where else they would fit what was seen.

mod elsewhere;
mod links;
mod posterior;

use crate::observations::Observations;
pub use elsewhere::Elsewhere;
use eyebolt_registration::Start;
use eyebolt_render::Raster;
use links::{Fit, Gain, Still};
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// Where the links that never move may be.
#[derive(Clone, Debug, PartialEq)]
pub struct StillPart {
    /// Where they fit best; `None` if hardly anything is seen of them.
    pub best: Option<Elsewhere>,
    /// Other places along the axis of the first joint, in their order.
    along: Vec<Elsewhere>,
    /// That axis, base frame.
    axis: Vector3<f64>,
}

/// The logarithm of the likelihood that has to be won for a base to be elsewhere without doubt.
const SURELY: f64 = 8.0;
/// Nearer places have depth that cameras get wrong in corners, by time of flight as by stereo, and say
/// nothing by what is seen through.
const FAR_M: f64 = 0.022;
/// What stands beside or below a base looks like a part of it in one laboratory of twenty, and in as many what stands
/// before it ends where another base would begin: the logarithm of that.
const LOOKS_ALIKE: f64 = 3.0;
/// Fewer pixels in sight say nothing.
const LEAST_PIXELS: usize = 150;

impl StillPart {
    /// Mean square of how far the links are from where the description has them, along the base's axes, square
    /// metres, with kinds of evidence that disagree `birge` times as much as they should: what all depth is off by
    /// moves surfaces, but no scene before them.
    pub fn mean_square(&self, birge: f64) -> Matrix3<f64> {
        posterior::mean_square(&self.along, &self.axis, birge)
    }

    /// Of links of which nothing is seen.
    fn unseen(axis: Vector3<f64>) -> Self {
        let place = |metres: f64| Elsewhere { shift_m: metres * axis, ..Elsewhere::default() };
        Self { best: None, along: along().into_iter().map(place).collect(), axis }
    }

    /// How far it is from where the description has it, if that is surely somewhere else.
    pub fn sure_shift_m(&self) -> Vector3<f64> {
        let sure = self.best.filter(|best| best.seen_through > SURELY);
        sure.map_or_else(Vector3::zeros, |best| self.axis * self.axis.dot(&best.shift_m))
    }
}

/// How far variants of an arm may differ in where the first joint is along its axis, metres.
const ALONG_M: f64 = 0.12;
/// Across it they do not; answers are off by a few millimetres there.
const ACROSS_M: f64 = 0.012;
/// Steps of the search, metres, the last of which is as fine as pixels allow.
const COARSE_M: f64 = 0.01;
const COARSE_ACROSS_M: f64 = 0.006;
const FINE_M: [f64; 4] = [0.006, 0.003, 0.0015, 0.0008];
/// From how many places a step goes on at most.
const MOST_STEPS: usize = 8;
/// Places beside the one described, and beside the best one, that tell how sure it is, metres.
const BESIDE_M: [f64; 10] =
    [-0.0065, -0.0045, -0.003, -0.0015, -0.0008, 0.0008, 0.0015, 0.003, 0.0045, 0.0065];

/// Where the links of the configurations `used` that never move may be with the arm at `at`, of whose
/// surfaces depth is off by `deviation_m`; `None` if nothing turns.
pub(super) fn still_part(
    observations: &Observations,
    used: &[usize],
    rasters: &mut [Raster],
    at: &Start,
    deviation_m: f64,
) -> Option<StillPart> {
    // No offset of a joint turns the first one's axis.
    let first = &observations.configurations.get(*used.first()?)?.posture;
    let axis = first.axes().first()?.along_in_base.into_inner();
    let Some(still) = Still::new(observations, used, rasters, at, deviation_m) else {
        return Some(StillPart::unseen(axis));
    };
    let search = Search { observations, axis, described: still.fit_as_described(), still };
    let found = search.found();
    tracing::debug!(
        best = ?found.best,
        described = ?search.described,
        spread_mm = ?found.mean_square(1.0).diagonal().map(|square| 1e3 * square.sqrt()).as_slice(),
        ?axis,
        "where what never moves fits best"
    );
    Some(found)
}

struct Search<'a> {
    observations: &'a Observations,
    axis: Vector3<f64>,
    still: Still<'a>,
    described: Fit,
}

/// A place that was tried.
type Tried = (Fit, Vector3<f64>);

impl Search<'_> {
    fn found(&self) -> StillPart {
        let axis = self.axis;
        let along = self.tried(along().into_iter().map(|metres| metres * axis).collect());
        if along.iter().all(|(fit, _)| fit.pixels < LEAST_PIXELS) {
            return StillPart::unseen(axis);
        }
        let beside = self.tried(beside(&axis));
        let all = along.iter().chain(&beside).filter(|(fit, _)| fit.is_as_much_as(&self.described));
        let coarse = least(all.copied()).unwrap_or((self.described, Vector3::zeros()));
        let (fit, shift_m) = self.finer(coarse);
        let near = self.tried(BESIDE_M.iter().map(|metres| shift_m + *metres * axis).collect());
        let nearby = self.nearby(&along);
        let elsewhere = |tried: Tried| self.elsewhere(&tried, &nearby);
        let best = self.is_seen().then(|| elsewhere((fit, shift_m)));
        let all = along.into_iter().chain(near).map(elsewhere).chain(best);
        let mut along: Vec<Elsewhere> = all.collect();
        along.sort_by(|a, b| axis.dot(&a.shift_m).total_cmp(&axis.dot(&b.shift_m)));
        StillPart { best, along, axis }
    }

    /// What speaks for places that are no farther than depth may be wrong at edges: nothing, and nothing for others.
    fn nearby(&self, along: &[Tried]) -> Gain {
        let near = along.iter().filter(|(fit, place)| {
            place.norm() <= 1.01 * COARSE_M && fit.is_as_much_as(&self.described)
        });
        let gains = near.map(|(fit, _)| self.still.gain(&self.described, fit));
        gains.fold(Gain::default(), |most, gain| Gain {
            seen_through: most.seen_through.max(gain.seen_through),
            more: most.more.max(gain.more),
            uncovered: most.uncovered.max(gain.uncovered),
            ..most
        })
    }

    /// Whether enough is seen where the description has the links to compare with.
    fn is_seen(&self) -> bool {
        self.described.pixels >= LEAST_PIXELS
    }

    fn tried(&self, places: Vec<Vector3<f64>>) -> Vec<Tried> {
        let of_place =
            |raster: &mut Raster, place: Vector3<f64>| (self.still.fit(raster, &place), place);
        let raster = || Raster::new(&self.observations.camera);
        places.into_par_iter().map_init(raster, of_place).collect()
    }

    /// What speaks for a place, and not as much for places `nearby`.
    fn elsewhere(&self, (fit, shift_m): &Tried, nearby: &Gain) -> Elsewhere {
        let shift_m = *shift_m;
        let is_seen = self.is_seen();
        if is_seen && !fit.is_as_much_as(&self.described) {
            // What is seen of the links would be something else.
            return Elsewhere { shift_m, nearer: f64::NEG_INFINITY, ..Elsewhere::default() };
        }
        let gain = self.still.gain(&self.described, fit);
        let more = (gain.more - nearby.more).clamp(-LOOKS_ALIKE, LOOKS_ALIKE);
        // What a base as described stands in counts where one is seen that stands on it, and what another would stand in
        // counts against that.
        let uncovered =
            (gain.uncovered - nearby.uncovered).clamp(-2.0 * LOOKS_ALIKE, more.max(0.0));
        let far = self.axis.dot(&shift_m).abs() > FAR_M;
        let if_far = |gain: f64| if far { gain } else { 0.0 };
        Elsewhere {
            shift_m,
            seen_through: match is_seen {
                true => if_far(gain.seen_through - nearby.seen_through),
                false => 0.0,
            },
            nearer: if is_seen { gain.nearer } else { 0.0 },
            more: if_far(more + uncovered),
        }
    }

    /// The best place near to `begin`.
    fn finer(&self, begin: Tried) -> Tried {
        let axis = self.axis;
        let [aside, other] = across(&axis);
        let directions = [axis, -axis, aside, -aside, other, -other];
        let mut best = begin;
        for step in FINE_M {
            for _ in 0..MOST_STEPS {
                let (found, place) = best;
                let next = self.tried(directions.iter().map(|way| place + step * way).collect());
                let across = |place: &Vector3<f64>| (place - axis * axis.dot(place)).norm();
                let next = next.into_iter().filter(|(fit, place)| {
                    fit.is_as_much_as(&self.described) && across(place) <= ACROSS_M
                });
                match least(next) {
                    Some(next) if next.0.misfit() < found.misfit() => best = next,
                    _ => break,
                }
            }
        }
        best
    }
}

/// Places along the axis, finer about the one described, which is among them, in order.
fn along() -> Vec<f64> {
    let steps = (ALONG_M / COARSE_M).round() as i32;
    let coarse = (-steps..=steps).map(|step| f64::from(step) * COARSE_M);
    let mut all: Vec<f64> = coarse.chain(BESIDE_M).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Places beside the one described.
fn beside(axis: &Vector3<f64>) -> Vec<Vector3<f64>> {
    let [aside, other] = across(axis);
    let steps = (ACROSS_M / COARSE_ACROSS_M).round() as i32;
    let pairs = (-steps..=steps).flat_map(|a| (-steps..=steps).map(move |b| (a, b)));
    let places =
        pairs.map(|(a, b)| COARSE_ACROSS_M * (f64::from(a) * aside + f64::from(b) * other));
    places.filter(|place| place.norm() <= ACROSS_M).collect()
}

/// Two directions across `axis` and each other.
fn across(axis: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let mut any = Vector3::zeros();
    any[axis.iamin()] = 1.0;
    let aside = axis.cross(&any).normalize();
    [aside, axis.cross(&aside)]
}

/// The place with the least misfit.
fn least(tried: impl Iterator<Item = Tried>) -> Option<Tried> {
    tried.min_by(|(a, _), (b, _)| a.misfit().total_cmp(&b.misfit()))
}
