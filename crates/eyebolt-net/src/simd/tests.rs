//! Every instruction set against sums in 64 bits.

use super::*;
use crate::random::Random;
use proptest::prelude::*;

fn values(seed: u64, count: usize) -> Vec<f32> {
    let mut random = Random::new(seed);
    (0..count).map(|_| random.normal() as f32).collect()
}

/// Whether all are within what rounding a sum of so many products may cost; NaN never is.
fn are_close(found: &[f32], expected: &[f64], depth: usize) -> bool {
    let limit = 8.0 * f64::from(f32::EPSILON) * (depth as f64 + 4.0);
    found.iter().zip(expected).all(|(&a, b)| (f64::from(a) - b).abs() < limit)
}

proptest! {
    #[test]
    fn rows_times_a_panel(
        pairs in 0_usize..40,
        depth in 0_usize..40,
        step in 1_usize..=4,
        seed in any::<u64>(),
    ) {
        let width = step * PANEL_STEP;
        let rows = 23;
        let mut random = Random::new(seed);
        let input: Vec<u32> = (0..pairs).map(|_| random.below(rows) as u32).collect();
        // Distinct, in no order.
        let output: Vec<u16> = (0..pairs).map(|p| (p * 41 % 43) as u16).collect();
        let (a, b, c) = (values(seed, rows * depth), values(seed + 1, depth * width), values(seed + 2, 43 * width));
        let mut expected: Vec<f64> = c.iter().map(|&value| value.into()).collect();
        for (&i, &o) in input.iter().zip(&output) {
            for k in 0..depth {
                for n in 0..width {
                    expected[usize::from(o) * width + n] +=
                        f64::from(a[i as usize * depth + k]) * f64::from(b[k * width + n]);
                }
            }
        }
        for isa in Isa::available() {
            let mut found = c.clone();
            let (a, panel) = (Rows { values: &a, width: depth }, Rows { values: &b, width });
            multiply_rows(isa, a, &input, panel, &mut found, &output);
            prop_assert!(are_close(&found, &expected, depth), "{}", isa.name());
        }
    }

    #[test]
    fn transposed_rows_times_rows(
        pairs in 0_usize..60,
        columns in 0_usize..30,
        step in 1_usize..=4,
        seed in any::<u64>(),
    ) {
        let (width, first, rows) = (step * PANEL_STEP, 3, 23);
        let stride = first + columns + 2;
        let mut random = Random::new(seed);
        let input: Vec<u32> = (0..pairs).map(|_| random.below(rows) as u32).collect();
        let (a, b, c) = (values(seed, rows * stride), values(seed + 1, pairs * width), values(seed + 2, columns * width));
        let mut expected: Vec<f64> = c.iter().map(|&value| value.into()).collect();
        for (p, &i) in input.iter().enumerate() {
            for m in 0..columns {
                for n in 0..width {
                    expected[m * width + n] +=
                        f64::from(a[i as usize * stride + first + m]) * f64::from(b[p * width + n]);
                }
            }
        }
        for isa in Isa::available() {
            let mut found = c.clone();
            let (a, b) = (Rows { values: &a, width: stride }, Rows { values: &b, width });
            multiply_transposed(isa, a, &input, first, b, &mut found, &[5, 99]);
            prop_assert!(are_close(&found, &expected, pairs), "{}", isa.name());
        }
    }
}

#[test]
#[should_panic(expected = "is outside")]
fn an_input_outside_is_refused() {
    let a = Rows { values: &[0.0; 4], width: 2 };
    let panel = Rows { values: &[0.0; 32], width: 16 };
    multiply_rows(Isa::detect(), a, &[2], panel, &mut [0.0; 16], &[0]);
}

#[test]
#[should_panic(expected = "is outside")]
fn an_output_outside_is_refused() {
    let a = Rows { values: &[0.0; 4], width: 2 };
    let panel = Rows { values: &[0.0; 32], width: 16 };
    multiply_rows(Isa::detect(), a, &[1], panel, &mut [0.0; 16], &[1]);
}
