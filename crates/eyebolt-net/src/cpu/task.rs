//! What does not change during a run, and the operations that inference and training share.

use super::buffers::Buffers;
use super::convolve::{Epilogue, Pairs, convolve};
use super::panels::Panels;
use super::{elementwise, pool};
use crate::graph::{Graph, Node, NodeId, Op};
use crate::simd::Isa;
use crate::{Batch, Error, Matrix, Parameters};

/// A graph on a batch.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    pub isa: Isa,
    pub graph: &'a Graph,
    pub parameters: &'a Parameters,
    pub batch: &'a Batch,
}

impl<'a> Task<'a> {
    /// A node of the graph.
    pub fn node(&self, id: NodeId) -> &'a Node {
        &self.graph.nodes()[id.0]
    }

    /// Rows of a node's value.
    pub fn rows(&self, node: &Node) -> usize {
        self.batch.rows()[node.domain]
    }

    /// A node's value as a matrix.
    pub fn matrix(&self, id: NodeId, values: Vec<f32>) -> Result<Matrix, Error> {
        let node = self.node(id);
        Matrix::new(self.rows(node), node.channels, values)
    }

    /// A convolution or linear layer with an epilogue, which has the bias.
    pub fn convolve(
        &self,
        buffers: &mut Buffers,
        node: &Node,
        input: &[f32],
        epilogue: Epilogue<'_>,
        out: &mut [f32],
    ) -> Result<(), Error> {
        let Op::Convolution { map, weight, .. } = node.op else { return Ok(()) };
        let pairs = match map {
            Some(map) => Pairs::Map(self.batch.kernel(map)?),
            None => Pairs::Same(self.rows(node)),
        };
        let (depth, columns) = (self.node(node.inputs[0]).channels, node.channels);
        let mut packed = buffers.take(Panels::len(pairs.volume(), depth, columns))?;
        let panels = Panels::pack(&mut packed, self.parameters.get(weight), depth, columns);
        convolve(self.isa, pairs, input, &panels, epilogue, out);
        buffers.give(packed);
        Ok(())
    }

    /// An operation that is the same in inference and training, from the values of its inputs.
    pub fn plain<'v>(
        &self,
        node: &Node,
        value: impl Fn(NodeId) -> &'v [f32],
        out: &mut [f32],
    ) -> Result<(), Error> {
        let input = |place: usize| value(node.inputs[place]);
        match node.op {
            Op::Activation { slope } => {
                out.copy_from_slice(input(0));
                elementwise::activate(out, slope);
            }
            Op::Add => elementwise::add(input(0), input(1), out),
            Op::Concatenate => {
                let part = |&part: &NodeId| (value(part), self.node(part).channels);
                let parts: Vec<(&[f32], usize)> = node.inputs.iter().map(part).collect();
                elementwise::concatenate(&parts, out);
            }
            Op::Combine { map } => {
                pool::combine(self.batch.row_map(map)?, input(0), node.channels, out);
            }
            Op::MaxPool { map } => {
                pool::max_pool(self.batch.runs(map)?, input(0), node.channels, out);
            }
            // These are not the same, and have functions of their own where they differ.
            Op::Input(_) | Op::Convolution { .. } | Op::BatchNorm(_) | Op::Dropout { .. } => {}
        }
        Ok(())
    }
}
