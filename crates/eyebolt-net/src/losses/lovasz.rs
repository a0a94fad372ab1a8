//! The Lovasz-softmax loss: a convex surrogate of the mean intersection over union (Berman, Triki and
//! Blaschko, *The Lovasz-softmax loss*, CVPR 2018, algorithm 1 and equation 11).

use super::classes::check_labels;
use super::loss::Loss;
use crate::{Error, Matrix};

/// Mean over the classes that are present of the Lovasz extension of the Jaccard loss, of softmax
/// probabilities. Rows labelled `ignore` do not count; if no row does, loss and gradient are zero.
///
/// It falls with the share of a class that is wrong, however small the class is. Rows are sorted by error
/// once for every class: give it what one step can sort.
///
/// # Errors
/// If there is not one label for every row, a label is not below the number of classes, or a logit is not
/// finite.
pub fn lovasz_softmax(logits: &Matrix, labels: &[u32], ignore: u32) -> Result<Loss, Error> {
    check_labels(logits, labels, ignore)?;
    let classes = logits.channels();
    let rows: Vec<usize> = (0..labels.len()).filter(|&row| labels[row] != ignore).collect();
    let probabilities = softmax(logits);
    let present: Vec<usize> = (0..classes)
        .filter(|&class| rows.iter().any(|&row| labels[row] as usize == class))
        .collect();
    // With respect to the probabilities first.
    let mut slope = vec![0.0_f32; labels.len() * classes];
    let mut value = 0.0;
    let share = 1.0 / present.len().max(1) as f64;
    for &class in &present {
        let is_class = |row: usize| labels[row] as usize == class;
        let error = |row: usize| {
            let probability = probabilities[row * classes + class];
            if is_class(row) { 1.0 - probability } else { probability }
        };
        let mut order: Vec<(f32, u32)> = rows.iter().map(|&row| (error(row), row as u32)).collect();
        // Ties by row, so that the same bytes come out everywhere.
        order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let total = rows.iter().filter(|&&row| is_class(row)).count() as f64;
        let (mut hits, mut others, mut before) = (0.0, 0.0, 0.0);
        for (error, row) in order {
            let row = row as usize;
            if is_class(row) {
                hits += 1.0;
            } else {
                others += 1.0;
            }
            let jaccard = 1.0 - (total - hits) / (total + others);
            let weight = share * (jaccard - before);
            before = jaccard;
            value += weight * f64::from(error);
            let sign = if is_class(row) { -1.0 } else { 1.0 };
            slope[row * classes + class] = (sign * weight) as f32;
        }
    }
    let gradient = through_softmax(&probabilities, &slope, classes);
    Ok(Loss { value, gradient: Matrix::new(labels.len(), classes, gradient)? })
}

fn softmax(logits: &Matrix) -> Vec<f32> {
    let classes = logits.channels();
    let mut probabilities = logits.values().to_vec();
    for row in probabilities.chunks_exact_mut(classes.max(1)) {
        let largest = row.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        row.iter_mut().for_each(|value| *value = (*value - largest).exp());
        let sum: f32 = row.iter().sum();
        row.iter_mut().for_each(|value| *value /= sum);
    }
    probabilities
}

/// Gradient with respect to logits from that with respect to probabilities.
fn through_softmax(probabilities: &[f32], slope: &[f32], classes: usize) -> Vec<f32> {
    let mut gradient = vec![0.0; slope.len()];
    let rows = gradient.chunks_exact_mut(classes.max(1));
    let given = probabilities.chunks_exact(classes.max(1)).zip(slope.chunks_exact(classes.max(1)));
    for (out, (probabilities, slope)) in rows.zip(given) {
        let mean: f32 = probabilities.iter().zip(slope).map(|(p, s)| p * s).sum();
        for (out, (p, s)) in out.iter_mut().zip(probabilities.iter().zip(slope)) {
            *out = p * (s - mean);
        }
    }
    gradient
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn logits(rows: usize, values: Vec<f32>) -> Matrix {
        Matrix::new(rows, values.len() / rows, values).unwrap()
    }

    /// With certain predictions it is the mean over classes of one minus intersection over union.
    #[test]
    fn is_the_jaccard_loss_of_certain_predictions() {
        let found = [0, 0, 1, 1, 1, 2];
        let labels = [0, 1, 1, 1, 1, 1];
        let rows = found.iter().flat_map(|&c| (0..3).map(move |k| if k == c { 40.0 } else { 0.0 }));
        let loss = lovasz_softmax(&logits(6, rows.collect()), &labels, 255).unwrap();
        // Class 0: 1 of 2. Class 1: 3 of 5. Class 2 is not present.
        assert!((loss.value - 0.5 * (0.5 + 0.4)).abs() < 1e-6, "{}", loss.value);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn gradient_is_the_slope(
            values in prop::collection::vec(-2.0_f32..2.0, 15),
            labels in prop::collection::vec(prop::sample::select(vec![0, 1, 2, 255]), 5),
        ) {
            let at = |values: &[f32]| lovasz_softmax(&logits(5, values.to_vec()), &labels, 255).unwrap();
            let loss = at(&values);
            for place in 0..15 {
                let step = 1e-3;
                let moved = |by: f32| {
                    let mut values = values.clone();
                    values[place] += by;
                    at(&values).value
                };
                let slope = (moved(step) - moved(-step)) / (2.0 * f64::from(step));
                let found = f64::from(loss.gradient.values()[place]);
                // Where two errors change places within the step, the slope has a kink.
                let (left, right) = (moved(-step), moved(step));
                let kink = (left + right - 2.0 * loss.value).abs() / f64::from(step);
                prop_assert!((slope - found).abs() < 2e-3 + kink, "{slope} {found}");
            }
            for (row, &label) in labels.iter().enumerate() {
                let sum: f32 = loss.gradient.row(row).iter().sum();
                prop_assert!(sum.abs() < 1e-5);
                prop_assert!(label != 255 || loss.gradient.row(row).iter().all(|g| *g == 0.0));
            }
        }
    }
}
