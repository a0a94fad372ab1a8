use super::*;
use crate::bag::Locator;
use proptest::prelude::*;

const MS: i64 = 1_000_000;

/// Moves and rests of these lengths, milliseconds, in turn.
#[derive(Debug)]
struct Session {
    moves: Vec<(i64, i64)>,
}

impl Session {
    /// How far the arm has gone, radians: a steady speed while it moves.
    fn position(&self, time_ns: i64) -> f64 {
        let (mut start, mut gone) = (2000 * MS, 0.0);
        for (moving, resting) in &self.moves {
            let within = (time_ns - start).clamp(0, moving * MS);
            gone += 0.4e-9 * within as f64;
            start += (moving + resting) * MS;
        }
        gone
    }

    fn end_ns(&self) -> i64 {
        2000 * MS + self.moves.iter().map(|(a, b)| (a + b) * MS).sum::<i64>()
    }

    fn track(&self) -> Track {
        let mut track = Track::new(vec!["j".to_owned()]);
        for time in (0..self.end_ns()).step_by(10 * MS as usize) {
            track.push(time, &[self.position(time)]);
        }
        track.finish();
        track
    }

    /// Images stamped `offset_ns` before the joints' clock; `noise` is a share of pixels.
    fn frames(&self, offset_ns: i64, noise: f32) -> Vec<FrameEntry> {
        let times = (0..self.end_ns()).step_by(33 * MS as usize);
        times
            .zip(0_u32..)
            .map(|(time, index)| {
                let moved = self.position(time) - self.position(time - 33 * MS);
                let jitter = noise * (index.wrapping_mul(2_654_435_761) >> 24) as f32 / 255.0;
                FrameEntry {
                    stamp_ns: time - offset_ns,
                    locator: Locator::default(),
                    unfit: None,
                    stands_in: false,
                    change: 2.0 * moved as f32 + jitter,
                }
            })
            .collect()
    }
}

fn session() -> impl Strategy<Value = Session> {
    proptest::collection::vec((400_i64..1500, 700_i64..3000), 4..9)
        .prop_map(|moves| Session { moves })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn motion_tells_the_offset(session in session(), offset_ms in -700_i64..700, noise in 0.0_f32..0.01) {
        let frames = session.frames(offset_ms * MS, noise);
        let found = skew(&frames, &[&session.track()], 0).unwrap();
        let error = (found.seconds - 1e-3 * offset_ms as f64).abs();
        prop_assert!(error <= 0.02 && error <= found.uncertainty_s + 0.017, "{found:?}");
        // What is known already is not told again.
        let rest = skew(&frames, &[&session.track()], offset_ms * MS).unwrap();
        prop_assert!(rest.seconds.abs() <= 0.02, "{rest:?}");
    }

    /// Pixels that change for other reasons tell nothing.
    #[test]
    fn no_motion_tells_nothing(session in session(), noise in 0.01_f32..0.5) {
        let still = Session { moves: Vec::new() };
        let long = Session { moves: vec![(1, session.end_ns() / MS)] };
        let mut frames = long.frames(0, noise);
        frames.truncate(session.frames(0, 0.0).len());
        prop_assert_eq!(skew(&frames, &[&session.track()], 0), None);
        prop_assert_eq!(skew(&session.frames(0, noise), &[&still.track()], 0), None);
    }
}

#[test]
fn a_regular_motion_may_mean_anything() {
    let session = Session { moves: vec![(250, 250); 40] };
    assert_eq!(skew(&session.frames(100 * MS, 0.0), &[&session.track()], 0), None);
}

#[test]
fn images_far_apart_tell_nothing() {
    let session = Session { moves: vec![(1000, 2000); 8] };
    let frames: Vec<_> = session.frames(0, 0.0).into_iter().step_by(10).collect();
    assert_eq!(skew(&frames, &[&session.track()], 0), None);
}
