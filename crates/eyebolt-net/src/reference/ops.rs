//! Loops that both directions use.

use super::Real;
use crate::Matrix;
use crate::coordinates::KernelMap;

/// Offset, input row and output row of every pair; without a map each row with itself.
pub fn for_each_pair(
    map: Option<&KernelMap>,
    rows: usize,
    mut visit: impl FnMut(usize, usize, usize),
) {
    let Some(map) = map else {
        return (0..rows).for_each(|row| visit(0, row, row));
    };
    for offset in 0..map.volume() {
        map.pairs_at(offset).for_each(|(input, output)| visit(offset, input, output));
    }
}

/// Mean and biased variance of every channel.
pub fn moments<T: Real>(value: &Matrix<T>) -> (Vec<T>, Vec<T>) {
    let count = T::from_f32(value.rows() as f32);
    let mean: Vec<T> = (0..value.channels())
        .map(|channel| {
            let mut sum = T::default();
            (0..value.rows()).for_each(|row| sum += value.row(row)[channel]);
            sum / count
        })
        .collect();
    let variance = (0..value.channels())
        .map(|channel| {
            let mut sum = T::default();
            for row in 0..value.rows() {
                let difference = value.row(row)[channel] - mean[channel];
                sum += difference * difference;
            }
            sum / count
        })
        .collect();
    (mean, variance)
}

/// `1 / sqrt(variance + epsilon)`.
pub fn inverse_deviation<T: Real>(variance: &[T], epsilon: f32) -> Vec<T> {
    let one = T::from_f32(1.0);
    variance.iter().map(|&value| one / (value + T::from_f32(epsilon)).sqrt()).collect()
}

/// Row of the largest value of a run, the first of equals.
pub fn largest<T: Real>(value: &Matrix<T>, run: std::ops::Range<usize>, channel: usize) -> usize {
    let mut best = run.start;
    for row in run {
        if value.row(row)[channel] > value.row(best)[channel] {
            best = row;
        }
    }
    best
}
