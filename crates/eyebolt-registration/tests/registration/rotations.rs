use crate::strategies::config;
use eyebolt_registration::{NormalEquations, median, spread_rotations};
use nalgebra::{SVector, Vector3};
use proptest::prelude::*;

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn there_are_as_many_rotations_as_asked_for_and_all_are_rotations(
        count in 0..3000_usize, seed in any::<u64>(),
    ) {
        let rotations = spread_rotations(count, seed);
        prop_assert_eq!(rotations.len(), count);
        for rotation in &rotations {
            prop_assert!((rotation.as_vector().norm() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn as_many_rotations_turn_an_axis_to_either_side(axis in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0]) {
        let Some(axis) = Vector3::from(axis).try_normalize(0.1) else { return Ok(()) };
        let mean: Vector3<f64> = spread_rotations(4000, 3).iter().map(|r| r * axis).sum();
        prop_assert!(mean.norm() / 4000.0 < 0.01, "{}", mean.norm() / 4000.0);
    }

    #[test]
    fn the_median_has_as_many_below_as_above(mut values in prop::collection::vec(-1.0..1.0, 1..40)) {
        let middle = median(&mut values).unwrap();
        let below = values.iter().filter(|v| **v < middle).count();
        let above = values.iter().filter(|v| **v > middle).count();
        prop_assert!(below <= values.len() / 2 && above <= (values.len() - 1) / 2);
    }

    #[test]
    fn normal_equations_of_a_linear_problem_give_its_solution(
        rows in prop::collection::vec(([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], 0.1..2.0_f64), 8..20),
        solution in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0],
    ) {
        let solution = SVector::<f64, 3>::from(solution);
        let (mut whole, mut halves) = (NormalEquations::default(), NormalEquations::default());
        for (jacobian, weight) in &rows {
            let jacobian = SVector::from(*jacobian);
            whole.add(&jacobian, -jacobian.dot(&solution), *weight);
            let mut one = NormalEquations::default();
            one.add(&jacobian, -jacobian.dot(&solution), 0.5 * weight);
            halves.add_all(&one);
            halves.add_all(&one);
        }
        prop_assert!((whole.information - halves.information).amax() < 1e-12);
        prop_assert!((whole.gradient - halves.gradient).amax() < 1e-12);
        prop_assert!((whole.weight - halves.weight).abs() < 1e-12);
        prop_assume!(whole.information.determinant() > 1e-3);
        prop_assert!((whole.solve(0.0).unwrap() - solution).norm() < 1e-8);
    }
}

#[test]
fn nothing_has_no_median_and_no_evidence_no_solution() {
    assert_eq!(median(&mut []), None);
    assert_eq!(NormalEquations::<6>::default().solve(1e-3), None);
}
