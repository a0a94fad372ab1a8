//! How far joints move.

use crate::noise_level::NoiseLevel;
use eyebolt_robot::JointPositions;
use std::collections::{BTreeMap, VecDeque};

/// How far joints move, by their positions.
#[derive(Clone, Debug, Default)]
pub(super) struct JointMotion {
    recent: BTreeMap<String, VecDeque<(i64, f64)>>,
    level: NoiseLevel,
    last_ns: Option<i64>,
    still_since: Option<i64>,
}

/// Over so long motion is measured: long enough for a slow arm to be seen moving.
const WINDOW_NS: i64 = 300_000_000;
/// Positions that come faster tell no more.
const STEP_NS: i64 = 8_000_000;
/// Joints of the largest robot.
const MOST_JOINTS: usize = 1000;
/// As for frames of bags: half a millimetre and five at the end of an arm, radians or metres.
const SMALLEST_LIMIT: f64 = 5e-4;
const LARGEST_LIMIT: f64 = 5e-3;

impl JointMotion {
    pub(super) fn add(&mut self, at_ns: i64, positions: &JointPositions) {
        for (name, position) in positions.iter() {
            if !self.recent.contains_key(name) {
                if self.recent.len() >= MOST_JOINTS {
                    continue;
                }
                self.recent.insert(name.to_owned(), VecDeque::new());
            }
            let Some(recent) = self.recent.get_mut(name) else { continue };
            let new = recent.back().is_none_or(|(last, _)| at_ns.saturating_sub(*last) >= STEP_NS);
            match recent.back_mut() {
                // The newest counts, whether or not it is kept beside the one before.
                Some(last) if !new && recent_is_far(last.1, position) => last.1 = position,
                _ if new => recent.push_back((at_ns, position)),
                _ => {}
            }
            while recent.front().is_some_and(|(old, _)| at_ns.saturating_sub(*old) > WINDOW_NS) {
                recent.pop_front();
            }
        }
        self.last_ns = Some(at_ns);
        self.judge(at_ns);
    }

    fn judge(&mut self, at_ns: i64) {
        let motion = self.recent.values().map(range).fold(0.0, f64::max);
        let seen = self.recent.values().filter_map(|recent| Some(recent.front()?.0)).min();
        if seen.is_none_or(|first| at_ns.saturating_sub(first) < WINDOW_NS / 2) {
            return;
        }
        self.level.add(motion);
        if motion > self.level.limit(SMALLEST_LIMIT, LARGEST_LIMIT) {
            self.still_since = None;
        } else if self.still_since.is_none() {
            self.still_since = seen;
        }
    }

    /// Whether positions came lately.
    pub(super) fn is_told(&self, at_ns: i64) -> bool {
        self.last_ns.is_some_and(|last| at_ns.saturating_sub(last) <= 2 * WINDOW_NS)
    }

    /// Since when no joint moves; `None` if one does, or nobody tells.
    pub(super) fn still_since(&self, at_ns: i64) -> Option<i64> {
        self.still_since.filter(|_| self.is_told(at_ns))
    }
}

/// Whether a position is no repetition of the one before.
fn recent_is_far(before: f64, now: f64) -> bool {
    (before - now).abs() > SMALLEST_LIMIT
}

fn range(recent: &VecDeque<(i64, f64)>) -> f64 {
    let positions = recent.iter().map(|(_, position)| *position);
    let (low, high) = positions
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    if low <= high { high - low } else { 0.0 }
}
