//! Robust weights.

/// Geman and McClure's weight for residual `r` at scale `scale`: 1 at 0, 1/4 at the scale, falling
/// with the fourth power, so what is far off soon has no say.
pub(crate) fn geman_mcclure(r: f64, scale: f64) -> f64 {
    let ratio = r / scale;
    let root = 1.0 / (1.0 + ratio * ratio);
    root * root
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
