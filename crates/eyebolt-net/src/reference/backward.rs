//! Gradients, by the chain rule over the graph in reverse.

use super::forward::dropout;
use super::ops::{for_each_pair, inverse_deviation, largest, moments};
use super::{Pass, Real};
use crate::executor::Gradients;
use crate::graph::{BatchNorm, Graph, Op};
use crate::{Batch, Error, Matrix};

pub fn backward<T: Real>(
    graph: &Graph,
    parameters: &[Vec<T>],
    batch: &Batch,
    pass: &Pass<T>,
    output_gradients: &[Matrix<T>],
) -> Result<Gradients<T>, Error> {
    let mut of: Vec<Matrix<T>> =
        pass.values.iter().map(|value| Matrix::zeros(value.rows(), value.channels())).collect();
    let mut of_parameters: Vec<Vec<T>> =
        parameters.iter().map(|values| vec![T::default(); values.len()]).collect();
    for (output, gradient) in graph.outputs().iter().zip(output_gradients) {
        add(&mut of[output.0], gradient);
    }
    for (index, node) in graph.nodes().iter().enumerate().rev() {
        let gradient = of[index].clone();
        let rows = gradient.rows();
        let width = node.channels;
        let Some(&first) = node.inputs.first() else { continue };
        let input = &pass.values[first.0];
        match &node.op {
            Op::Input(_) => {}
            Op::Convolution { map, weight, bias } => {
                let map = map.map(|map| batch.kernel(map)).transpose()?;
                for_each_pair(map, rows, |offset, from, to| {
                    for (k, &value) in input.row(from).iter().enumerate() {
                        let at = (offset * input.channels() + k) * width;
                        for (c, &g) in gradient.row(to).iter().enumerate() {
                            of_parameters[weight.0][at + c] += value * g;
                            of[first.0].values_mut()[from * input.channels() + k] +=
                                parameters[weight.0][at + c] * g;
                        }
                    }
                });
                if let Some(bias) = bias {
                    for row in 0..rows {
                        for (sum, &g) in of_parameters[bias.0].iter_mut().zip(gradient.row(row)) {
                            *sum += g;
                        }
                    }
                }
            }
            Op::BatchNorm(norm) => {
                let back = batch_norm(norm, parameters, input, &gradient, &mut of_parameters);
                add(&mut of[first.0], &back);
            }
            Op::Activation { slope } => {
                for (at, &g) in gradient.values().iter().enumerate() {
                    let positive = input.values()[at] > T::default();
                    of[first.0].values_mut()[at] +=
                        if positive { g } else { g * T::from_f32(*slope) };
                }
            }
            Op::Add => node.inputs.iter().for_each(|part| add(&mut of[part.0], &gradient)),
            Op::Concatenate => {
                let mut start = 0;
                for part in &node.inputs {
                    let channels = of[part.0].channels();
                    for row in 0..rows {
                        for c in 0..channels {
                            of[part.0].values_mut()[row * channels + c] +=
                                gradient.row(row)[start + c];
                        }
                    }
                    start += channels;
                }
            }
            Op::Dropout { probability } => {
                let mut kept = gradient;
                dropout(&mut kept, pass.seed, index, *probability);
                add(&mut of[first.0], &kept);
            }
            Op::Combine { map } => {
                let map = batch.row_map(*map)?;
                for to in 0..rows {
                    for (from, weight) in map.entries(to) {
                        for c in 0..width {
                            of[first.0].values_mut()[from * width + c] +=
                                gradient.row(to)[c] * T::from_f32(weight);
                        }
                    }
                }
            }
            Op::MaxPool { map } => {
                for (to, run) in batch.runs(*map)?.iter().enumerate() {
                    for c in 0..width {
                        let from = largest(input, run.clone(), c);
                        of[first.0].values_mut()[from * width + c] += gradient.row(to)[c];
                    }
                }
            }
        }
    }
    let inputs = graph.inputs().map(|(id, ..)| of[id.0].clone()).collect();
    Ok(Gradients { parameters: of_parameters, inputs })
}

fn add<T: Real>(sum: &mut Matrix<T>, other: &Matrix<T>) {
    for (sum, &other) in sum.values_mut().iter_mut().zip(other.values()) {
        *sum += other;
    }
}

/// The gradient of the input; those of scale and shift are added to the parameters'.
fn batch_norm<T: Real>(
    norm: &BatchNorm,
    parameters: &[Vec<T>],
    input: &Matrix<T>,
    gradient: &Matrix<T>,
    of_parameters: &mut [Vec<T>],
) -> Matrix<T> {
    let (mean, variance) = moments(input);
    let inverse = inverse_deviation(&variance, norm.epsilon);
    let (rows, channels) = (input.rows(), input.channels());
    let normal = |row: usize, c: usize| (input.row(row)[c] - mean[c]) * inverse[c];
    let mut back = Matrix::zeros(rows, channels);
    for c in 0..channels {
        let (mut of_shift, mut of_scale) = (T::default(), T::default());
        for row in 0..rows {
            of_shift += gradient.row(row)[c];
            of_scale += gradient.row(row)[c] * normal(row, c);
        }
        of_parameters[norm.shift.0][c] += of_shift;
        of_parameters[norm.scale.0][c] += of_scale;
        let count = T::from_f32(rows as f32);
        let factor = parameters[norm.scale.0][c] * inverse[c];
        for row in 0..rows {
            let centred =
                gradient.row(row)[c] - of_shift / count - normal(row, c) * of_scale / count;
            back.values_mut()[row * channels + c] = factor * centred;
        }
    }
    back
}
