//! A Gaussian belief, and what quadratic evidence does to it.

use nalgebra::{DMatrix, DVector};

/// Normally distributed, and so is what is learned of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Belief {
    /// Expected value.
    pub mean: DVector<f64>,
    /// Covariance about it.
    pub covariance: DMatrix<f64>,
}

/// Evidence about the same numbers: the logarithm of their likelihood is `vector^T x - x^T information x / 2`, but for
/// a number that is the same for all beliefs. The information may be singular: of what it does not see it says
/// nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Quadratic {
    /// Its curvature.
    pub information: DMatrix<f64>,
    /// Its slope at zero.
    pub vector: DVector<f64>,
}

impl Quadratic {
    /// Evidence that says nothing of so many numbers.
    pub fn nothing(count: usize) -> Self {
        Self { information: DMatrix::zeros(count, count), vector: DVector::zeros(count) }
    }

    /// Both together, of independent errors.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            information: &self.information + &other.information,
            vector: &self.vector + &other.vector,
        }
    }

    /// The same with variances so many times as large.
    #[must_use]
    pub fn inflated(&self, factor: f64) -> Self {
        Self { information: &self.information / factor, vector: &self.vector / factor }
    }
}

impl Belief {
    /// About zero, with these standard deviations.
    pub fn about_zero(deviations: &[f64]) -> Self {
        let variances = deviations.iter().map(|deviation| deviation * deviation);
        Self {
            mean: DVector::zeros(deviations.len()),
            covariance: DMatrix::from_diagonal(&DVector::from_iterator(
                deviations.len(),
                variances,
            )),
        }
    }

    /// What is believed after `evidence`; `None` if that is not finite.
    pub fn after(&self, evidence: &Quadratic) -> Option<Self> {
        let (covariance, _) = self.reduced(evidence)?;
        let left = &evidence.vector - &evidence.information * &self.mean;
        let mean = &self.mean + &covariance * left;
        mean.iter()
            .chain(covariance.iter())
            .all(|v| v.is_finite())
            .then_some(Self { mean, covariance })
    }

    /// Logarithm of how likely this belief made `evidence`, up to the number that is the same for all beliefs.
    ///
    /// Negative infinity where that is not finite.
    pub fn log_likelihood(&self, evidence: &Quadratic) -> f64 {
        let Some((covariance, log_determinant)) = self.reduced(evidence) else {
            return f64::NEG_INFINITY;
        };
        let Quadratic { information, vector } = evidence;
        let left = vector - information * &self.mean;
        let at_mean = vector.dot(&self.mean) - 0.5 * self.mean.dot(&(information * &self.mean));
        let all = at_mean - 0.5 * log_determinant + 0.5 * left.dot(&(covariance * &left));
        if all.is_finite() { all } else { f64::NEG_INFINITY }
    }

    /// How many nats `evidence` tells.
    pub fn gain(&self, evidence: &Quadratic) -> f64 {
        self.reduced(evidence).map_or(0.0, |(_, log_determinant)| 0.5 * log_determinant)
    }

    /// `(I + P A)^-1 P` and the logarithm of the determinant of `I + P A`.
    fn reduced(&self, evidence: &Quadratic) -> Option<(DMatrix<f64>, f64)> {
        let count = self.mean.len();
        let grown =
            DMatrix::<f64>::identity(count, count) + &self.covariance * &evidence.information;
        let decomposed = grown.lu();
        let log_determinant = decomposed.determinant().ln();
        let covariance = decomposed.solve(&self.covariance)?;
        let covariance = (&covariance + covariance.transpose()) * 0.5;
        log_determinant.is_finite().then_some((covariance, log_determinant))
    }
}

/// Logarithm of the sum of what `a` and `b` are logarithms of.
pub(super) fn log_sum(a: f64, b: f64) -> f64 {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    if high == f64::NEG_INFINITY { high } else { high + (low - high).exp().ln_1p() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Measured along one axis, against the integral by the trapezoidal rule.
    #[test]
    fn the_likelihood_is_the_integral() {
        for (mean, deviation, information, vector) in
            [(0.3, 0.5, 7.0, -1.0), (-0.2, 2.0, 0.0, 0.0), (1.0, 0.1, 30.0, 20.0)]
        {
            let belief = Belief {
                mean: DVector::from_element(1, mean),
                covariance: DMatrix::from_element(1, 1, deviation * deviation),
            };
            let evidence = Quadratic {
                information: DMatrix::from_element(1, 1, information),
                vector: DVector::from_element(1, vector),
            };
            let (steps, reach) = (20_000, 12.0 * deviation);
            let width = 2.0 * reach / f64::from(steps);
            let density = |step: i32| {
                let x = mean - reach + width * f64::from(step);
                let prior = (-0.5 * ((x - mean) / deviation).powi(2)).exp()
                    / (deviation * std::f64::consts::TAU.sqrt());
                prior * (vector * x - 0.5 * information * x * x).exp()
            };
            let integral: f64 = (0..steps).map(|step| width * density(step)).sum();
            assert!((belief.log_likelihood(&evidence) - integral.ln()).abs() < 1e-6);
        }
    }

    #[test]
    fn two_pieces_of_evidence_say_the_same_in_any_order_and_together() {
        let belief = Belief::about_zero(&[0.5, 2.0]);
        let one = Quadratic {
            information: DMatrix::from_row_slice(2, 2, &[3.0, 1.0, 1.0, 2.0]),
            vector: DVector::from_row_slice(&[0.4, -1.0]),
        };
        let other = Quadratic {
            information: DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]),
            vector: DVector::from_row_slice(&[2.0, -2.0]),
        };
        let chain = |first: &Quadratic, then: &Quadratic| {
            let after = belief.after(first).unwrap();
            belief.log_likelihood(first) + after.log_likelihood(then)
        };
        let together = belief.log_likelihood(&one.plus(&other));
        assert!((chain(&one, &other) - together).abs() < 1e-12);
        assert!((chain(&other, &one) - together).abs() < 1e-12);
        assert!(belief.gain(&Quadratic::nothing(2)).abs() < 1e-12);
    }

    #[test]
    fn sums_of_logarithms() {
        assert!((log_sum(2f64.ln(), 3f64.ln()) - 5f64.ln()).abs() < 1e-12);
        assert_eq!(log_sum(f64::NEG_INFINITY, 1.0), 1.0);
        assert_eq!(log_sum(f64::NEG_INFINITY, f64::NEG_INFINITY), f64::NEG_INFINITY);
    }
}
