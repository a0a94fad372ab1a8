//! Laws of pairing, whatever the frames and joints.

use super::limit::{LARGEST_LIMIT, SMALLEST_LIMIT};
use super::*;
use crate::bag::Locator;
use proptest::prelude::*;

const MS: i64 = 1_000_000;

fn frames(stamps_ns: &[i64]) -> Vec<FrameEntry> {
    let entry = |stamp_ns: &i64| FrameEntry {
        stamp_ns: *stamp_ns,
        locator: Locator::default(),
        unfit: None,
        change: f32::NAN,
        stands_in: false,
    };
    stamps_ns.iter().map(entry).collect()
}

/// Joint states from 0, with so many milliseconds and so much motion to the next.
fn track(steps: &[(i64, f64)]) -> Track {
    let mut track = Track::new(vec!["j".to_owned()]);
    let (mut stamp, mut position) = (0, 0.0);
    for (ms, rise) in steps {
        track.push(stamp, &[position]);
        (stamp, position) = (stamp + ms * MS, position + rise);
    }
    track.finish();
    track
}

fn steps() -> impl Strategy<Value = Vec<(i64, f64)>> {
    let rise = prop_oneof![3 => Just(0.0), 1 => -0.01..0.01_f64];
    let ms = prop_oneof![9 => 1_i64..30, 1 => 30_i64..3000];
    proptest::collection::vec((ms, rise), 2..120)
}

fn stamps() -> impl Strategy<Value = Vec<i64>> {
    proptest::collection::vec((-100..4000_i64).prop_map(|ms| ms * MS), 1..60)
}

fn indices(paired: &Paired) -> Vec<usize> {
    paired.kept.iter().map(|kept| kept.index).collect()
}

proptest! {
    #[test]
    fn every_frame_is_kept_or_dropped(steps in steps(), stamps in stamps()) {
        let paired = pair(&frames(&stamps), &[&track(&steps)], None, None);
        let mut all = indices(&paired);
        prop_assert!(all.is_sorted());
        all.extend(paired.dropped.iter().map(|frame| frame.index));
        all.sort_unstable();
        prop_assert_eq!(all, (0..stamps.len()).collect::<Vec<_>>());
        prop_assert!((SMALLEST_LIMIT..=LARGEST_LIMIT).contains(&paired.motion_limit));
    }

    #[test]
    fn a_stricter_limit_keeps_fewer(
        steps in steps(), stamps in stamps(), limits in (0.0..0.05_f64, 0.0..0.05_f64),
    ) {
        let (track, frames) = (track(&steps), frames(&stamps));
        let kept = |limit: f64| indices(&pair(&frames, &[&track], None, Some(limit)));
        let (few, many) = (kept(limits.0.min(limits.1)), kept(limits.0.max(limits.1)));
        prop_assert!(few.iter().all(|index| many.contains(index)));
    }

    /// What a clock says does not matter, if the offset to the other is known.
    #[test]
    fn shifted_frames_are_paired_the_same(
        steps in steps(), stamps in stamps(), seconds in -1_700_000_000..1_700_000_000_i64,
    ) {
        let track = track(&steps);
        let moved: Vec<_> = stamps.iter().map(|stamp| stamp - seconds * 1_000_000_000).collect();
        let offset =
            ClockOffset { seconds: seconds as f64, uncertainty_s: 0.0, applied: true, seen: false };
        let (here, there) = (
            pair(&frames(&stamps), &[&track], None, None),
            pair(&frames(&moved), &[&track], Some(offset), None),
        );
        prop_assert_eq!(indices(&here), indices(&there));
        for (here, there) in here.kept.iter().zip(&there.kept) {
            prop_assert_eq!(&here.positions, &there.positions);
        }
    }

    /// Whoever else tells of other joints at rest changes nothing.
    #[test]
    fn more_publishers_change_nothing(steps in steps(), stamps in stamps()) {
        let (track, frames) = (track(&steps), frames(&stamps));
        let mut other = Track::new(vec!["k".to_owned()]);
        (-500..800).for_each(|i| other.push(10 * MS * i, &[7.0]));
        other.finish();
        let alone = pair(&frames, &[&track], None, None);
        let both = pair(&frames, &[&track, &other], None, None);
        let j = both.names.iter().position(|name| name == "j").unwrap();
        let kept = both.kept.iter().map(|kept| kept.positions[j]);
        // One that is told on change only is held beside others.
        let told_once = track.is_sparse(joints::ON_CHANGE_NS);
        prop_assert!(told_once || indices(&alone) == indices(&both));
        prop_assert!(told_once || kept.eq(alone.kept.iter().map(|kept| kept.positions[0])));
    }
}
