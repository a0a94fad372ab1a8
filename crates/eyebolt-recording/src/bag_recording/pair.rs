//! Which frames were taken while the arm stood still, and where its joints were.

mod joints;
mod limit;

use super::scan::{FrameEntry, TopicScan, Unfit};
use super::stamps::TRANSPORT_S;
use super::track::Track;
use crate::error::RecordingError;
use crate::provenance::{ClockOffset, DropReason, DroppedFrame};
use eyebolt_robot::Input;
use joints::{Joints, State};
use limit::limit_of;
use std::path::Path;

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
    /// In the order of [`Paired::names`]; NaN of joints that were not told.
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

/// A frame takes at least and at most so long on either side of its stamp, nanoseconds: exposure,
/// and filters over time.
const SHORTEST_NS: i64 = 20_000_000;
const LONGEST_NS: i64 = 100_000_000;
/// Frames are not told from motion farther than this, however little the clocks agree.
const LARGEST_DOUBT_S: f64 = 1.0;

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
    let exposure_ns = half_exposure(frames);
    let mut latest = i64::MIN;
    let judged: Vec<_> = frames
        .iter()
        .map(|frame| {
            // A stamp before one that came earlier is of another run of the clock.
            let backward = frame.stamp_ns <= latest && !frame.stands_in;
            // What stands in for a stamp is by the clock of the recorder.
            let (shift_s, doubt_s) = match frame.stands_in {
                true => (0.0, doubt_s.max(TRANSPORT_S)),
                false => (shift, doubt_s),
            };
            if !frame.stands_in {
                latest = latest.max(frame.stamp_ns);
            }
            let half_ns = exposure_ns.saturating_add(nanoseconds(doubt_s));
            match &frame.unfit {
                Some(unfit) => Err(DropReason::from(unfit)),
                None if backward => Err(DropReason::StampBackward),
                None => joints.at(frame.stamp_ns.saturating_add(nanoseconds(shift_s)), half_ns),
            }
        })
        .collect();
    let motions = judged.iter().filter_map(|state| Some(state.as_ref().ok()?.motion)).collect();
    let motion_limit = max_motion.unwrap_or_else(|| limit_of(motions));
    let mut paired = Paired { names: joints.names(), motion_limit, ..Paired::default() };
    for ((index, state), frame) in judged.into_iter().enumerate().zip(frames) {
        let reason = match state {
            Ok(State { positions, motion, .. }) if motion <= motion_limit => {
                paired.kept.push(Kept { index, positions: positions.into() });
                continue;
            }
            Ok(State { motion, most, .. }) => {
                let joint = paired.names.get(most).cloned().unwrap_or_default();
                DropReason::Moving { joint, motion, limit: motion_limit }
            }
            Err(reason) => reason,
        };
        let stamp_s = frame.stamp_ns as f64 * 1e-9;
        paired.dropped.push(DroppedFrame { index, stamp_s, reason });
    }
    paired
}

/// As [`pair`], of the frames of the topic `depth`; errors if none takes part. `path` is for
/// messages.
pub(super) fn pair_topics(
    path: &Path,
    depth: &TopicScan,
    tracks: &[&Track],
    offset: Option<ClockOffset>,
    max_motion: Option<f64>,
) -> Result<Paired, RecordingError> {
    let frames = depth.frames();
    let paired = pair(frames, tracks, offset, max_motion);
    tracing::debug!(limit = paired.motion_limit, given = max_motion.is_some(), "motion limit");
    for frame in &paired.dropped {
        tracing::debug!(frame = frame.index, stamp_s = frame.stamp_s, reason = %frame.reason, "frame dropped");
    }
    if !paired.kept.is_empty() {
        return Ok(paired);
    }
    let first = paired.dropped.first().map(|frame| format!("; of the first, {}", frame.reason));
    let (count, first) = (frames.len(), first.unwrap_or_default());
    let problem = format!("none of its {count} frames can be used{first}");
    let remedy = format!(
        "Let the arm rest in every configuration while the camera looks on, and record joint \
         states all the time; {} changes what counts as rest",
        Input::MAX_MOTION
    );
    Err(RecordingError::invalid(path, &depth.name, problem, remedy))
}

fn nanoseconds(seconds: f64) -> i64 {
    // Saturates.
    (seconds * 1e9).round() as i64
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

#[cfg(test)]
mod tests;
