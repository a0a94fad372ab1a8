//! Values.

use super::case::Case;
use super::ops::{for_each_pair, inverse_deviation, largest, moments};
use super::real::Real;
use crate::executor::dropout_keeps;
use crate::graph::{BatchNorm, Node, Op, ParameterId};
use crate::{Error, Matrix};

type Running<T> = Vec<(ParameterId, Vec<T>)>;

/// Values of all nodes, and new running statistics; in training if there is a seed.
pub fn forward<T: Real>(
    case: Case<'_, T>,
    seed: Option<u64>,
) -> Result<(Vec<Matrix<T>>, Running<T>), Error> {
    let mut values: Vec<Matrix<T>> = Vec::new();
    let mut running = Vec::new();
    let mut inputs = case.inputs.iter();
    for (index, node) in case.graph.nodes().iter().enumerate() {
        let input = |place: usize| &values[node.inputs[place].0];
        let value = match &node.op {
            Op::Input(_) => inputs.next().expect("the case was checked").clone(),
            Op::Convolution { .. } => convolution(case, node, input(0))?,
            Op::BatchNorm(norm) => {
                batch_norm(input(0), norm, case.parameters, seed.is_some(), &mut running)
            }
            Op::Activation { slope } => {
                each(input(0), |_, x| if x > T::default() { x } else { x * T::from_f32(*slope) })
            }
            Op::Add => each(input(0), |at, x| x + input(1).values()[at]),
            Op::Concatenate => {
                let parts = (0..node.inputs.len()).map(input).collect::<Vec<_>>();
                let row = |row| parts.iter().flat_map(move |part| part.row(row));
                let joined = (0..parts[0].rows()).flat_map(row).copied().collect();
                Matrix::new(parts[0].rows(), node.channels, joined)?
            }
            Op::Dropout { probability } => match seed {
                Some(seed) => dropout(input(0), seed, index, *probability),
                None => input(0).clone(),
            },
            Op::Combine { .. } | Op::MaxPool { .. } => rows(case, node, input(0))?,
        };
        values.push(value);
    }
    Ok((values, running))
}

/// A function of place and value, for every value.
fn each<T: Real>(input: &Matrix<T>, function: impl Fn(usize, T) -> T) -> Matrix<T> {
    let mut out = input.clone();
    for (at, value) in out.values_mut().iter_mut().enumerate() {
        *value = function(at, *value);
    }
    out
}

/// Zeros what is dropped, scales what is not; values and gradients alike.
pub fn dropout<T: Real>(input: &Matrix<T>, seed: u64, node: usize, probability: f32) -> Matrix<T> {
    let scale = T::from_f32(1.0 / (1.0 - probability));
    each(input, |at, value| match dropout_keeps(seed, node, at, probability) {
        true => value * scale,
        false => T::default(),
    })
}

fn convolution<T: Real>(
    case: Case<'_, T>,
    node: &Node,
    input: &Matrix<T>,
) -> Result<Matrix<T>, Error> {
    let (rows, width) = (case.batch.rows()[node.domain], node.channels);
    let mut out = Matrix::zeros(rows, width);
    let Op::Convolution { map, weight, bias } = node.op else { return Ok(out) };
    let map = map.map(|map| case.batch.kernel(map)).transpose()?;
    let weight = &case.parameters[weight.0];
    for_each_pair(map, rows, |offset, from, to| {
        let row = input.row(from);
        for (k, &value) in row.iter().enumerate() {
            let at = (offset * row.len() + k) * width;
            for c in 0..width {
                out.values_mut()[to * width + c] += value * weight[at + c];
            }
        }
    });
    let Some(bias) = bias else { return Ok(out) };
    Ok(each(&out, |at, value| value + case.parameters[bias.0][at % width]))
}

/// Sums or maxima of rows.
fn rows<T: Real>(case: Case<'_, T>, node: &Node, input: &Matrix<T>) -> Result<Matrix<T>, Error> {
    let width = node.channels;
    let mut out = Matrix::zeros(case.batch.rows()[node.domain], width);
    match node.op {
        Op::Combine { map } => {
            let map = case.batch.row_map(map)?;
            for to in 0..out.rows() {
                for (from, weight) in map.entries(to) {
                    for c in 0..width {
                        out.values_mut()[to * width + c] +=
                            input.row(from)[c] * T::from_f32(weight);
                    }
                }
            }
        }
        Op::MaxPool { map } => {
            for (to, run) in case.batch.runs(map)?.iter().enumerate() {
                for c in 0..width {
                    let from = largest(input, run.clone(), c);
                    out.values_mut()[to * width + c] = input.row(from)[c];
                }
            }
        }
        _ => {}
    }
    Ok(out)
}

fn batch_norm<T: Real>(
    input: &Matrix<T>,
    norm: &BatchNorm,
    parameters: &[Vec<T>],
    training: bool,
    running: &mut Running<T>,
) -> Matrix<T> {
    let (old_mean, old_variance) = (&parameters[norm.mean.0], &parameters[norm.variance.0]);
    let (mut mean, mut variance) = (old_mean.clone(), old_variance.clone());
    if training {
        (mean, variance) = moments(input);
        let blend = |old: &[T], new: &[T], correction: f32| {
            let share = T::from_f32(norm.momentum);
            let rest = T::from_f32(1.0) - share;
            let correction = T::from_f32(correction);
            old.iter().zip(new).map(|(&o, &n)| o * rest + n * correction * share).collect()
        };
        // The running variance is the unbiased one.
        let count = input.rows() as f32;
        running.push((norm.mean, blend(old_mean, &mean, 1.0)));
        running.push((norm.variance, blend(old_variance, &variance, count / (count - 1.0))));
    }
    let inverse = inverse_deviation(&variance, norm.epsilon);
    let (scale, shift) = (&parameters[norm.scale.0], &parameters[norm.shift.0]);
    each(input, |at, value| {
        let c = at % input.channels();
        (value - mean[c]) * inverse[c] * scale[c] + shift[c]
    })
}
