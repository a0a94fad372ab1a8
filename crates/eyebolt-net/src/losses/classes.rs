//! Losses of logits by the classes they should tell.

use super::loss::Loss;
use crate::{Error, Matrix};

/// Cross-entropy of softmax probabilities, mean over rows weighted by the weight of each row's
/// class. Rows labelled `ignore` do not count; if no row does, loss and gradient are zero.
///
/// # Errors
/// If there is not one label for every row, one weight (not negative) for every class, a label
/// below the number of classes; or a logit is not finite.
pub fn cross_entropy(
    logits: &Matrix,
    labels: &[u32],
    ignore: u32,
    class_weights: Option<&[f32]>,
) -> Result<Loss, Error> {
    let classes = logits.channels();
    check_labels(logits, labels, ignore)?;
    if let Some(weights) = class_weights {
        let good = |weight: &f32| weight.is_finite() && *weight >= 0.0;
        if weights.len() != classes || !weights.iter().all(good) {
            let problem = format!("{weights:?} are not weights of {classes} classes");
            return Err(Error::input("class_weights", problem));
        }
    }
    let weight_of = |label: u32| match (label == ignore, class_weights) {
        (true, _) => 0.0,
        (false, Some(weights)) => f64::from(weights[label as usize]),
        (false, None) => 1.0,
    };
    let total: f64 = labels.iter().map(|&label| weight_of(label)).sum();
    let mut gradient = Matrix::zeros(logits.rows(), classes);
    let mut sum = 0.0;
    for (row, &label) in labels.iter().enumerate() {
        let weight = weight_of(label);
        if weight == 0.0 {
            continue;
        }
        let logits = logits.row(row);
        let largest = logits.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let below = |logit: f32| f64::from(logit) - f64::from(largest);
        let exponentials: Vec<f64> = logits.iter().map(|&logit| below(logit).exp()).collect();
        let normaliser: f64 = exponentials.iter().sum();
        sum -= weight * (below(logits[label as usize]) - normaliser.ln());
        let out = &mut gradient.values_mut()[row * classes..][..classes];
        for (class, (out, exponential)) in out.iter_mut().zip(exponentials).enumerate() {
            let target = f64::from(u8::from(class == label as usize));
            *out = (weight / total * (exponential / normaliser - target)) as f32;
        }
    }
    let value = if total > 0.0 { sum / total } else { 0.0 };
    Ok(Loss { value, gradient })
}

/// Cross-entropy of softmax probabilities against distributions: of each row, how much of the truth is in
/// each class. Mean over rows.
///
/// # Errors
/// If shapes differ, there is no row, a row of `targets` has a negative value or does not sum to 1 within a
/// thousandth, or a logit is not finite.
pub fn soft_cross_entropy(logits: &Matrix, targets: &Matrix) -> Result<Loss, Error> {
    let (rows, classes) = (logits.rows(), logits.channels());
    if rows == 0 || (rows, classes) != (targets.rows(), targets.channels()) {
        return Err(Error::input("targets", format!("not {rows} rows of {classes}")));
    }
    logits.check_finite("logits")?;
    let mut gradient = Matrix::zeros(rows, classes);
    let mut value = 0.0;
    for row in 0..rows {
        let (logits, target) = (logits.row(row), targets.row(row));
        let sum: f32 = target.iter().sum();
        if !target.iter().all(|share| *share >= 0.0) || (sum - 1.0).abs() > 1e-3 {
            return Err(Error::input("targets", format!("row {row} is no distribution")));
        }
        let largest = logits.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let normaliser: f64 = logits.iter().map(|x| f64::from(x - largest).exp()).sum();
        let out = &mut gradient.values_mut()[row * classes..][..classes];
        for ((out, logit), share) in out.iter_mut().zip(logits).zip(target) {
            let below = f64::from(logit - largest);
            value -= f64::from(*share) * (below - normaliser.ln());
            *out = ((below.exp() / normaliser - f64::from(*share)) / rows as f64) as f32;
        }
    }
    Ok(Loss { value: value / rows as f64, gradient })
}

pub(super) fn check_labels(logits: &Matrix, labels: &[u32], ignore: u32) -> Result<(), Error> {
    if labels.len() != logits.rows() {
        let problem = format!("{} for {} rows of logits", labels.len(), logits.rows());
        return Err(Error::input("labels", problem));
    }
    let classes = logits.channels();
    let wrong = |&label: &u32| label != ignore && label as usize >= classes;
    if let Some(row) = labels.iter().position(wrong) {
        let problem = format!("row {row} is of class {} of {classes}", labels[row]);
        return Err(Error::input("labels", problem));
    }
    logits.check_finite("logits")
}
