//! Where the joints of all publishers are at one time.

use super::super::track::Track;
use super::{DropReason, SMALLEST_LIMIT};
use std::collections::BTreeSet;

/// Joints of the same frame rate as the frames need not be nearer than this, nanoseconds.
const NEAR_NS: i64 = 25_000_000;
/// Between joint states that are nearer to each other than this, positions are interpolated.
const DENSE_NS: i64 = 200_000_000;
/// And than this, if nothing moved between them.
const SPARSE_NS: i64 = 1_500_000_000;

/// The joints of all tracks.
pub(super) struct Joints<'a> {
    /// Tracks, and which of their positions are taken.
    tracks: Vec<(&'a Track, Vec<usize>)>,
    /// Whether some track tells how the joints move.
    live: bool,
}

impl<'a> Joints<'a> {
    /// A joint that several tracks tell is taken from the one that tells most often: some programs
    /// tell all joints once, when they start.
    pub(super) fn new(tracks: &[&'a Track]) -> Self {
        let mut sorted = tracks.to_vec();
        sorted.sort_by_key(|track| std::cmp::Reverse(track.count()));
        let mut known = BTreeSet::new();
        let mut taken = |track: &'a Track| -> Vec<usize> {
            let names = track.names().iter().enumerate();
            names.filter(|(_, name)| known.insert(*name)).map(|(index, _)| index).collect()
        };
        let live = sorted.first().is_some_and(|track| track.count() > 1);
        let tracks = sorted.into_iter().map(|track| (track, taken(track)));
        Self { tracks: tracks.filter(|(_, taken)| !taken.is_empty()).collect(), live }
    }

    pub(super) fn names(&self) -> Vec<String> {
        let names = |(track, taken): &(&Track, Vec<usize>)| pick(track.names(), taken);
        self.tracks.iter().flat_map(names).collect()
    }

    /// Positions at a time, and how far the joint that moves most moves around it.
    pub(super) fn at(&self, stamp_ns: i64, half_ns: i64) -> Result<(Vec<f64>, f64), DropReason> {
        let (from_ns, to_ns) = (stamp_ns.saturating_sub(half_ns), stamp_ns.saturating_add(half_ns));
        let mut positions = Vec::new();
        let mut motion = 0.0_f64;
        for (track, taken) in &self.tracks {
            // What was told once stays so: drivers of grippers do that.
            let once = track.count() == 1 && self.live;
            let all =
                if once { track.nearest(stamp_ns).map(|(_, all)| all.to_vec()) } else { None };
            let all = all.map_or_else(|| positions_at(track, stamp_ns), Ok)?;
            positions.extend(pick(&all, taken));
            motion = motion.max(track.motion(from_ns, to_ns, DENSE_NS));
        }
        Ok((positions, motion))
    }
}

fn pick<T: Clone>(all: &[T], taken: &[usize]) -> Vec<T> {
    taken.iter().filter_map(|index| all.get(*index).cloned()).collect()
}

fn positions_at(track: &Track, stamp_ns: i64) -> Result<Vec<f64>, DropReason> {
    let nearest =
        track.nearest(stamp_ns).ok_or(DropReason::StaleJoints { age_s: f64::INFINITY })?;
    if let Some(piece) = track.piece(stamp_ns) {
        let still = || {
            let steps = piece.start.iter().zip(piece.end).map(|(a, b)| (a - b).abs());
            steps.fold(0.0, f64::max) <= SMALLEST_LIMIT
        };
        if piece.gap_ns <= DENSE_NS || (piece.gap_ns <= SPARSE_NS && still()) {
            return Ok(piece.at(stamp_ns));
        }
    }
    let age_ns = i64::try_from(nearest.0.abs_diff(stamp_ns)).unwrap_or(i64::MAX);
    if age_ns <= NEAR_NS {
        return Ok(nearest.1.to_vec());
    }
    Err(DropReason::StaleJoints { age_s: age_ns as f64 * 1e-9 })
}
