//! By how much the clocks of depth and joints differ, from the motion that both saw.
//!
//! When the arm moves, pixels change. The share of pixels that change from one depth image to the
//! next is correlated with how far the joints went meanwhile, for every offset that clocks may have.

use super::scan::FrameEntry;
use super::track::Track;

/// An offset that the motion tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Skew {
    /// To be added to stamps of depth for the clock of the joints.
    pub(super) seconds: f64,
    pub(super) uncertainty_s: f64,
}

/// Offsets that are tried lie this far on either side, and so far apart, nanoseconds.
const REACH_NS: i64 = 1_000_000_000;
const STEP_NS: i64 = 10_000_000;
/// Images further apart tell too little of when the arm moved.
const LONGEST_INTERVAL_NS: i64 = 200_000_000;
/// Pairs of images that make an estimate, and as many as are looked at.
const FEWEST: usize = 60;
const MOST: usize = 20_000;
/// Time that is looked at, nanoseconds.
const LONGEST_SPAN_NS: i64 = 1_200_000_000_000;
/// Joints move no faster than this for the purpose: beyond, no more pixels change, radians a step.
const FASTEST: f64 = 5e-3;
/// Correlation that is no accident, and by how much no other offset may come near.
const LEAST_CORRELATION: f64 = 0.6;
const AHEAD: f64 = 0.1;
/// Other offsets are those further away than this.
const APART_NS: i64 = 300_000_000;
/// Correlations this near to the best are as good.
const AS_GOOD: f64 = 0.01;

/// From one image to the next.
struct Interval {
    from_ns: i64,
    to_ns: i64,
    change: f64,
}

/// The offset, if the motion tells one; `shift_ns` is already known to be added.
pub(super) fn skew(frames: &[FrameEntry], tracks: &[&Track], shift_ns: i64) -> Option<Skew> {
    let intervals = intervals(frames, shift_ns);
    if intervals.len() < FEWEST {
        return None;
    }
    let path = Path::new(&intervals, tracks)?;
    let changes: Vec<f64> = intervals.iter().map(|interval| interval.change).collect();
    let lags: Vec<i64> = (-REACH_NS / STEP_NS..=REACH_NS / STEP_NS).map(|i| i * STEP_NS).collect();
    let correlations: Vec<f64> = lags
        .iter()
        .map(|lag| {
            let moved = intervals.iter().map(|i| {
                path.at(i.to_ns.saturating_add(*lag)) - path.at(i.from_ns.saturating_add(*lag))
            });
            correlation(&changes, &moved.collect::<Vec<_>>()).unwrap_or(0.0)
        })
        .collect();
    let known = || lags.iter().copied().zip(correlations.iter().copied());
    let (best_ns, best) = known().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let rivals = known().filter(|(lag, _)| lag.abs_diff(best_ns) > APART_NS.unsigned_abs());
    let rival = rivals.map(|(_, correlation)| correlation).fold(0.0, f64::max);
    // At the end of the reach, the best may lie beyond.
    if best < LEAST_CORRELATION || best - rival < AHEAD || best_ns.abs() == REACH_NS {
        return None;
    }
    let as_good: Vec<i64> =
        known().filter(|(_, r)| *r >= best - AS_GOOD).map(|(lag, _)| lag).collect();
    let (low, high) = (*as_good.first()?, *as_good.last()?);
    let seconds = (low + high) as f64 / 2.0 * 1e-9;
    Some(Skew { seconds, uncertainty_s: ((high - low) / 2 + STEP_NS) as f64 * 1e-9 })
}

fn intervals(frames: &[FrameEntry], shift_ns: i64) -> Vec<Interval> {
    let shifted = |stamp_ns: i64| stamp_ns.saturating_add(shift_ns);
    let pairs = frames.windows(2).filter_map(|pair| {
        let [a, b] = pair else { return None };
        let step = b.stamp_ns.checked_sub(a.stamp_ns)?;
        let stamped = !a.stands_in && !b.stands_in;
        let known = stamped && (1..=LONGEST_INTERVAL_NS).contains(&step) && b.change.is_finite();
        let (from_ns, to_ns) = (shifted(a.stamp_ns), shifted(b.stamp_ns));
        known.then_some(Interval { from_ns, to_ns, change: f64::from(b.change) })
    });
    let mut intervals: Vec<_> = pairs.take(MOST).collect();
    if let Some(start_ns) = intervals.first().map(|first| first.from_ns) {
        let within =
            |i: &Interval| (0..LONGEST_SPAN_NS).contains(&i.to_ns.saturating_sub(start_ns));
        intervals.retain(within);
    }
    intervals
}

/// How far the joints have gone since the beginning, step by step.
struct Path {
    start_ns: i64,
    gone: Vec<f64>,
}

impl Path {
    /// `None` if nothing moves, or everything all the time.
    fn new(intervals: &[Interval], tracks: &[&Track]) -> Option<Self> {
        let start_ns = intervals.first()?.from_ns.saturating_sub(2 * REACH_NS);
        let end_ns = intervals.last()?.to_ns.saturating_add(2 * REACH_NS);
        let steps = end_ns.saturating_sub(start_ns) / STEP_NS;
        let joints: Vec<Vec<usize>> =
            tracks.iter().map(|track| (0..track.names().len()).collect()).collect();
        let (mut gone, mut sum, mut moving) = (vec![0.0], 0.0, 0);
        for step in 0..steps {
            let from_ns = start_ns.saturating_add(step * STEP_NS);
            let to_ns = from_ns.saturating_add(STEP_NS);
            let motions = tracks
                .iter()
                .zip(&joints)
                .map(|(track, joints)| track.motion(joints, from_ns, to_ns, REACH_NS).0);
            let motion = motions.fold(0.0, f64::max).min(FASTEST);
            moving += i64::from(motion > 0.1 * FASTEST);
            sum += motion;
            gone.push(sum);
        }
        (moving > 0 && 10 * moving < 9 * steps).then_some(Self { start_ns, gone })
    }

    fn at(&self, time_ns: i64) -> f64 {
        let place = time_ns.saturating_sub(self.start_ns) as f64 / STEP_NS as f64;
        let at = |index: usize| self.gone.get(index).or(self.gone.last()).copied().unwrap_or(0.0);
        let index = place.max(0.0) as usize;
        at(index) + (place - index as f64) * (at(index + 1) - at(index))
    }
}

/// Pearson's; `None` if one of them does not vary.
fn correlation(a: &[f64], b: &[f64]) -> Option<f64> {
    let count = a.len().min(b.len()) as f64;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let (mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        let (a, b) = (a - mean_a, b - mean_b);
        aa += a * a;
        bb += b * b;
        ab += a * b;
    }
    Some(ab / (aa * bb).sqrt()).filter(|r| r.is_finite())
}

#[cfg(test)]
mod tests;
