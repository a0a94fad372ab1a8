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

/// Largest and least logarithm of a scale: beyond, nothing more is told.
const LOG_SCALES: [f32; 2] = [-6.0, 4.0];

/// Negative log likelihood of groups of numbers under Laplace distributions, mean over groups: a row of
/// `prediction` has for each group its `width` values, then the logarithm of their common scale, a row of
/// `target` its values. Where the network cannot know, it learns to say so (Kendall and Gal, NeurIPS 2017).
/// Groups whose target is NaN do not count.
///
/// # Errors
/// If shapes do not fit, or a prediction is not finite.
pub fn laplace(prediction: &Matrix, target: &Matrix, width: usize) -> Result<Loss, Error> {
    let groups = target.channels() / width.max(1);
    let fits = width > 0
        && target.channels() == groups * width
        && prediction.channels() == groups * (width + 1)
        && prediction.rows() == target.rows();
    if !fits {
        let problem = format!("{} values for {}", prediction.channels(), target.channels());
        return Err(Error::input("prediction", format!("{problem} in groups of {width}")));
    }
    prediction.check_finite("prediction")?;
    let known = |group: &[f32]| group.iter().all(|value| value.is_finite());
    let count = target.values().chunks_exact(width).filter(|group| known(group)).count();
    let share = 1.0 / count.max(1) as f64;
    let mut gradient = Matrix::zeros(prediction.rows(), prediction.channels());
    let mut sum = 0.0;
    let found = prediction.values().chunks_exact(width + 1);
    let slopes = gradient.values_mut().chunks_exact_mut(width + 1);
    let groups = found.zip(slopes).zip(target.values().chunks_exact(width));
    for ((found, slope), wanted) in groups.filter(|(_, wanted)| known(wanted)) {
        let log_scale = found[width].clamp(LOG_SCALES[0], LOG_SCALES[1]);
        let per = f64::from(-log_scale).exp();
        let mut off = 0.0;
        for axis in 0..width {
            let difference = f64::from(found[axis]) - f64::from(wanted[axis]);
            off += difference.abs();
            slope[axis] = (share * per * difference.signum()) as f32;
        }
        sum += share * (off * per + width as f64 * f64::from(log_scale));
        let inside = log_scale == found[width];
        slope[width] = if inside { (share * (width as f64 - off * per)) as f32 } else { 0.0 };
    }
    Ok(Loss { value: sum, gradient })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gradients_of_laplace_are_slopes() {
        let target =
            Matrix::new(2, 4, vec![0.1, -0.4, 0.9, 0.3, f32::NAN, 0.0, 1.2, -0.7]).unwrap();
        let values = vec![0.3, -0.9, -0.5, 0.2, 0.1, 0.4, 0.3, 0.3, 0.0, -1.1, 0.4, 0.8];
        let at = |values: &[f32]| {
            laplace(&Matrix::new(2, 6, values.to_vec()).unwrap(), &target, 2).unwrap()
        };
        let loss = at(&values);
        for place in 0..12 {
            let moved = |by: f32| {
                let mut values = values.clone();
                values[place] += by;
                at(&values).value
            };
            let slope = (moved(1e-3) - moved(-1e-3)) / 2e-3;
            let found = f64::from(loss.gradient.values()[place]);
            assert!((slope - found).abs() < 1e-3, "{place}: {slope} {found}");
        }
        // The group without a target says nothing.
        assert!(loss.gradient.row(1)[..3].iter().all(|slope| *slope == 0.0));
    }
}
