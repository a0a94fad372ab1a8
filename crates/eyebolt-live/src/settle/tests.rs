//! Laws of rest.

use super::*;
use proptest::prelude::*;

const MS: i64 = 1_000_000;

/// An arm whose first joint is where `position` has it, told every 10 ms with noise, before a camera of 30 Hz.
struct Told<'a> {
    position: &'a dyn Fn(f64) -> f64,
    noise_rad: f64,
    /// Share of the pixels that something else changes.
    passers_by: f64,
}

/// A number between -1 and 1 that depends on another, without any order.
fn scatter(number: u64) -> f64 {
    let mixed = number
        .wrapping_mul(0x9E37_79B9_7F4A_7C15)
        .rotate_left(31)
        .wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

impl Told<'_> {
    /// What the detector says every 10 ms up to `end_s`.
    fn run(&self, end_s: f64) -> Vec<(f64, Stillness)> {
        let mut settle = Settle::default();
        let mut said = Vec::new();
        for step in 0..(end_s * 100.0) as i64 {
            let (at_ns, at_s) = (step * 10 * MS, step as f64 / 100.0);
            let position = (self.position)(at_s);
            let noisy = position + self.noise_rad * scatter(step as u64);
            settle.joints(
                at_ns,
                &[("j".to_owned(), noisy), ("k".to_owned(), 1.0)].into_iter().collect(),
            );
            if step % 3 == 0 {
                settle.depth(at_ns, self.image(position, step));
            }
            said.push((at_s, settle.at(at_ns)));
        }
        said
    }

    /// A tenth of the pixels are the arm's, whose depth goes with the joint.
    fn image(&self, position: f64, step: i64) -> Vec<f32> {
        let pixel = |at: i64| {
            let noise = 1.0 + 0.004 * scatter((step * 4096 + at) as u64) as f32;
            let others = (at as f64) < 1000.0 * self.passers_by;
            match (at % 10 == 0, others) {
                (_, true) => 500.0 + 300.0 * scatter((step * 4096 + at) as u64) as f32,
                (true, _) => (1000.0 + 2000.0 * (position * 40.0).sin().abs() as f32) * noise,
                _ => 2000.0 * noise,
            }
        };
        (0..1000).map(pixel).collect()
    }
}

fn rests(said: &[(f64, Stillness)], from_s: f64, to_s: f64) -> usize {
    let within = said.iter().filter(|(at, _)| (from_s..to_s).contains(at));
    within.filter(|(_, still)| matches!(still, Stillness::AtRest(_))).count()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// An arm that moves, rests and moves again is at rest while it rests, and at no other time.
    #[test]
    fn it_rests_while_it_rests(
        noise_mrad in 0.0..0.4_f64, speed in 0.05..1.5_f64, stop_s in 2.0..6.0_f64, rest_s in 2.0..6.0_f64,
    ) {
        let go_s = stop_s + rest_s;
        let position = |at: f64| speed * (at.min(stop_s) + (at - go_s).max(0.0));
        let said = Told { position: &position, noise_rad: 1e-3 * noise_mrad, passers_by: 0.0 }.run(go_s + 2.0);
        prop_assert_eq!(rests(&said, 0.0, stop_s), 0);
        prop_assert_eq!(rests(&said, go_s + 0.15, go_s + 2.0), 0);
        // Before it settled nobody can know.
        let settled = rests(&said, stop_s + 1.2, go_s);
        prop_assert!(settled as f64 >= 95.0 * (rest_s - 1.2), "{} of {}", settled, rest_s);
        let since = said.iter().find_map(|(_, still)| match still { Stillness::AtRest(since) => Some(*since), _ => None });
        let since_s = since.unwrap_or_default() as f64 * 1e-9;
        prop_assert!((stop_s - 0.4..stop_s + 0.4).contains(&since_s), "{} {}", since_s, stop_s);
    }

    /// Encoders that shake less than an arm may, at rest all the time.
    #[test]
    fn noise_is_no_motion(noise_mrad in 0.0..2.0_f64) {
        let said = Told { position: &|_| 0.3, noise_rad: 1e-3 * noise_mrad, passers_by: 0.0 }.run(12.0);
        prop_assert!(rests(&said, 4.0, 12.0) > 750);
    }

    /// People who never stop do not keep an arm from resting, but it takes longer.
    #[test]
    fn passers_by_are_waited_out(share in 0.1..0.5_f64) {
        let said = Told { position: &|at| 0.3 * at.min(3.0), noise_rad: 1e-5, passers_by: share }.run(9.0);
        prop_assert_eq!(rests(&said, 0.0, 3.0), 0);
        prop_assert!(rests(&said, 6.0, 9.0) > 290);
    }
}

#[test]
fn an_arm_that_shakes_after_it_stopped_is_waited_for() {
    // Joints are still from 3 s on; what the camera sees shakes until 4 s.
    let mut settle = Settle::default();
    let mut first = None;
    for step in 0..700 {
        let at_ns = step * 10 * MS;
        let position = if step < 300 { step as f64 * 0.01 } else { 3.0 };
        settle.joints(at_ns, &[("j".to_owned(), position)].into_iter().collect());
        let shakes = if step < 400 { 200.0 * (step % 2) as f32 } else { 0.0 };
        settle.depth(
            at_ns,
            (0..100).map(|at| if at < 20 { 1000.0 + shakes } else { 2000.0 }).collect(),
        );
        if let (Stillness::AtRest(_), None) = (settle.at(at_ns), first) {
            first = Some(step);
        }
    }
    let first = first.unwrap();
    assert!((400..410).contains(&first), "{first}");
}

#[test]
fn nobody_knows_without_joints() {
    let mut settle = Settle::default();
    assert_eq!(settle.at(0), Stillness::Unknown);
    settle.depth(0, vec![1.0; 10]);
    assert_eq!(settle.at(100 * MS), Stillness::Unknown);
    for step in 0..300 {
        settle.joints(step * 10 * MS, &[("j".to_owned(), 1.0)].into_iter().collect());
        settle.depth(step * 10 * MS, vec![1.0; 10]);
    }
    assert!(matches!(settle.at(3000 * MS), Stillness::AtRest(_)));
    // The driver was ended.
    assert_eq!(settle.at(9000 * MS), Stillness::Unknown);
}

#[test]
fn a_camera_that_does_not_look_on_makes_an_arm_wait() {
    let mut settle = Settle::default();
    for step in 0..900 {
        settle.joints(step * 10 * MS, &[("j".to_owned(), 1.0)].into_iter().collect());
    }
    assert_eq!(settle.at(9000 * MS), Stillness::Moving);
}
