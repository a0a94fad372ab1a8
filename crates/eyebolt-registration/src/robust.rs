//! Robust weights.

/// Geman and McClure's weight for residual `r` at scale `scale`: 1 at 0, 1/4 at the scale, falling
/// with the fourth power, so what is far off soon has no say.
pub fn geman_mcclure(r: f64, scale: f64) -> f64 {
    let ratio = r / scale;
    let root = 1.0 / (1.0 + ratio * ratio);
    root * root
}

/// Second derivative of Geman and McClure's loss by `r`, 1 at 0; negative beyond `scale / sqrt(3)`.
pub(crate) fn geman_mcclure_curvature(r: f64, scale: f64) -> f64 {
    let square = (r / scale).powi(2);
    (1.0 - 3.0 * square) / (1.0 + square).powi(3)
}

/// Median of `values`, reordered on the way; `None` if there are none.
///
/// Of an even number, the larger of the middle two.
pub fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    if values.is_empty() {
        return None;
    }
    Some(*values.select_nth_unstable_by(middle, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The slope of the loss is the residual times its weight; the curvature is the slope of that.
        #[test]
        fn the_curvature_is_the_derivative_of_the_slope(r in -5.0..5.0_f64, scale in 0.5..3.0_f64) {
            let slope = |r: f64| r * geman_mcclure(r, scale);
            let h = 1e-5;
            let numeric = (slope(r + h) - slope(r - h)) / (2.0 * h);
            prop_assert!((numeric - geman_mcclure_curvature(r, scale)).abs() < 1e-8);
        }
    }
}
