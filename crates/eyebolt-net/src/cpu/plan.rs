//! Which operations of a graph run together in inference: a convolution with the batch norm,
//! the addition and the activation behind it, each used by nothing else.

use crate::graph::{BatchNorm, Graph, NodeId, Op};

/// Operations that run as one; the value is that of the last.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The operation that the rest follows.
    pub head: NodeId,
    /// The last: whose value this is.
    pub last: NodeId,
    /// Batch norm behind a convolution.
    pub norm: Option<BatchNorm>,
    /// The other value of an addition.
    pub residual: Option<NodeId>,
    /// Slope of an activation.
    pub slope: Option<f32>,
}

impl Step {
    /// What must be there before.
    pub fn needs<'a>(&'a self, graph: &'a Graph) -> impl Iterator<Item = NodeId> + 'a {
        graph.nodes()[self.head.0].inputs.iter().copied().chain(self.residual)
    }
}

/// The steps of a graph, in order.
pub fn plan(graph: &Graph) -> Vec<Step> {
    let uses = graph.uses();
    let mut only_use = vec![None; graph.nodes().len()];
    for (index, node) in graph.nodes().iter().enumerate() {
        for input in &node.inputs {
            only_use[input.0] = (uses[input.0] == 1).then_some(NodeId(index));
        }
    }
    let mut done = vec![false; graph.nodes().len()];
    let mut steps = Vec::new();
    for index in 0..graph.nodes().len() {
        if done[index] {
            continue;
        }
        let step = step_from(graph, NodeId(index), &only_use, &done);
        // What was swallowed has no step of its own; its value is that of the last.
        let mut at = step.head;
        done[at.0] = true;
        while at != step.last {
            at = only_use[at.0].expect("a step goes on where there is a single use");
            done[at.0] = true;
        }
        steps.push(step);
    }
    steps
}

fn step_from(graph: &Graph, head: NodeId, only_use: &[Option<NodeId>], done: &[bool]) -> Step {
    let mut step = Step { head, last: head, norm: None, residual: None, slope: None };
    if !matches!(graph.nodes()[head.0].op, Op::Convolution { .. }) {
        return step;
    }
    while let Some(next) = only_use[step.last.0] {
        let node = &graph.nodes()[next.0];
        match node.op {
            Op::BatchNorm(norm) if step.last == head => step.norm = Some(norm),
            Op::Add if step.residual.is_none() && step.slope.is_none() => {
                let other = node.inputs[usize::from(node.inputs[0] == step.last)];
                // Only if it is there by now: else the other operand takes the addition along.
                if !done[other.0] || other == step.last {
                    break;
                }
                step.residual = Some(other);
            }
            Op::Activation { slope } if step.slope.is_none() => step.slope = Some(slope),
            _ => break,
        }
        step.last = next;
        if step.slope.is_some() {
            break;
        }
    }
    step
}
