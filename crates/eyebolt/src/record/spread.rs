//! The configurations that differ most, where there are more than needed.

use eyebolt_geometry::{Base, Link, Transform};

/// A radian counts as much as so many metres: about the reach of an arm's hand.
const METRES_A_RADIAN: f64 = 0.3;

/// Indices, rising, of at most `most` of `postures` that are far from each other: starting with the
/// first, always the one farthest from all before (T. F. Gonzalez, "Clustering to minimize the
/// maximum intercluster distance", 1985).
pub(crate) fn most_spread(postures: &[Vec<Transform<Base, Link>>], most: usize) -> Vec<usize> {
    if postures.len() <= most {
        return (0..postures.len()).collect();
    }
    let mut chosen = vec![0];
    let mut nearest = vec![f64::INFINITY; postures.len()];
    while chosen.len() < most.max(1) {
        let last = &postures[chosen[chosen.len() - 1]];
        for (distance, posture) in nearest.iter_mut().zip(postures) {
            *distance = distance.min(apart(last, posture));
        }
        let farthest = (0..postures.len()).max_by(|a, b| nearest[*a].total_cmp(&nearest[*b]));
        chosen.extend(farthest);
    }
    chosen.sort_unstable();
    chosen
}

/// How far the link that moves most moves from one posture to another, metres.
fn apart(a: &[Transform<Base, Link>], b: &[Transform<Base, Link>]) -> f64 {
    let links = a.iter().zip(b).map(|(a, b)| {
        let (metres, radians) = a.distance_to(b);
        metres + METRES_A_RADIAN * radians
    });
    links.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{UnitQuaternion, Vector3};
    use proptest::prelude::*;

    fn at(x: f64) -> Vec<Transform<Base, Link>> {
        vec![Transform::from_parts(Vector3::new(x, 0.0, 0.0), UnitQuaternion::identity())]
    }

    #[test]
    fn the_ends_and_the_middle() {
        let postures: Vec<_> = [0.0, 0.1, 0.2, 0.51, 0.8, 0.9, 1.0].map(at).into();
        assert_eq!(most_spread(&postures, 3), [0, 3, 6]);
        assert_eq!(most_spread(&postures, 9), [0, 1, 2, 3, 4, 5, 6]);
    }

    proptest! {
        /// No other choice is more than twice as spread (the theorem of the article): whatever is
        /// left out is nearer to what is chosen than the chosen are to each other.
        #[test]
        fn what_is_left_out_is_near(
            xs in proptest::collection::vec(0.0..1.0_f64, 5..40), most in 2_usize..5,
        ) {
            let chosen = most_spread(&xs.iter().map(|x| at(*x)).collect::<Vec<_>>(), most);
            prop_assert_eq!(chosen.len(), most);
            let nearest = |i: usize, others: &[usize]| {
                others.iter().filter(|o| **o != i).map(|o| (xs[*o] - xs[i]).abs()).fold(9.0, f64::min)
            };
            let apart = chosen.iter().map(|i| nearest(*i, &chosen)).fold(9.0, f64::min);
            for i in 0..xs.len() {
                prop_assert!(chosen.contains(&i) || nearest(i, &chosen) <= apart + 1e-12);
            }
        }
    }
}
