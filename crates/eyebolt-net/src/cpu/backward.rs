//! The reverse pass. A gradient's memory goes back as soon as the operation behind it is done.

use super::buffers::Buffers;
use super::convolve::{Epilogue, Pairs, convolve};
use super::panels::Panels;
use super::train::Kept;
use super::weight_gradient::weight_gradient;
use super::{elementwise, norm, pool};
use crate::executor::Gradients;
use crate::graph::{BatchNorm, Graph, Node, NodeId, Op};
use crate::simd::{Isa, Rows};
use crate::{Batch, Error, Matrix, Parameters};

/// What does not change during the pass.
pub struct Task<'a> {
    pub isa: Isa,
    pub graph: &'a Graph,
    pub parameters: &'a Parameters,
    pub batch: &'a Batch,
    pub with_inputs: bool,
}

/// What does.
struct State<'a> {
    buffers: &'a mut Buffers,
    kept: Kept,
    of: Vec<Option<Vec<f32>>>,
    of_parameters: Vec<Vec<f32>>,
}

pub fn backward(
    task: &Task<'_>,
    buffers: &mut Buffers,
    kept: Kept,
    output_gradients: &[Matrix],
) -> Result<Gradients, Error> {
    let specs = task.graph.parameters().iter();
    let of_parameters = specs.map(|spec| vec![0.0; spec.len()]).collect();
    let of = vec![None; task.graph.nodes().len()];
    let mut state = State { buffers, kept, of, of_parameters };
    for (&output, gradient) in task.graph.outputs().iter().zip(output_gradients) {
        let mut copy = state.buffers.take(gradient.values().len());
        copy.copy_from_slice(gradient.values());
        state.add(output, copy);
    }
    let needed = needed(task);
    for (index, node) in task.graph.nodes().iter().enumerate().rev() {
        if matches!(node.op, Op::Input(_)) || !needed[index] {
            continue;
        }
        if let Some(gradient) = state.of[index].take() {
            state.step(task, index, node, gradient, &needed)?;
        }
        state.release(index, node);
    }
    let inputs = if task.with_inputs { state.inputs(task)? } else { Vec::new() };
    let State { buffers, kept, of_parameters, of } = state;
    of.into_iter().flatten().for_each(|gradient| buffers.give(gradient));
    kept.give_back(buffers);
    Ok(Gradients { parameters: of_parameters, inputs })
}

/// Whether a node's gradient is of use: it has parameters, or something before it has.
fn needed(task: &Task<'_>) -> Vec<bool> {
    let mut needed: Vec<bool> = Vec::new();
    for node in task.graph.nodes() {
        let own = match node.op {
            Op::Input(_) => task.with_inputs,
            Op::Convolution { .. } | Op::BatchNorm(_) => true,
            _ => false,
        };
        let earlier = node.inputs.iter().any(|input| needed[input.0]);
        needed.push(own || earlier);
    }
    needed
}

impl State<'_> {
    /// Adds to the gradient of a node.
    fn add(&mut self, node: NodeId, gradient: Vec<f32>) {
        match &mut self.of[node.0] {
            Some(sum) => {
                elementwise::add_to(sum, &gradient);
                self.buffers.give(gradient);
            }
            empty => *empty = Some(gradient),
        }
    }

    /// Once a node is done nothing earlier needs its value.
    fn release(&mut self, index: usize, node: &Node) {
        if self.kept.holder[index] == index && !matches!(node.op, Op::Input(_)) {
            let value = std::mem::take(&mut self.kept.values[index]);
            self.buffers.give(value);
        }
    }

    fn inputs(&mut self, task: &Task<'_>) -> Result<Vec<Matrix>, Error> {
        let gradients = task.graph.inputs().map(|(id, node, _)| {
            let rows = task.batch.rows[node.domain];
            let values = self.of[id.0].take().unwrap_or_else(|| vec![0.0; rows * node.channels]);
            Matrix::new(rows, node.channels, values)
        });
        gradients.collect()
    }

    fn step(
        &mut self,
        task: &Task<'_>,
        index: usize,
        node: &Node,
        mut gradient: Vec<f32>,
        needed: &[bool],
    ) -> Result<(), Error> {
        let first = node.inputs[0];
        let width = task.graph.nodes()[first.0].channels;
        let rows = task.batch.rows[task.graph.nodes()[first.0].domain];
        match &node.op {
            Op::Input(_) => {}
            Op::Convolution { map, weight, bias } => {
                let map = map.map(|map| task.batch.kernel(map)).transpose()?;
                if let Some(bias) = bias {
                    let (sums, _) = column_sums(&gradient, node.channels);
                    self.of_parameters[bias.0] = sums;
                }
                let pairs = map.map_or(Pairs::Same(rows), Pairs::Map);
                weight_gradient(
                    task.isa,
                    pairs,
                    Rows { values: self.kept.value(first), width },
                    Rows { values: &gradient, width: node.channels },
                    &mut self.of_parameters[weight.0],
                );
                if needed[first.0] {
                    let (back, mirrored) = match map.map(|map| map.adjoint()) {
                        Some((map, mirrored)) => (Pairs::Map(map), mirrored),
                        None => (Pairs::Same(rows), false),
                    };
                    let len = Panels::len(back.volume(), node.channels, width);
                    let mut packed = self.buffers.take(len);
                    let weights = task.parameters.get(*weight);
                    let panels = Panels::pack_transposed(
                        &mut packed,
                        weights,
                        node.channels,
                        width,
                        mirrored,
                    );
                    let mut out = self.buffers.take(rows * width);
                    convolve(task.isa, back, &gradient, &panels, Epilogue::default(), &mut out);
                    self.buffers.give(packed);
                    self.add(first, out);
                }
                self.buffers.give(gradient);
            }
            Op::BatchNorm(norm) => {
                self.batch_norm(task, index, norm, first, &mut gradient);
                self.add(first, gradient);
            }
            Op::Activation { slope } => {
                elementwise::activate_backward(
                    &mut gradient,
                    self.kept.value(NodeId(index)),
                    *slope,
                );
                self.add(first, gradient);
            }
            Op::Add => {
                let mut copy = self.buffers.take(gradient.len());
                copy.copy_from_slice(&gradient);
                self.add(first, copy);
                self.add(node.inputs[1], gradient);
            }
            Op::Concatenate => {
                let mut start = 0;
                for &part in &node.inputs {
                    let width = task.graph.nodes()[part.0].channels;
                    if needed[part.0] {
                        let mut out = self.buffers.take(rows * width);
                        elementwise::columns(&gradient, node.channels, start, width, &mut out);
                        self.add(part, out);
                    }
                    start += width;
                }
                self.buffers.give(gradient);
            }
            Op::Dropout { probability } => {
                elementwise::dropout(&mut gradient, self.kept.seed, index, *probability);
                self.add(first, gradient);
            }
            Op::Combine { map } => {
                let mut out = self.buffers.take(rows * width);
                pool::combine(task.batch.row_map(*map)?.adjoint(), &gradient, width, &mut out);
                self.add(first, out);
                self.buffers.give(gradient);
            }
            Op::MaxPool { map } => {
                let mut out = self.buffers.take(rows * width);
                let input = self.kept.value(first);
                pool::max_pool_backward(task.batch.runs(*map)?, input, width, &gradient, &mut out);
                self.add(first, out);
                self.buffers.give(gradient);
            }
        }
        Ok(())
    }

    fn batch_norm(
        &mut self,
        task: &Task<'_>,
        index: usize,
        op: &BatchNorm,
        first: NodeId,
        gradient: &mut [f32],
    ) {
        let moments = self.kept.moments[index].take().expect("forward keeps them");
        let input = self.kept.value(first);
        let (of_shift, of_scale) =
            norm::gradient_sums(gradient, input, &moments.mean, &moments.inverse);
        let count = (gradient.len() / moments.mean.len().max(1)) as f32;
        let scale = task.parameters.get(op.scale);
        let factor: Vec<f32> = scale.iter().zip(&moments.inverse).map(|(a, b)| a * b).collect();
        let a: Vec<f32> = of_shift.iter().map(|sum| sum / count).collect();
        let b: Vec<f32> = of_scale
            .iter()
            .zip(&moments.inverse)
            .map(|(sum, inverse)| sum / count * inverse)
            .collect();
        norm::backward(gradient, input, &moments.mean, &factor, &a, &b);
        self.of_parameters[op.shift.0] = of_shift;
        self.of_parameters[op.scale.0] = of_scale;
    }
}

/// Sums over all rows.
fn column_sums(values: &[f32], channels: usize) -> (Vec<f32>, Vec<f32>) {
    let zeros = vec![0.0; channels];
    norm::gradient_sums(values, values, &zeros, &zeros)
}
