//! How the clocks of depth and joints differ.

use super::scan::TopicScan;
use super::track::Track;
use super::{skew, stamps};
use crate::provenance::ClockOffset;

/// By the motion that both saw, else by the times of recording; `None` if one of them sets no
/// stamps.
pub(super) fn clock_offset(
    range: &TopicScan,
    joints: &TopicScan,
    tracks: &[&Track],
) -> Option<ClockOffset> {
    let offset = stamps::clock_offset(&range.stamps, &joints.stamps);
    let known = offset.filter(|offset| offset.applied).map_or(0.0, |offset| offset.seconds);
    let skew = skew::skew(range.frames(), tracks, (known * 1e9).round() as i64);
    let found = match skew {
        None => offset,
        Some(skew) => {
            let (seconds, uncertainty_s) = (known + skew.seconds, skew.uncertainty_s);
            Some(ClockOffset { seconds, uncertainty_s, applied: true, seen: true })
        }
    };
    match found {
        Some(ClockOffset { seconds, uncertainty_s, applied, seen }) => tracing::debug!(
            seconds,
            uncertainty_s,
            applied,
            seen_in_motion = seen,
            "clock offset of depth and joints"
        ),
        None => tracing::debug!("no stamps that tell a clock offset of depth and joints"),
    }
    found
}
