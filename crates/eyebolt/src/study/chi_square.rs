//! The chi-square distribution with any number of degrees of freedom.

/// What a chi-square variable with `freedom` degrees of freedom (any number above 0) stays below with
/// `probability`, which lies between 0 and 1.
pub(super) fn quantile(freedom: f64, probability: f64) -> f64 {
    let below = |x: f64| lower_gamma(0.5 * freedom, 0.5 * x) < probability;
    let mut low = 0.0;
    let mut high = freedom.max(1.0);
    while below(high) && high < 1e6 {
        low = high;
        high *= 2.0;
    }
    // Halved as often as there are bits in a float.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if below(middle) { low = middle } else { high = middle }
    }
    high
}

/// The regularised lower incomplete gamma function, by its series (Abramowitz and Stegun, 6.5.29).
fn lower_gamma(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let mut term = (a * x.ln() - x - ln_gamma(a + 1.0)).exp();
    let mut sum = term;
    let mut n = a;
    while term > 1e-17 * sum || n < x {
        n += 1.0;
        term *= x / n;
        sum += term;
        if term == 0.0 {
            break;
        }
    }
    sum.min(1.0)
}

/// The logarithm of the gamma function for `x >= 1`: Stirling's series (6.1.40), from where it is exact.
fn ln_gamma(x: f64) -> f64 {
    let (mut at, mut product) = (x, 1.0_f64);
    while at < 10.0 {
        product *= at;
        at += 1.0;
    }
    let inverse = 1.0 / at;
    let square = inverse * inverse;
    let series =
        inverse * (1.0 / 12.0 - square * (1.0 / 360.0 - square * (1.0 / 1260.0 - square / 1680.0)));
    (at - 0.5) * at.ln() - at + 0.5 * std::f64::consts::TAU.ln() + series - product.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of any printed table: degrees of freedom, probability, quantile.
    const TABLE: [(f64, f64, f64); 8] = [
        (1.0, 0.50, 0.454_936),
        (1.0, 0.95, 3.841_459),
        (2.0, 0.90, 4.605_170),
        (3.0, 0.50, 2.365_974),
        (3.0, 0.90, 6.251_389),
        (3.0, 0.95, 7.814_728),
        (10.0, 0.95, 18.307_038),
        (100.0, 0.90, 118.498_004),
    ];

    #[test]
    fn the_printed_table() {
        for (freedom, probability, expected) in TABLE {
            let found = quantile(freedom, probability);
            assert!((found - expected).abs() < 1e-5 * expected, "{freedom} {probability}: {found}");
        }
    }

    #[test]
    fn logarithms_of_factorials() {
        for (x, factorial) in [(1.0, 1.0_f64), (2.0, 1.0), (5.0, 24.0), (8.0, 5040.0)] {
            assert!((ln_gamma(x) - factorial.ln()).abs() < 1e-11, "{x}");
        }
        assert!((ln_gamma(1.5) - (std::f64::consts::PI.sqrt() / 2.0).ln()).abs() < 1e-11);
    }
}
