use crate::strategies::{
    config, difference, negated, rotation, rotation_difference, transform, vector,
};
use eyebolt_geometry::{
    Base, Camera, MeanError, Transform, intrinsic_mean_rotation, mean_rotation, mean_transform,
    rotation_exp,
};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;

type Rotations = Vec<UnitQuaternion<f64>>;
type MeanOf = fn(&[UnitQuaternion<f64>], Option<&[f64]>) -> Result<UnitQuaternion<f64>, MeanError>;

const MEANS: [MeanOf; 2] = [mean_rotation, intrinsic_mean_rotation];

/// Weighted rotations within 1 rad of a random one, where both means are unique.
fn cluster() -> impl Strategy<Value = (Rotations, Vec<f64>)> {
    (rotation(), vec((vector(0.55), 0.1..2.0_f64), 1..12)).prop_map(|(middle, items)| {
        items.into_iter().map(|(v, weight)| (rotation_exp(&v) * middle, weight)).unzip()
    })
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn turning_all_turns_the_mean((cluster, weights) in cluster(), r in rotation()) {
        for mean in MEANS {
            let of_all = mean(&cluster, Some(&weights)).unwrap();
            let left: Rotations = cluster.iter().map(|q| r * q).collect();
            let right: Rotations = cluster.iter().map(|q| q * r).collect();
            let of_left = mean(&left, Some(&weights)).unwrap();
            let of_right = mean(&right, Some(&weights)).unwrap();
            prop_assert!(rotation_difference(&of_left, &(r * of_all)) < 1e-12);
            prop_assert!(rotation_difference(&of_right, &(of_all * r)) < 1e-12);
        }
    }

    #[test]
    fn signs_of_quaternions_mean_nothing((cluster, weights) in cluster(), signs: u16) {
        let flip = |(i, q): (usize, &UnitQuaternion<f64>)| if signs >> i & 1 == 1 { negated(q) } else { *q };
        let flipped: Rotations = cluster.iter().enumerate().map(flip).collect();
        for mean in MEANS {
            let (a, b) = (mean(&cluster, Some(&weights)), mean(&flipped, Some(&weights)));
            prop_assert!(rotation_difference(&a.unwrap(), &b.unwrap()) < 1e-13);
        }
    }

    #[test]
    fn order_means_nothing((cluster, weights) in cluster(), by in 0..12_usize) {
        let (mut moved, mut moved_weights) = (cluster.clone(), weights.clone());
        moved.rotate_left(by % cluster.len());
        moved_weights.rotate_left(by % cluster.len());
        moved.reverse();
        moved_weights.reverse();
        for mean in MEANS {
            let (a, b) = (mean(&cluster, Some(&weights)), mean(&moved, Some(&moved_weights)));
            prop_assert!(rotation_difference(&a.unwrap(), &b.unwrap()) < 1e-13);
        }
    }

    #[test]
    fn mean_of_the_same_is_the_same(q in rotation(), count in 1..20_usize) {
        for mean in MEANS {
            let of_all = mean(&vec![q; count], None).unwrap();
            prop_assert!(of_all.w >= 0.0);
            prop_assert!(rotation_difference(&of_all, &q) < 1e-13);
        }
    }

    #[test]
    fn mean_of_two_is_half_way(q in rotation(), v in vector(1.7)) {
        let ends = [q, rotation_exp(&v) * q];
        for mean in MEANS {
            let middle = mean(&ends, None).unwrap();
            prop_assert!(rotation_difference(&middle, &(rotation_exp(&(v * 0.5)) * q)) < 1e-12);
        }
    }

    #[test]
    fn a_weight_is_a_number_of_copies((cluster, _) in cluster(), copies in 1..5_usize) {
        let mut weights = vec![3.0; cluster.len()];
        weights[0] *= copies as f64;
        let mut repeated = cluster.clone();
        repeated.extend(vec![cluster[0]; copies - 1]);
        for mean in MEANS {
            let (a, b) = (mean(&cluster, Some(&weights)), mean(&repeated, None));
            prop_assert!(rotation_difference(&a.unwrap(), &b.unwrap()) < 1e-13);
        }
    }

    #[test]
    fn the_intrinsic_mean_divides_the_angle_by_the_weights(q in rotation(), v in vector(1.7)) {
        let ends = [q, rotation_exp(&v) * q];
        let mean = intrinsic_mean_rotation(&ends, Some(&[3.0, 1.0])).unwrap();
        prop_assert!(rotation_difference(&mean, &(rotation_exp(&(v * 0.25)) * q)) < 1e-12);
    }

    #[test]
    fn transforms_average_both_parts(a in transform(), t in vector(1.0), r in vector(1.0)) {
        let b = Transform::from_parts(a.translation_m() + t, rotation_exp(&r) * a.rotation());
        let mean = mean_transform(&[a, b], Some(&[0.5, 0.5])).unwrap();
        let turned = rotation_exp(&(r * 0.5)) * a.rotation();
        let expected = Transform::<Camera, Base>::from_parts(a.translation_m() + t * 0.5, turned);
        prop_assert!(difference(&mean, &expected) < 1e-12);
    }
}

#[test]
fn what_has_no_mean_says_why() {
    let identity = UnitQuaternion::identity();
    let opposite = rotation_exp(&(Vector3::z() * std::f64::consts::PI));
    let broken = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(f64::NAN, 0.0, 0.0, 0.0));
    for mean in MEANS {
        assert_eq!(mean(&[], None), Err(MeanError::Empty));
        assert_eq!(mean(&[identity, opposite], None), Err(MeanError::Ambiguous));
        assert_eq!(mean(&[identity, broken], None), Err(MeanError::NotFinite { index: 1 }));
        for weights in [[0.0, 0.0], [1.0, -1.0], [1.0, f64::NAN], [f64::INFINITY, 1.0]] {
            assert_eq!(mean(&[identity, identity], Some(&weights)), Err(MeanError::Weights));
        }
        let count = MeanError::WeightCount { values: 1, weights: 2 };
        assert_eq!(mean(&[identity], Some(&[1.0, 1.0])), Err(count));
    }
    let nowhere = Transform::<Camera, Base>::from_parts(Vector3::repeat(f64::NAN), identity);
    assert_eq!(mean_transform(&[nowhere], None), Err(MeanError::NotFinite { index: 0 }));
    assert_eq!(mean_transform::<Camera, Base>(&[], None), Err(MeanError::Empty));
}

#[test]
fn a_zero_weight_removes_a_rotation() {
    let far = rotation_exp(&Vector3::new(0.0, 2.0, 0.0));
    let mean = mean_rotation(&[UnitQuaternion::identity(), far], Some(&[1.0, 0.0])).unwrap();
    assert!(mean.angle() < 1e-14);
}
