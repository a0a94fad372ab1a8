//! How far off a base is likely to be, by what speaks for each place along the first joint's axis.

use super::elsewhere::Elsewhere;
use nalgebra::{Matrix3, Vector3};

/// How likely a base is to be elsewhere before anything is seen of it: plates below it, another variant's height, a
/// description that somebody measured.
const ELSEWHERE: f64 = 0.25;
/// By as much: bases of described arms are millimetres off now and then, and hardly ever far. Standard deviation of
/// Student's density of three degrees of freedom.
const USUAL_M: f64 = 0.01;

/// The mean square of the shifts of `along`, which are in the order of their place on `axis`. A base is where it is described
/// to be, or, [`ELSEWHERE`], anywhere along the axis.
pub(super) fn mean_square(along: &[Elsewhere], axis: &Vector3<f64>, birge: f64) -> Matrix3<f64> {
    let at: Vec<f64> = along.iter().map(|place| axis.dot(&place.shift_m)).collect();
    let prior: Vec<f64> =
        at.iter().zip(widths(&at)).map(|(at, width)| width * density(*at)).collect();
    let all: f64 = prior.iter().sum();
    if all <= 0.0 {
        return Matrix3::zeros();
    }
    let evidence = |place: &Elsewhere| {
        // What is out of the question is, however the kinds of evidence disagree.
        let out = place.nearer == f64::NEG_INFINITY;
        let nearer = if out { place.nearer } else { place.nearer / birge.max(1.0) };
        place.seen_through + place.more + nearer
    };
    // The place described has none; large numbers would overflow.
    let most = along.iter().map(evidence).fold(0.0, f64::max);
    let mut total = (1.0 - ELSEWHERE) * (-most).exp();
    let mut square = 0.0;
    for ((place, at), prior) in along.iter().zip(&at).zip(prior) {
        let weight = ELSEWHERE * prior / all * (evidence(place) - most).exp();
        total += weight;
        square += weight * at * at;
    }
    square / total * axis * axis.transpose()
}

/// Not normalised.
fn density(at_m: f64) -> f64 {
    (1.0 + (at_m / USUAL_M).powi(2)).powi(-2)
}

/// How much of the axis each of the places stands for, metres.
fn widths(at: &[f64]) -> impl Iterator<Item = f64> {
    (0..at.len()).map(|place| {
        let before = at[place.saturating_sub(1)];
        let after = at[(place + 1).min(at.len() - 1)];
        0.5 * (after - before)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places every millimetre, for the one at `best_m` of which so much speaks.
    fn sigma_m(best_m: f64, evidence: f64) -> f64 {
        let places: Vec<Elsewhere> = (-120..=120)
            .map(|step| {
                let metres = 1e-3 * f64::from(step);
                let near = (metres - best_m).abs() < 2e-3;
                let seen_through = if near { evidence } else { 0.0 };
                // What a place is off across the axis is the answer's own error.
                let shift_m = Vector3::new(0.01, 0.0, metres);
                Elsewhere { shift_m, seen_through, ..Elsewhere::default() }
            })
            .collect();
        let square = mean_square(&places, &Vector3::z(), 1.0);
        assert!(square.m11 == 0.0 && square.m22 == 0.0);
        square.m33.sqrt()
    }

    #[test]
    fn where_nothing_speaks_it_is_as_before() {
        // Of the density the standard deviation is its width, but for the tails that are cut.
        let expected = (ELSEWHERE * USUAL_M * USUAL_M).sqrt();
        assert!((0.88..1.0).contains(&(sigma_m(0.0, 0.0) / expected)));
    }

    #[test]
    fn what_is_sure_is_as_far_as_it_is() {
        for metres in [-0.05, 0.02, 0.1] {
            let sigma = sigma_m(metres, 40.0);
            assert!((sigma - metres.abs()).abs() < 1e-3, "{metres}: {sigma}");
        }
        // Large numbers are none too large.
        assert!((sigma_m(0.05, 4000.0) - 0.05).abs() < 1e-3);
        assert!(sigma_m(0.05, -4000.0) < 0.005);
    }

    #[test]
    fn a_place_that_is_out_of_the_question_has_no_part_in_it() {
        let near = Elsewhere { shift_m: 0.01 * Vector3::z(), ..Elsewhere::default() };
        let shift_m = 0.1 * Vector3::z();
        let out = Elsewhere { shift_m, nearer: f64::NEG_INFINITY, seen_through: 40.0, more: 0.0 };
        for birge in [0.5, 3.0, f64::INFINITY] {
            let places = [Elsewhere::default(), near, out];
            let sigma = mean_square(&places, &Vector3::z(), birge).m33.sqrt();
            assert!(sigma > 0.0 && sigma < 0.01, "{birge}: {sigma}");
        }
    }

    #[test]
    fn more_evidence_makes_it_likelier() {
        let all: Vec<f64> = (0..12).map(|evidence| sigma_m(-0.05, f64::from(evidence))).collect();
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{all:?}");
    }
}
