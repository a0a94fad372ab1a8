//! The forward pass in training, which keeps what the reverse pass needs.

use super::buffers::Buffers;
use super::convolve::Epilogue;
use super::elementwise;
use super::norm::{self, Moments};
use super::task::Task;
use crate::Error;
use crate::executor::Forward;
use crate::graph::{Graph, Node, NodeId, Op, ParameterId};

/// Values of a forward pass.
pub struct Kept {
    pub values: Vec<Vec<f32>>,
    pub moments: Vec<Option<Moments>>,
    /// Whose value a node's is: an activation works in place where nothing else needs its input.
    pub holder: Vec<usize>,
    pub seed: u64,
}

impl Kept {
    /// The value of a node.
    pub fn value(&self, node: NodeId) -> &[f32] {
        &self.values[self.holder[node.0]]
    }

    /// All memory.
    pub fn give_back(self, buffers: &mut Buffers) {
        self.values.into_iter().for_each(|value| buffers.give(value));
    }
}

/// Whose value each node's is.
fn holders(graph: &Graph) -> Vec<usize> {
    let uses = graph.uses();
    let mut holders: Vec<usize> = (0..graph.nodes().len()).collect();
    for (index, node) in graph.nodes().iter().enumerate() {
        let Op::Activation { .. } = node.op else { continue };
        let input = node.inputs[0].0;
        let before = &graph.nodes()[input].op;
        // Inputs belong to the batch, and a second activation would need what the first gave.
        if uses[input] == 1 && !matches!(before, Op::Input(_) | Op::Activation { .. }) {
            holders[index] = input;
        }
    }
    holders
}

/// Outputs and running statistics, and what the reverse pass needs.
pub fn forward(
    task: &Task<'_>,
    buffers: &mut Buffers,
    seed: u64,
) -> Result<(Forward, Kept), Error> {
    let graph = task.graph;
    let moments = graph.nodes().iter().map(|_| None).collect();
    let mut kept = Kept { values: Vec::new(), moments, holder: holders(graph), seed };
    let mut running = Vec::new();
    let mut inputs = task.batch.inputs().iter();
    for (index, node) in graph.nodes().iter().enumerate() {
        let holder = kept.holder[index];
        let value = match node.op {
            Op::Activation { slope } if holder != index => {
                elementwise::activate(&mut kept.values[holder], slope);
                Vec::new()
            }
            Op::Input(_) => {
                let input = inputs.next().expect("the batch was checked");
                let mut out = buffers.take(input.values().len())?;
                out.copy_from_slice(input.values());
                out
            }
            _ => run(task, buffers, &mut kept, index, node, &mut running)?,
        };
        kept.values.push(value);
    }
    let output = |&output: &NodeId| task.matrix(output, kept.value(output).to_vec());
    let outputs = graph.outputs().iter().map(output).collect::<Result<_, _>>()?;
    Ok((Forward { outputs, running }, kept))
}

fn run(
    task: &Task<'_>,
    buffers: &mut Buffers,
    kept: &mut Kept,
    index: usize,
    node: &Node,
    running: &mut Vec<(ParameterId, Vec<f32>)>,
) -> Result<Vec<f32>, Error> {
    let mut out = buffers.take(task.rows(node) * node.channels)?;
    let input = kept.value(node.inputs[0]);
    match &node.op {
        Op::Convolution { bias, .. } => {
            let shift = bias.map(|bias| task.parameters.get(bias));
            let epilogue = Epilogue { shift, ..Epilogue::default() };
            task.convolve(buffers, node, input, epilogue, &mut out)?;
        }
        Op::BatchNorm(op) => {
            let moments = norm::forward(op, task.parameters, input, &mut out, running);
            kept.moments[index] = Some(moments);
        }
        Op::Dropout { probability } => {
            out.copy_from_slice(input);
            elementwise::dropout(&mut out, kept.seed, index, *probability);
        }
        _ => task.plain(node, |node| kept.value(node), &mut out)?,
    }
    Ok(out)
}
