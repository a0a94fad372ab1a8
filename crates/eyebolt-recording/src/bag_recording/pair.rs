//! Which frames were taken while the arm stood still, and where its joints were.

use super::scan::{FrameEntry, Unfit};
use super::stamps::ClockOffset;
use super::track::Track;
use std::collections::BTreeSet;
use std::fmt;

/// A frame of a bag that does not take part.
#[derive(Clone, Debug, PartialEq)]
pub struct DroppedFrame {
    /// Number of the frame among those of its topic, from 0.
    pub index: usize,
    /// Its stamp, seconds.
    pub stamp_s: f64,
    /// Why it does not take part.
    pub reason: DropReason,
}

/// Why a frame does not take part.
#[derive(Clone, Debug, PartialEq)]
pub enum DropReason {
    /// A joint moved while the frame was taken.
    Moving {
        /// By how much, radians or metres.
        motion: f64,
        /// By how much it may.
        limit: f64,
    },
    /// No joint state is near.
    StaleJoints {
        /// From the frame to the nearest joint state, seconds.
        age_s: f64,
    },
    /// It is stamped no later than a frame before it.
    StampBackward,
    /// The camera saw nothing: no pixel has depth.
    Empty,
    /// Its message is damaged.
    Unreadable(String),
}

impl fmt::Display for DropReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Moving { motion, limit } => write!(
                f,
                "the arm moved: a joint turned {:.2} degrees meanwhile, {:.2} are allowed",
                motion.to_degrees(),
                limit.to_degrees()
            ),
            Self::StaleJoints { age_s } => {
                write!(f, "the nearest joint state is {age_s:.2} s away")
            }
            Self::StampBackward => write!(f, "its time stamp is not later than the one before"),
            Self::Empty => write!(f, "no pixel has depth"),
            Self::Unreadable(problem) => write!(f, "{problem}"),
        }
    }
}

impl From<&Unfit> for DropReason {
    fn from(unfit: &Unfit) -> Self {
        match unfit {
            Unfit::Empty => Self::Empty,
            Unfit::Unreadable(wrong) => {
                Self::Unreadable(format!("{}: {}", wrong.field, wrong.problem))
            }
        }
    }
}

/// A frame with the positions of the joints.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    /// Number among the frames of the topic.
    pub(super) index: usize,
    /// In the order of [`Paired::names`].
    pub(super) positions: Box<[f64]>,
}

/// Frames and joints brought together.
#[derive(Clone, Debug, Default)]
pub(super) struct Paired {
    pub(super) names: Vec<String>,
    pub(super) kept: Vec<Kept>,
    pub(super) dropped: Vec<DroppedFrame>,
    /// How far a joint may move while a frame is taken, radians or metres.
    pub(super) motion_limit: f64,
}

/// Joints of the same frame rate as the frames need not be nearer than this, nanoseconds.
const NEAR_NS: i64 = 25_000_000;
/// Between joint states that are nearer to each other than this, positions are interpolated.
const DENSE_NS: i64 = 200_000_000;
/// And than this, if nothing moved between them.
const SPARSE_NS: i64 = 1_500_000_000;
/// A frame takes at least and at most so long on either side of its stamp, nanoseconds: exposure,
/// and filters over time.
const SHORTEST_NS: i64 = 20_000_000;
const LONGEST_NS: i64 = 100_000_000;
/// Frames are not told from motion farther than this, however little the clocks agree.
const LARGEST_DOUBT_S: f64 = 1.0;

/// The limit of motion, radians or metres, lies between half a millimetre and five at the end of an
/// arm: as far as encoders at rest make of it, and as much as still calibrates to millimetres.
const SMALLEST_LIMIT: f64 = 5e-4;
const LARGEST_LIMIT: f64 = 5e-3;
/// Above what the stillest quarter of the frames has by so many times, an arm moves.
const ABOVE_STILL: f64 = 5.0;

/// Brings `frames` and `tracks` together.
///
/// `max_motion` (radians or metres) is how far a joint may move while a frame is taken; otherwise
/// the frames themselves tell: those at rest have little and much the same.
pub(super) fn pair(
    frames: &[FrameEntry],
    tracks: &[&Track],
    offset: Option<ClockOffset>,
    max_motion: Option<f64>,
) -> Paired {
    let joints = Joints::new(tracks);
    let shift = offset.filter(|offset| offset.applied).map_or(0.0, |offset| offset.seconds);
    let doubt_s = offset.map_or(0.0, |offset| offset.uncertainty_s).min(LARGEST_DOUBT_S);
    let half_ns = half_exposure(frames).saturating_add(nanoseconds(doubt_s));
    let mut latest = i64::MIN;
    let judged: Vec<_> = frames
        .iter()
        .map(|frame| {
            // A stamp before one that came earlier is of another run of the clock.
            let backward = frame.stamp_ns <= latest;
            latest = latest.max(frame.stamp_ns);
            match &frame.unfit {
                Some(unfit) => Err(DropReason::from(unfit)),
                None if backward => Err(DropReason::StampBackward),
                None => joints.at(frame.stamp_ns.saturating_add(nanoseconds(shift)), half_ns),
            }
        })
        .collect();
    let motions = judged.iter().filter_map(|state| Some(state.as_ref().ok()?.1)).collect();
    let motion_limit = max_motion.unwrap_or_else(|| limit_of(motions));
    let mut paired = Paired { names: joints.names(), motion_limit, ..Paired::default() };
    for ((index, state), frame) in judged.into_iter().enumerate().zip(frames) {
        let reason = match state {
            Ok((positions, motion)) if motion <= motion_limit => {
                paired.kept.push(Kept { index, positions: positions.into() });
                continue;
            }
            Ok((_, motion)) => DropReason::Moving { motion, limit: motion_limit },
            Err(reason) => reason,
        };
        let stamp_s = frame.stamp_ns as f64 * 1e-9;
        paired.dropped.push(DroppedFrame { index, stamp_s, reason });
    }
    paired
}

fn nanoseconds(seconds: f64) -> i64 {
    // Saturates.
    (seconds * 1e9).round() as i64
}

/// The joints of all tracks.
struct Joints<'a> {
    /// Tracks, and which of their positions are taken.
    tracks: Vec<(&'a Track, Vec<usize>)>,
    /// Whether some track tells how the joints move.
    live: bool,
}

impl<'a> Joints<'a> {
    /// A joint that several tracks tell is taken from the one that tells most often: some programs
    /// tell all joints once, when they start.
    fn new(tracks: &[&'a Track]) -> Self {
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

    fn names(&self) -> Vec<String> {
        let names = |(track, taken): &(&Track, Vec<usize>)| pick(track.names(), taken);
        self.tracks.iter().flat_map(names).collect()
    }

    /// Positions at a time, and how far the joint that moves most moves around it.
    fn at(&self, stamp_ns: i64, half_ns: i64) -> Result<(Vec<f64>, f64), DropReason> {
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

/// How long on either side of its stamp a frame is taken, nanoseconds: half the time between two.
fn half_exposure(frames: &[FrameEntry]) -> i64 {
    let mut steps: Vec<i64> = frames
        .windows(2)
        .filter_map(|pair| match pair {
            [a, b] => b.stamp_ns.checked_sub(a.stamp_ns).filter(|step| *step > 0),
            _ => None,
        })
        .collect();
    let middle = steps.len() / 2;
    let median = if steps.is_empty() { LONGEST_NS } else { *steps.select_nth_unstable(middle).1 };
    (median / 2).clamp(SHORTEST_NS, LONGEST_NS)
}

/// The motion above which a frame is of a moving arm.
fn limit_of(mut motions: Vec<f64>) -> f64 {
    let quarter = motions.len() / 4;
    if motions.is_empty() {
        return SMALLEST_LIMIT;
    }
    let still = *motions.select_nth_unstable_by(quarter, f64::total_cmp).1;
    (ABOVE_STILL * still).clamp(SMALLEST_LIMIT, LARGEST_LIMIT)
}

#[cfg(test)]
mod tests;
