use super::*;
use proptest::prelude::*;

const MS: i64 = 1_000_000;

fn track(samples: &[(i64, f64)]) -> Track {
    let mut track = Track::new(vec!["j".to_owned()]);
    samples.iter().for_each(|(stamp, position)| track.push(*stamp, &[*position]));
    track.finish();
    track
}

#[test]
fn hours_at_rest_take_no_memory() {
    let noise = |i: i64| 0.9 * TOLERANCE * if i % 3 == 0 { 1.0 } else { -0.1 };
    let samples: Vec<_> = (0..100_000).map(|i| (i * MS, 0.5 + noise(i))).collect();
    let track = track(&samples);
    assert!(track.stamps_ns.len() < 10, "{} turns", track.stamps_ns.len());
    assert_eq!(track.count(), 100_000);
}

#[test]
fn a_gap_is_known_and_stands_alone() {
    let mut samples: Vec<_> = (0..100).map(|i| (i * 10 * MS, 0.0)).collect();
    samples.extend((0..100).map(|i| (3000 * MS + i * 10 * MS, 0.0)));
    let track = track(&samples);
    assert_eq!(track.piece(500 * MS).unwrap().gap_ns, 10 * MS);
    assert_eq!(track.piece(2000 * MS).unwrap().gap_ns, 3000 * MS - 990 * MS);
    assert_eq!(track.piece(3500 * MS).unwrap().gap_ns, 10 * MS);
    assert!(track.piece(-1).is_none() && track.piece(3990 * MS + 1).is_none());
}

#[test]
fn what_happens_in_a_gap_is_no_motion() {
    let track = track(&[(0, 0.0), (1000 * MS, 1.0), (2000 * MS, 0.0)]);
    assert_eq!(track.motion(&[0], 900 * MS, 1100 * MS, 200 * MS).0, 0.0);
    assert!((track.motion(&[0], 900 * MS, 2000 * MS, 200 * MS).0 - 1.0).abs() < 1e-12);
    assert!((track.motion(&[0], 900 * MS, 1100 * MS, 1000 * MS).0 - 0.1).abs() < 1e-12);
}

#[test]
fn samples_that_go_back_are_counted_and_left_out() {
    let track = track(&[(0, 0.0), (10 * MS, 1.0), (5 * MS, 9.0), (10 * MS, 9.0), (20 * MS, 2.0)]);
    assert_eq!(track.backward(), 1);
    assert_eq!(track.first_backward_ns(), Some((10 * MS, 5 * MS)));
    assert!((track.piece(15 * MS).unwrap().at(15 * MS)[0] - 1.5).abs() < 1e-12);
}

proptest! {
    /// The line passes near every sample, whatever the samples are.
    #[test]
    fn near_every_sample(
        steps in proptest::collection::vec((1_i64..200 * MS, -3e-3..3e-3_f64), 1..200),
    ) {
        let (mut stamp, mut position) = (0, 0.0);
        let samples: Vec<_> = steps.iter().map(|(time, rise)| {
            (stamp, position) = (stamp + time, position + rise);
            (stamp, position)
        }).collect();
        let track = track(&samples);
        for (stamp, position) in samples {
            let on_line = track.piece(stamp).unwrap().at(stamp)[0];
            prop_assert!((on_line - position).abs() <= 2.0 * TOLERANCE + 1e-12);
        }
    }

    /// The motion is the range of the positions, to the tolerance.
    #[test]
    fn motion_is_the_range(
        rises in proptest::collection::vec(-0.01..0.01_f64, 2..80), a in 0_usize..80, b in 0_usize..80,
    ) {
        let mut position = 0.0;
        let samples: Vec<_> = (0..).zip(&rises).map(|(i, rise)| {
            position += rise;
            (i * 10 * MS, position)
        }).collect();
        let (a, b) = (a % samples.len(), b % samples.len());
        let (a, b) = (a.min(b), a.max(b));
        let seen = samples[a..=b].iter().map(|(_, position)| *position);
        let (low, high) = seen.fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(p), h.max(p)));
        let motion = track(&samples).motion(&[0], samples[a].0, samples[b].0, 200 * MS).0;
        prop_assert!((motion - (high - low)).abs() <= 4.0 * TOLERANCE);
    }

    /// Coarser, and still near every sample.
    #[test]
    fn coarsening_keeps_the_shape(rises in proptest::collection::vec(-0.01..0.01_f64, 2..200)) {
        let mut position = 0.0;
        let samples: Vec<_> = (0..).zip(&rises).map(|(i, rise)| {
            position += rise;
            (i * 10 * MS, position)
        }).collect();
        let mut coarse = Track::new(vec!["j".to_owned()]);
        samples.iter().for_each(|(stamp, position)| coarse.push(*stamp, &[*position]));
        let before = coarse.stamps_ns.len();
        (0..4).for_each(|_| coarse.coarsen());
        coarse.finish();
        prop_assert!(coarse.stamps_ns.len() <= before + 1);
        prop_assert_eq!(coarse.span_ns(), Some((0, samples.last().unwrap().0)));
        for (stamp, position) in samples {
            let on_line = coarse.piece(stamp).unwrap().at(stamp)[0];
            // Each of four roundings adds at most twice its tolerance.
            prop_assert!((on_line - position).abs() <= 2.0 * 31.0 * TOLERANCE);
        }
    }
}
