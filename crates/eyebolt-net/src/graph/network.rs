//! Operations in order.

use super::domain::{Domain, MapSpec, SampleLevel, Source};
use super::ids::NodeId;
use super::op::Op;
use super::parameter::ParameterSpec;

/// An operation with its place in the graph.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// As its parameters are called.
    pub name: String,
    /// What it does.
    pub op: Op,
    /// What it does it to; all earlier than itself.
    pub inputs: Vec<NodeId>,
    /// Channels of its value.
    pub channels: usize,
    /// Which rows its value has: a place among [`Graph::domains`].
    pub domain: usize,
}

/// A network. [`GraphBuilder`](super::GraphBuilder) makes one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Graph {
    pub(crate) domains: Vec<Domain>,
    pub(crate) maps: Vec<MapSpec>,
    pub(crate) sampling: Vec<SampleLevel>,
    pub(crate) parameters: Vec<ParameterSpec>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) outputs: Vec<NodeId>,
}

impl Graph {
    /// The sets of rows that its values have.
    pub fn domains(&self) -> &[Domain] {
        &self.domains
    }

    /// The maps that its operations need.
    pub fn maps(&self) -> &[MapSpec] {
        &self.maps
    }

    /// How points are sampled, level after level; empty for networks on voxels.
    pub fn sampling(&self) -> &[SampleLevel] {
        &self.sampling
    }

    /// What is learned.
    pub fn parameters(&self) -> &[ParameterSpec] {
        &self.parameters
    }

    /// Whether these are as many values for each parameter as it has.
    pub(crate) fn has_parameters<T>(&self, values: &[Vec<T>]) -> bool {
        self.parameters.iter().map(ParameterSpec::len).eq(values.iter().map(Vec::len))
    }

    /// In order: the inputs of an operation come before it.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Whose values the network gives.
    pub fn outputs(&self) -> &[NodeId] {
        &self.outputs
    }

    /// Nodes that take values from outside, with what they take, in order.
    pub fn inputs(&self) -> impl Iterator<Item = (NodeId, &Node, Source)> {
        self.nodes.iter().enumerate().filter_map(|(index, node)| match node.op {
            Op::Input(source) => Some((NodeId(index), node, source)),
            _ => None,
        })
    }

    /// How many operations use each node's value; an output counts as a use.
    pub(crate) fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.nodes.len()];
        let inputs = self.nodes.iter().flat_map(|node| &node.inputs);
        inputs.chain(&self.outputs).for_each(|input| uses[input.0] += 1);
        uses
    }
}
