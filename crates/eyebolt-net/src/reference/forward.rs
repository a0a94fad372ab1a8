//! Values.

use super::Real;
use super::ops::{for_each_pair, inverse_deviation, largest, moments};
use crate::executor::dropout_keeps;
use crate::graph::{BatchNorm, Graph, Op, ParameterId};
use crate::{Batch, Error, Matrix};

type Running<T> = Vec<(ParameterId, Vec<T>)>;

/// Values of all nodes, and new running statistics; in training if there is a seed.
pub fn forward<T: Real>(
    graph: &Graph,
    parameters: &[Vec<T>],
    batch: &Batch,
    inputs: &[Matrix<T>],
    seed: Option<u64>,
) -> Result<(Vec<Matrix<T>>, Running<T>), Error> {
    let mut values: Vec<Matrix<T>> = Vec::new();
    let mut running = Vec::new();
    let mut inputs = inputs.iter();
    for (index, node) in graph.nodes().iter().enumerate() {
        let rows = batch.rows[node.domain];
        let input = |place: usize| &values[node.inputs[place].0];
        let mut out = Matrix::zeros(rows, node.channels);
        match &node.op {
            Op::Input(_) => {
                let missing = || Error::input("batch", "made for another network");
                out = inputs.next().ok_or_else(missing)?.clone();
            }
            Op::Convolution { map, weight, bias } => {
                let map = map.map(|map| batch.kernel(map)).transpose()?;
                let weight = &parameters[weight.0];
                for_each_pair(map, rows, |offset, from, to| {
                    let row = input(0).row(from);
                    let width = node.channels;
                    let first = offset * row.len() * width;
                    for (k, &value) in row.iter().enumerate() {
                        for c in 0..width {
                            out.values_mut()[to * width + c] +=
                                value * weight[first + k * width + c];
                        }
                    }
                });
                if let Some(bias) = bias {
                    each(&mut out, |channel, value| value + parameters[bias.0][channel]);
                }
            }
            Op::BatchNorm(norm) => {
                out = input(0).clone();
                batch_norm(&mut out, norm, parameters, seed.is_some(), &mut running);
            }
            Op::Activation { slope } => {
                out = input(0).clone();
                each(&mut out, |_, x| if x > T::default() { x } else { x * T::from_f32(*slope) });
            }
            Op::Add => {
                out = input(0).clone();
                for (sum, &other) in out.values_mut().iter_mut().zip(input(1).values()) {
                    *sum += other;
                }
            }
            Op::Concatenate => {
                let row = |row| (0..node.inputs.len()).flat_map(move |part| input(part).row(row));
                let joined = (0..rows).flat_map(row).copied().collect();
                out = Matrix::new(rows, node.channels, joined)?;
            }
            Op::Dropout { probability } => {
                out = input(0).clone();
                if let Some(seed) = seed {
                    dropout(&mut out, seed, index, *probability);
                }
            }
            Op::Combine { map } => {
                let map = batch.row_map(*map)?;
                for to in 0..rows {
                    for (from, weight) in map.entries(to) {
                        for c in 0..node.channels {
                            out.values_mut()[to * node.channels + c] +=
                                input(0).row(from)[c] * T::from_f32(weight);
                        }
                    }
                }
            }
            Op::MaxPool { map } => {
                for (to, run) in batch.runs(*map)?.iter().enumerate() {
                    for c in 0..node.channels {
                        let from = largest(input(0), run.clone(), c);
                        out.values_mut()[to * node.channels + c] = input(0).row(from)[c];
                    }
                }
            }
        }
        values.push(out);
    }
    Ok((values, running))
}

fn each<T: Real>(out: &mut Matrix<T>, function: impl Fn(usize, T) -> T) {
    let channels = out.channels();
    for (at, value) in out.values_mut().iter_mut().enumerate() {
        *value = function(at % channels, *value);
    }
}

/// Zeros what is dropped, scales what is not.
pub fn dropout<T: Real>(out: &mut Matrix<T>, seed: u64, node: usize, probability: f32) {
    let scale = T::from_f32(1.0 / (1.0 - probability));
    for (at, value) in out.values_mut().iter_mut().enumerate() {
        let keeps = dropout_keeps(seed, node, at, probability);
        *value = if keeps { *value * scale } else { T::default() };
    }
}

fn batch_norm<T: Real>(
    out: &mut Matrix<T>,
    norm: &BatchNorm,
    parameters: &[Vec<T>],
    training: bool,
    running: &mut Running<T>,
) {
    let (old_mean, old_variance) = (&parameters[norm.mean.0], &parameters[norm.variance.0]);
    let (mut mean, mut variance) = (old_mean.clone(), old_variance.clone());
    if training {
        (mean, variance) = moments(out);
        let blend = |old: &[T], new: &[T], correction: f32| {
            let share = T::from_f32(norm.momentum);
            let rest = T::from_f32(1.0) - share;
            let correction = T::from_f32(correction);
            old.iter().zip(new).map(|(&o, &n)| o * rest + n * correction * share).collect()
        };
        // The running variance is the unbiased one, except of a single row, which has none.
        let count = out.rows() as f32;
        let unbiased = if out.rows() > 1 { count / (count - 1.0) } else { 1.0 };
        running.push((norm.mean, blend(old_mean, &mean, 1.0)));
        running.push((norm.variance, blend(old_variance, &variance, unbiased)));
    }
    let inverse = inverse_deviation(&variance, norm.epsilon);
    let (scale, shift) = (&parameters[norm.scale.0], &parameters[norm.shift.0]);
    each(out, |c, value| (value - mean[c]) * inverse[c] * scale[c] + shift[c]);
}
