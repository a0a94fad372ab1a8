//! Gradients, by the chain rule over the graph in reverse.

use super::case::Case;
use super::forward::dropout;
use super::ops::{for_each_pair, inverse_deviation, largest, moments};
use super::real::Real;
use crate::executor::Gradients;
use crate::graph::{BatchNorm, Node, Op};
use crate::{Error, Matrix};

/// Of all values and parameters.
struct Pass<'a, T> {
    case: Case<'a, T>,
    values: &'a [Matrix<T>],
    seed: u64,
    of: Vec<Matrix<T>>,
    of_parameters: Vec<Vec<T>>,
}

/// Gradients of parameters and inputs, from the values of a forward pass with this seed.
pub fn backward<T: Real>(
    case: Case<'_, T>,
    values: &[Matrix<T>],
    seed: u64,
    output_gradients: &[Matrix<T>],
) -> Result<Gradients<T>, Error> {
    let zeros = |value: &Matrix<T>| Matrix::zeros(value.rows(), value.channels());
    let of = values.iter().map(zeros).collect();
    let of_parameters = case.parameters.iter().map(|p| vec![T::default(); p.len()]).collect();
    let mut pass = Pass { case, values, seed, of, of_parameters };
    for (output, gradient) in case.graph.outputs().iter().zip(output_gradients) {
        add(&mut pass.of[output.0], gradient);
    }
    for (index, node) in case.graph.nodes().iter().enumerate().rev() {
        pass.step(index, node)?;
    }
    let inputs = case.graph.inputs().map(|(id, ..)| pass.of[id.0].clone()).collect();
    Ok(Gradients { parameters: pass.of_parameters, inputs })
}

fn add<T: Real>(sum: &mut Matrix<T>, other: &Matrix<T>) {
    for (sum, &other) in sum.values_mut().iter_mut().zip(other.values()) {
        *sum += other;
    }
}

impl<T: Real> Pass<'_, T> {
    fn step(&mut self, index: usize, node: &Node) -> Result<(), Error> {
        let gradient = self.of[index].clone();
        let Some(&first) = node.inputs.first() else { return Ok(()) };
        let input = &self.values[first.0];
        match &node.op {
            Op::Input(_) => {}
            Op::Convolution { .. } => self.convolution(node, &gradient)?,
            Op::BatchNorm(norm) => {
                let back = self.batch_norm(norm, input, &gradient);
                add(&mut self.of[first.0], &back);
            }
            Op::Activation { slope } => {
                for (at, &g) in gradient.values().iter().enumerate() {
                    let positive = input.values()[at] > T::default();
                    self.of[first.0].values_mut()[at] +=
                        if positive { g } else { g * T::from_f32(*slope) };
                }
            }
            Op::Add => node.inputs.iter().for_each(|part| add(&mut self.of[part.0], &gradient)),
            Op::Concatenate => {
                let mut start = 0;
                for part in &node.inputs {
                    let of = &mut self.of[part.0];
                    let channels = of.channels();
                    for (at, sum) in of.values_mut().iter_mut().enumerate() {
                        *sum += gradient.row(at / channels)[start + at % channels];
                    }
                    start += channels;
                }
            }
            Op::Dropout { probability } => {
                let kept = dropout(&gradient, self.seed, index, *probability);
                add(&mut self.of[first.0], &kept);
            }
            Op::Combine { .. } | Op::MaxPool { .. } => self.rows(node, &gradient)?,
        }
        Ok(())
    }

    fn convolution(&mut self, node: &Node, gradient: &Matrix<T>) -> Result<(), Error> {
        let Op::Convolution { map, weight, bias } = node.op else { return Ok(()) };
        let (first, width) = (node.inputs[0].0, node.channels);
        let (input, weights) = (&self.values[first], &self.case.parameters[weight.0]);
        let map = map.map(|map| self.case.batch.kernel(map)).transpose()?;
        let of_input = self.of[first].values_mut();
        let of_weights = &mut self.of_parameters[weight.0];
        for_each_pair(map, gradient.rows(), |offset, from, to| {
            for (k, &value) in input.row(from).iter().enumerate() {
                let at = (offset * input.channels() + k) * width;
                for (c, &g) in gradient.row(to).iter().enumerate() {
                    of_weights[at + c] += value * g;
                    of_input[from * input.channels() + k] += weights[at + c] * g;
                }
            }
        });
        if let Some(bias) = bias {
            for (at, &g) in gradient.values().iter().enumerate() {
                self.of_parameters[bias.0][at % width] += g;
            }
        }
        Ok(())
    }

    fn rows(&mut self, node: &Node, gradient: &Matrix<T>) -> Result<(), Error> {
        let (first, width) = (node.inputs[0].0, node.channels);
        let of = self.of[first].values_mut();
        match node.op {
            Op::Combine { map } => {
                let map = self.case.batch.row_map(map)?;
                for to in 0..gradient.rows() {
                    for (from, weight) in map.entries(to) {
                        for c in 0..width {
                            of[from * width + c] += gradient.row(to)[c] * T::from_f32(weight);
                        }
                    }
                }
            }
            Op::MaxPool { map } => {
                for (to, run) in self.case.batch.runs(map)?.iter().enumerate() {
                    for c in 0..width {
                        let from = largest(&self.values[first], run.clone(), c);
                        of[from * width + c] += gradient.row(to)[c];
                    }
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// The gradient of the input; those of scale and shift are added to the parameters'.
    fn batch_norm(
        &mut self,
        norm: &BatchNorm,
        input: &Matrix<T>,
        gradient: &Matrix<T>,
    ) -> Matrix<T> {
        let (mean, variance) = moments(input);
        let inverse = inverse_deviation(&variance, norm.epsilon);
        let (rows, channels) = (input.rows(), input.channels());

        let mut back = Matrix::zeros(rows, channels);
        for (c, &inverse) in inverse.iter().enumerate() {
            let normal = |row: usize| (input.row(row)[c] - mean[c]) * inverse;
            let (mut of_shift, mut of_scale) = (T::default(), T::default());
            for row in 0..rows {
                of_shift += gradient.row(row)[c];
                of_scale += gradient.row(row)[c] * normal(row);
            }
            self.of_parameters[norm.shift.0][c] += of_shift;
            self.of_parameters[norm.scale.0][c] += of_scale;
            let count = T::from_f32(rows as f32);
            let factor = self.case.parameters[norm.scale.0][c] * inverse;
            for row in 0..rows {
                let centred =
                    gradient.row(row)[c] - of_shift / count - normal(row) * of_scale / count;
                back.values_mut()[row * channels + c] = factor * centred;
            }
        }
        back
    }
}
