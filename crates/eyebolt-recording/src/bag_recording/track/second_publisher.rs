//! A second publisher on the topic of the arm that always tells the same.
//!
//! `joint_state_publisher` and its like tell zeros, or the middles of the limits, of joints that a
//! driver tells as well. Between two states of the driver stands one that is far from both.

use super::line::Line;
use std::collections::BTreeMap;

/// Visits of the line to a place.
#[derive(Clone, Copy, Debug)]
struct Excursions {
    /// How often it came back at once to where it was.
    back: u64,
    /// How often it went on elsewhere since.
    gone_on: u64,
    first_ns: i64,
    last_ns: i64,
}

/// Fewer are no publisher.
const FEWEST: u64 = 4;
/// One of so many may go on elsewhere.
const MOST_GONE_ON: u64 = 4;
/// The states before and after are nearer to each other than this share of the way there.
const NEARER: f64 = 0.25;
/// No arm goes away and comes back in this time, nanoseconds.
const LONGEST_NS: i64 = 500_000_000;

/// Turns of the line one after the other at the same positions.
struct Run<'a> {
    there: &'a [f64],
    /// Numbers of the turns.
    turns: std::ops::Range<usize>,
    first_ns: i64,
    /// Where the line was before and after, if no message stands between, and it was there no longer
    /// than an arm needs.
    jumps: Option<[&'a [f64]; 2]>,
}

/// `line` without the publisher that always tells the same, if there is one among others, and how many
/// turns that were. Joints that are nearer to each other than `still` have not moved.
///
/// Of two that fit, as where the arm rests in one place only, the one that goes on for longer.
pub(super) fn of_one_publisher(line: &Line, still: f64) -> Option<(Line, u64)> {
    let turns: Vec<_> = line.iter().collect();
    let runs = runs(&turns);
    let constant = constant_publisher(&runs, still)?;
    let mut rest = Line::new(line.joints());
    let (mut second, mut left_out) = (0, false);
    for run in &runs {
        if run.jumps.is_some() && bits(run.there).eq(constant.iter().copied()) {
            second += run.turns.len() as u64;
            left_out = true;
            continue;
        }
        for (stamp_ns, positions, gap_ns) in turns.get(run.turns.clone()).unwrap_or_default() {
            let before_ns = rest.last_ns().unwrap_or(*stamp_ns);
            let across_ns = stamp_ns.saturating_sub(before_ns);
            rest.push(*stamp_ns, positions, if left_out { across_ns } else { *gap_ns });
            left_out = false;
        }
    }
    Some((rest, second))
}

/// A turn of a line: stamp, positions, and the longest time without a sample on the way there.
type Turn<'a> = (i64, &'a [f64], i64);

fn runs<'a>(turns: &[Turn<'a>]) -> Vec<Run<'a>> {
    let mut runs = Vec::new();
    let mut start = 0;
    while let Some((first_ns, there, in_gap_ns)) = turns.get(start).copied() {
        let same = |(_, told, _): &&Turn<'_>| bits(told).eq(bits(there));
        let end = start + turns.iter().skip(start).take_while(same).count().max(1);
        let last_ns = turns.get(end - 1).map_or(first_ns, |turn| turn.0);
        let around = start.checked_sub(1).and_then(|before| turns.get(before)).zip(turns.get(end));
        let jumps = around.filter(|(before, after)| {
            first_ns.saturating_sub(before.0) <= in_gap_ns
                && after.0.saturating_sub(last_ns) <= after.2
                && after.0.saturating_sub(before.0) <= LONGEST_NS
        });
        let jumps = jumps.map(|(before, after)| [before.1, after.1]);
        runs.push(Run { there, turns: start..end, first_ns, jumps });
        start = end;
    }
    runs
}

/// What the second publisher tells.
fn constant_publisher(runs: &[Run<'_>], still: f64) -> Option<Vec<u64>> {
    let mut known: BTreeMap<Vec<u64>, Excursions> = BTreeMap::new();
    for run in runs {
        let key: Vec<u64> = bits(run.there).collect();
        if run.jumps.is_some_and(|[before, after]| is_excursion([before, run.there, after], still))
        {
            known.entry(key).or_insert_with(|| Excursions::from(run.first_ns)).back(run.first_ns);
        } else if let Some(excursions) = known.get_mut(&key) {
            excursions.gone_on += 1;
        }
    }
    let fitting = known.into_iter().filter(|(_, excursions)| excursions.are_of_a_publisher());
    fitting.max_by_key(|(_, excursions)| excursions.span_ns()).map(|(there, _)| there)
}

impl Excursions {
    fn from(first_ns: i64) -> Self {
        Self { back: 0, gone_on: 0, first_ns, last_ns: first_ns }
    }

    fn back(&mut self, stamp_ns: i64) {
        self.back += 1;
        self.last_ns = stamp_ns;
    }

    fn are_of_a_publisher(&self) -> bool {
        self.back >= FEWEST && self.gone_on < self.back / MOST_GONE_ON
    }

    fn span_ns(&self) -> i64 {
        self.last_ns.saturating_sub(self.first_ns)
    }
}

/// Whether the line goes from `before` far away and back.
fn is_excursion([before, there, after]: [&[f64]; 3], still: f64) -> bool {
    let away = distance(before, there).min(distance(after, there));
    away > still && distance(before, after) < NEARER * away
}

/// By which positions that were told again are known.
fn bits(positions: &[f64]) -> impl Iterator<Item = u64> + '_ {
    positions.iter().map(|position| position.to_bits())
}

/// How far the joint is that is furthest, radians or metres.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
