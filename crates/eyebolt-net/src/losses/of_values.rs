//! Losses of numbers by how far they are off.

use super::loss::Loss;
use crate::{Error, Matrix};

/// Mean over all values of `d^2 / (2 beta)` where the difference `d` is below `beta`, else of
/// `|d| - beta / 2` (Girshick, *Fast R-CNN*, ICCV 2015).
///
/// # Errors
/// If shapes differ, `beta` is not positive, or a value is not finite.
pub fn smooth_l1(prediction: &Matrix, target: &Matrix, beta: f32) -> Result<Loss, Error> {
    let shape = (prediction.rows(), prediction.channels());
    if shape != (target.rows(), target.channels()) {
        return Err(Error::input("target", format!("not {} rows of {}", shape.0, shape.1)));
    }
    if !(beta.is_finite() && beta > 0.0) {
        return Err(Error::input("beta", format!("{beta} is not positive")));
    }
    prediction.check_finite("prediction")?;
    target.check_finite("target")?;
    let count = prediction.values().len().max(1) as f64;
    let beta = f64::from(beta);
    let mut gradient = Matrix::zeros(shape.0, shape.1);
    let mut sum = 0.0;
    let pairs = prediction.values().iter().zip(target.values());
    for (out, (&found, &wanted)) in gradient.values_mut().iter_mut().zip(pairs) {
        let difference = f64::from(found) - f64::from(wanted);
        let near = difference.abs() < beta;
        sum += if near {
            difference * difference / (2.0 * beta)
        } else {
            difference.abs() - beta / 2.0
        };
        let slope = if near { difference / beta } else { difference.signum() };
        *out = (slope / count) as f32;
    }
    Ok(Loss { value: sum / count, gradient })
}
