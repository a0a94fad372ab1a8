//! The reverse pass. A gradient's memory goes back as soon as the operation behind it is done.

use super::buffers::Buffers;
use super::convolve::{Epilogue, Pairs, convolve};
use super::panels::Panels;
use super::task::Task;
use super::train::Kept;
use super::weight_gradient::weight_gradient;
use super::{elementwise, norm, pool};
use crate::executor::Gradients;
use crate::graph::{MapId, Node, NodeId, Op, ParameterId};
use crate::simd::Rows;
use crate::{Error, Matrix};

/// A pass on its way.
struct Pass<'a> {
    task: &'a Task<'a>,
    buffers: &'a mut Buffers,
    kept: Kept,
    /// Whether a node's gradient is of use.
    needed: Vec<bool>,
    of: Vec<Option<Vec<f32>>>,
    of_parameters: Vec<Vec<f32>>,
}

/// Gradients of parameters, and if `with_inputs` of the graph's inputs.
pub fn backward(
    task: &Task<'_>,
    buffers: &mut Buffers,
    kept: Kept,
    output_gradients: &[Matrix],
    with_inputs: bool,
) -> Result<Gradients, Error> {
    let nodes = task.graph.nodes();
    let specs = task.graph.parameters().iter();
    let mut pass = Pass {
        task,
        buffers,
        kept,
        needed: needed(nodes, with_inputs),
        of: vec![None; nodes.len()],
        of_parameters: specs.map(|spec| vec![0.0; spec.len()]).collect(),
    };
    for (&output, gradient) in task.graph.outputs().iter().zip(output_gradients) {
        let copy = pass.copy(gradient.values())?;
        pass.add(output, copy);
    }
    for (index, node) in nodes.iter().enumerate().rev() {
        if matches!(node.op, Op::Input(_)) || !pass.needed[index] {
            continue;
        }
        if let Some(gradient) = pass.of[index].take() {
            pass.step(index, node, gradient)?;
        }
        pass.release(index);
    }
    let inputs = if with_inputs { pass.inputs()? } else { Vec::new() };
    let Pass { buffers, kept, of_parameters, of, .. } = pass;
    of.into_iter().flatten().for_each(|gradient| buffers.give(gradient));
    kept.give_back(buffers);
    Ok(Gradients { parameters: of_parameters, inputs })
}

/// Whether each node's gradient is of use: it has parameters, or something before it has.
fn needed(nodes: &[Node], with_inputs: bool) -> Vec<bool> {
    let mut needed: Vec<bool> = Vec::new();
    for node in nodes {
        let own = match node.op {
            Op::Input(_) => with_inputs,
            Op::Convolution { .. } | Op::BatchNorm(_) => true,
            _ => false,
        };
        let earlier = node.inputs.iter().any(|input| needed[input.0]);
        needed.push(own || earlier);
    }
    needed
}

impl Pass<'_> {
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

    fn copy(&mut self, values: &[f32]) -> Result<Vec<f32>, Error> {
        let mut copy = self.buffers.take(values.len())?;
        copy.copy_from_slice(values);
        Ok(copy)
    }

    /// Once a node is done nothing earlier needs its value.
    fn release(&mut self, index: usize) {
        if self.kept.holder[index] == index {
            let value = std::mem::take(&mut self.kept.values[index]);
            self.buffers.give(value);
        }
    }

    fn inputs(&mut self) -> Result<Vec<Matrix>, Error> {
        let inputs: Vec<NodeId> = self.task.graph.inputs().map(|(id, ..)| id).collect();
        let gradient = |id: NodeId| {
            let node = self.task.node(id);
            let none = || vec![0.0; self.task.rows(node) * node.channels];
            self.task.matrix(id, self.of[id.0].take().unwrap_or_else(none))
        };
        inputs.into_iter().map(gradient).collect()
    }

    /// From the gradient of a node's value to those of its inputs and parameters.
    fn step(&mut self, index: usize, node: &Node, mut gradient: Vec<f32>) -> Result<(), Error> {
        let first = node.inputs[0];
        match node.op {
            Op::Input(_) => {}
            Op::Convolution { map, weight, bias } => {
                self.convolution(node, map, weight, bias, &gradient)?;
                self.buffers.give(gradient);
            }
            Op::BatchNorm(op) => {
                let moments = self.kept.moments[index].take().expect("forward keeps them");
                let (scale, input) = (self.task.parameters.get(op.scale), self.kept.value(first));
                let (of_scale, of_shift) = norm::backward(scale, &moments, input, &mut gradient);
                self.of_parameters[op.scale.0] = of_scale;
                self.of_parameters[op.shift.0] = of_shift;
                self.add(first, gradient);
            }
            Op::Activation { slope } => {
                let output = self.kept.value(NodeId(index));
                elementwise::activate_backward(&mut gradient, output, slope);
                self.add(first, gradient);
            }
            Op::Add => {
                let copy = self.copy(&gradient)?;
                self.add(first, copy);
                self.add(node.inputs[1], gradient);
            }
            Op::Concatenate => self.concatenate(node, gradient)?,
            Op::Dropout { probability } => {
                elementwise::dropout(&mut gradient, self.kept.seed, index, probability);
                self.add(first, gradient);
            }
            Op::Combine { map } => {
                let adjoint = self.task.batch.row_map(map)?.adjoint();
                let mut out = self.like(first)?;
                pool::combine(adjoint, &gradient, node.channels, &mut out);
                self.add(first, out);
                self.buffers.give(gradient);
            }
            Op::MaxPool { map } => {
                let (runs, mut out) = (self.task.batch.runs(map)?, self.like(first)?);
                let input = self.kept.value(first);
                pool::max_pool_backward(runs, input, node.channels, &gradient, &mut out);
                self.add(first, out);
                self.buffers.give(gradient);
            }
        }
        Ok(())
    }

    /// A buffer as large as a node's value.
    fn like(&mut self, id: NodeId) -> Result<Vec<f32>, Error> {
        let node = self.task.node(id);
        self.buffers.take(self.task.rows(node) * node.channels)
    }

    fn concatenate(&mut self, node: &Node, gradient: Vec<f32>) -> Result<(), Error> {
        let mut start = 0;
        for &part in &node.inputs {
            let width = self.task.node(part).channels;
            if self.needed[part.0] {
                let mut out = self.like(part)?;
                elementwise::columns(&gradient, node.channels, start, width, &mut out);
                self.add(part, out);
            }
            start += width;
        }
        self.buffers.give(gradient);
        Ok(())
    }

    fn convolution(
        &mut self,
        node: &Node,
        map: Option<MapId>,
        weight: ParameterId,
        bias: Option<ParameterId>,
        gradient: &[f32],
    ) -> Result<(), Error> {
        let (task, first, channels) = (self.task, node.inputs[0], node.channels);
        let (width, rows) = (task.node(first).channels, task.rows(task.node(first)));
        let map = map.map(|map| task.batch.kernel(map)).transpose()?;
        if let Some(bias) = bias {
            self.of_parameters[bias.0] = norm::column_sums(gradient, channels);
        }
        weight_gradient(
            task.isa,
            map.map_or(Pairs::Same(rows), Pairs::Map),
            Rows { values: self.kept.value(first), width },
            Rows { values: gradient, width: channels },
            &mut self.of_parameters[weight.0],
        );
        if !self.needed[first.0] {
            return Ok(());
        }
        let (back, mirrored) = match map.map(|map| map.adjoint()) {
            Some((map, mirrored)) => (Pairs::Map(map), mirrored),
            None => (Pairs::Same(rows), false),
        };
        let mut packed = self.buffers.take(Panels::len(back.volume(), channels, width))?;
        let weights = task.parameters.get(weight);
        let panels = Panels::pack_transposed(&mut packed, weights, channels, width, mirrored);
        let mut out = self.buffers.take(rows * width)?;
        convolve(task.isa, back, gradient, &panels, Epilogue::default(), &mut out);
        self.buffers.give(packed);
        self.add(first, out);
        Ok(())
    }
}
