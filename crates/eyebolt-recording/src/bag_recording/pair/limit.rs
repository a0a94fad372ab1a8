//! How far joints may move while a frame is taken.

use crate::bag_recording::track::STILL;

/// The limit of motion, radians or metres, lies between half a millimetre and five at the end of an
/// arm: as far as encoders at rest make of it, and as much as still calibrates to millimetres.
pub(super) const SMALLEST_LIMIT: f64 = STILL;
pub(super) const LARGEST_LIMIT: f64 = 5e-3;
/// Above what the stillest quarter of the frames has by so many times, an arm moves.
const ABOVE_STILL: f64 = 5.0;

/// The motion above which a frame is of a moving arm.
pub(super) fn limit_of(mut motions: Vec<f64>) -> f64 {
    let quarter = motions.len() / 4;
    if motions.is_empty() {
        return SMALLEST_LIMIT;
    }
    let still = *motions.select_nth_unstable_by(quarter, f64::total_cmp).1;
    (ABOVE_STILL * still).clamp(SMALLEST_LIMIT, LARGEST_LIMIT)
}
