//! Rotations spread evenly over SO(3).

use eyebolt_render::Random;
use nalgebra::{Quaternion, UnitQuaternion, Vector4};
use std::f64::consts::TAU;

/// `count` rotations, evenly spread (super-Fibonacci spirals; Alexa, CVPR 2022), all turned by one
/// that depends on `seed`.
///
/// The largest gap to the nearest of 4 000 is about 14 degrees, and falls with the cube root.
pub fn spread_rotations(count: usize, seed: u64) -> Vec<UnitQuaternion<f64>> {
    let turn = any_rotation(seed);
    // The two constants of the article: root of two, and the positive root of x^4 = x + 4.
    let (phi, psi) = (std::f64::consts::SQRT_2, 1.533_751_168_755_204_3);
    (0..count)
        .map(|i| {
            let s = i as f64 + 0.5;
            let (r, big_r) = ((s / count as f64).sqrt(), (1.0 - s / count as f64).sqrt());
            let (alpha, beta) = (TAU * s / phi, TAU * s / psi);
            let (x, y) = (r * alpha.sin(), r * alpha.cos());
            let (z, w) = (big_r * beta.sin(), big_r * beta.cos());
            turn * UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
        })
        .collect()
}

/// A rotation drawn evenly from SO(3) (Shoemake, Graphics Gems III).
fn any_rotation(seed: u64) -> UnitQuaternion<f64> {
    let mut random = Random::new(seed);
    let (radius, a, b) = (random.uniform(), TAU * random.uniform(), TAU * random.uniform());
    let (r, big_r) = (radius.sqrt(), (1.0 - radius).sqrt());
    let [x, y, z, w] = [big_r * a.sin(), big_r * a.cos(), r * b.sin(), r * b.cos()];
    UnitQuaternion::from_quaternion(Quaternion::from(Vector4::new(x, y, z, w)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};

    fn config() -> Config {
        let rng_seed = RngSeed::Fixed(7);
        Config { cases: 200, rng_seed, failure_persistence: None, ..Config::default() }
    }

    proptest! {
        #![proptest_config(config())]

        #[test]
        fn no_rotation_is_far_from_the_nearest_of_four_thousand(
            q in prop::array::uniform4(-1.0f64..1.0)
        ) {
            let q = Quaternion::new(q[0], q[1], q[2], q[3]);
            prop_assume!(q.norm() > 0.1);
            let q = UnitQuaternion::from_quaternion(q);
            let nearest = spread_rotations(4000, 1)
                .iter()
                .map(|other| q.angle_to(other).to_degrees())
                .fold(f64::INFINITY, f64::min);
            prop_assert!(nearest < 18.0, "{nearest}");
        }
    }
}
