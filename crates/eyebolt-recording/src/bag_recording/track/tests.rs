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
    assert!(track.line.turns() < 10, "{} turns", track.line.turns());
    assert_eq!(track.count(), 100_000);
}

/// Ten hours, ten times a second.
const LONG: i64 = 360_000;

fn long(position: impl Fn(f64) -> [f64; 7]) -> Track {
    let mut track = Track::new((1..8).map(|i| format!("j{i}")).collect());
    (0..LONG).for_each(|i| track.push(100 * MS * i, &position(0.1 * i as f64)));
    track.finish();
    assert_eq!(track.count() as i64, LONG);
    assert!(!track.line.is_larger_than(MOST_TURNS + 1, MOST_POSITIONS + 7));
    track
}

#[test]
fn hours_of_seldom_samples_at_rest_take_no_memory_either() {
    let noise = |seconds: f64, joint: usize| 0.4e-4 * (seconds * (7.0 + joint as f64)).sin();
    let track = long(|seconds| std::array::from_fn(|joint| 0.5 + noise(seconds, joint)));
    assert!(track.line.turns() < 10, "{} turns", track.line.turns());
    assert_eq!((track.gone_through, track.thinning()), (0, 1));
    // Three times in two seconds, and around the bounds of what is dense.
    for steps in [[700, 600], [190, 210], [1400, 1500]] {
        let (mut track, mut stamp) = (Track::new(vec!["j".to_owned()]), 0);
        for i in 0..20_000 {
            track.push(stamp, &[noise(stamp as f64 * 1e-9, 0)]);
            stamp += MS * steps[i % 2];
        }
        track.finish();
        assert!(track.line.turns() < 10, "{} turns of {steps:?}", track.line.turns());
        assert!(track.piece(stamp / 2).unwrap().gap_ns <= SPARSE_NS);
    }
}

/// At rest for most of a minute, then on to the next place within three seconds.
#[test]
fn hours_of_seldom_samples_and_some_motion_take_little() {
    let place = |minute: f64, joint: usize| (minute * (1.0 + 0.3 * joint as f64)).sin();
    let at = |seconds: f64| -> [f64; 7] {
        let minute = (seconds / 60.0).floor();
        let share = ((seconds - 60.0 * minute - 57.0) / 3.0).clamp(0.0, 1.0);
        // From rest to rest.
        let share = share * share * (3.0 - 2.0 * share);
        std::array::from_fn(|j| (1.0 - share) * place(minute, j) + share * place(minute + 1.0, j))
    };
    let track = long(at);
    // No more than the samples in motion.
    assert!(track.line.turns() < 600 * 32, "{} turns", track.line.turns());
    assert_eq!((track.gone_through, track.tolerance()), (0, TOLERANCE));
    for minute in [0.0, 17.0, 599.0] {
        let at_rest = track.piece((60e9 * minute + 30e9) as i64).unwrap();
        assert_eq!((at_rest.gap_ns, at_rest.start[3]), (100 * MS, place(minute, 3)));
    }
}

/// All samples differ by much, so that no tolerance is of help: it stays, and what is done for all of
/// them is in proportion to their number.
#[test]
fn motion_that_no_line_follows_is_thinned() {
    let mut random = 1_u64;
    let mut next = move || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (random >> 40) as f64 * 1e-6
    };
    let mut track = Track::new(vec!["j".to_owned()]);
    let count = 4 * MOST_TURNS as i64;
    (0..count).for_each(|i| track.push(10 * MS * i, &[next()]));
    track.finish();
    assert!(track.line.turns() <= MOST_TURNS + 1);
    assert_eq!(track.tolerance(), TOLERANCE);
    assert!(track.thinning() > 1 && track.gone_through < 20 * count as usize);
    // What was forgotten is a gap.
    let piece = track.piece(15 * MS).unwrap();
    assert!(piece.gap_ns >= 20 * MS && piece.gap_ns == piece.end_ns - piece.start_ns);
    assert_eq!(track.span_ns(), Some((0, 10 * MS * (count - 1))));
}

#[test]
fn a_line_that_turns_too_often_is_made_coarser() {
    // A shake of one milliradian.
    let samples: Vec<_> =
        (0..2 * MOST_TURNS as i64).map(|i| (i * MS, if i % 2 == 0 { 1e-3 } else { 0.0 })).collect();
    let track = track(&samples);
    assert!(track.tolerance() > TOLERANCE && track.tolerance() < 1e-2 && track.thinning() == 1);
    assert!(track.line.turns() <= MOST_TURNS && track.gone_through < 20 * samples.len());
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
        coarse.finish();
        let before = coarse.line.turns();
        (0..4).for_each(|_| coarse = coarse.coarser(2.0 * coarse.tolerance));
        prop_assert!(coarse.line.turns() <= before + 1);
        prop_assert_eq!(coarse.span_ns(), Some((0, samples.last().unwrap().0)));
        for (stamp, position) in samples {
            let on_line = coarse.piece(stamp).unwrap().at(stamp)[0];
            // Each of four roundings adds at most twice its tolerance.
            prop_assert!((on_line - position).abs() <= 2.0 * 31.0 * TOLERANCE);
        }
    }
}
