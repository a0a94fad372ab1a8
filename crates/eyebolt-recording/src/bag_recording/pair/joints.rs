//! Where the joints of all publishers are at one time.

use crate::bag_recording::track::{DENSE_NS, SPARSE_NS, STILL, Track};
use crate::provenance::DropReason;
use std::collections::BTreeSet;

/// Joints of the same frame rate as the frames need not be nearer than this, nanoseconds.
const NEAR_NS: i64 = 25_000_000;

/// Joints that are told more seldom, beside others, are told when they change: no arm is.
pub(super) const ON_CHANGE_NS: i64 = 2_000_000_000;

/// The joints of all tracks.
pub(super) struct Joints<'a> {
    /// Tracks, and which of their positions are taken.
    tracks: Vec<(&'a Track, Vec<usize>)>,
    /// Whether some track tells how the joints move.
    live: bool,
}

impl<'a> Joints<'a> {
    /// A joint that several tracks tell is taken from one that tells that something moves, as no
    /// publisher of defaults does, and of several from the one that tells most often: some programs
    /// tell all joints once, when they start.
    pub(super) fn new(tracks: &[&'a Track]) -> Self {
        let mut sorted = tracks.to_vec();
        sorted.sort_by_key(|track| std::cmp::Reverse((track.moves(), track.count())));
        let mut known = BTreeSet::new();
        let mut taken = |track: &'a Track| -> Vec<usize> {
            let names = track.names().iter().enumerate();
            names.filter(|(_, name)| known.insert(*name)).map(|(index, _)| index).collect()
        };
        let live = sorted.iter().any(|track| track.count() > 1);
        let tracks = sorted.into_iter().map(|track| (track, taken(track)));
        Self { tracks: tracks.filter(|(_, taken)| !taken.is_empty()).collect(), live }
    }

    pub(super) fn names(&self) -> Vec<String> {
        let names = |(track, taken): &(&Track, Vec<usize>)| pick(track.names(), taken);
        self.tracks.iter().flat_map(names).collect()
    }

    /// Positions at a time, and how far the joint that moves most moves around it.
    pub(super) fn at(&self, stamp_ns: i64, half_ns: i64) -> Result<State, DropReason> {
        let (from_ns, to_ns) = (stamp_ns.saturating_sub(half_ns), stamp_ns.saturating_add(half_ns));
        let mut state = State { positions: Vec::new(), motion: 0.0, most: 0 };
        for (number, (track, taken)) in self.tracks.iter().enumerate() {
            // What is told on change only, beside others that are told all the time, stays as it was
            // told last: drivers of grippers do that.
            let sparse =
                self.live && (number > 0 || track.count() == 1) && track.is_sparse(ON_CHANGE_NS);
            let mut all =
                if sparse { track.held(stamp_ns) } else { positions_at(track, stamp_ns)? };
            for joint in taken {
                if let Some(position) = all.get_mut(*joint).filter(|position| position.is_nan()) {
                    *position = track.across(*joint, stamp_ns).unwrap_or(f64::NAN);
                }
            }
            let (motion, most) = track.motion(taken, from_ns, to_ns, DENSE_NS);
            if let Some(place) = taken.iter().position(|index| *index == most)
                && motion > state.motion
            {
                (state.motion, state.most) = (motion, state.positions.len() + place);
            }
            state.positions.extend(pick(&all, taken));
        }
        Ok(state)
    }
}

/// Joints at one time.
pub(super) struct State {
    /// In the order of [`Joints::names`]; NaN of joints that nobody told.
    pub(super) positions: Vec<f64>,
    /// How far the joint that moves most moves meanwhile, radians or metres.
    pub(super) motion: f64,
    /// Which joint that is.
    pub(super) most: usize,
}

fn pick<T: Clone>(all: &[T], taken: &[usize]) -> Vec<T> {
    taken.iter().filter_map(|index| all.get(*index).cloned()).collect()
}

fn positions_at(track: &Track, stamp_ns: i64) -> Result<Vec<f64>, DropReason> {
    let stale = |age_s: f64| {
        let joint = track.names().first().cloned().unwrap_or_default();
        DropReason::StaleJoints { joint, age_s }
    };
    let nearest = track.nearest(stamp_ns).ok_or_else(|| stale(f64::INFINITY))?;
    if let Some(piece) = track.piece(stamp_ns) {
        let still = || {
            let steps = piece.start.iter().zip(piece.end).map(|(a, b)| (a - b).abs());
            steps.fold(0.0, f64::max) <= STILL
        };
        if piece.gap_ns <= DENSE_NS || (piece.gap_ns <= SPARSE_NS && still()) {
            return Ok(piece.at(stamp_ns));
        }
    }
    let age_ns = i64::try_from(nearest.0.abs_diff(stamp_ns)).unwrap_or(i64::MAX);
    if age_ns <= NEAR_NS {
        return Ok(nearest.1.to_vec());
    }
    Err(stale(age_ns as f64 * 1e-9))
}
