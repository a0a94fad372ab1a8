//! A network as data: operations on rows of channels, in order.
//!
//! A graph knows neither sizes of inputs nor devices. What depends on the points at hand, who is
//! whose neighbour, comes with each [`Batch`](crate::Batch); numbers that are learned are
//! [`Parameters`](crate::Parameters).

mod builder;
mod check;
mod domain;
mod op;

pub use builder::GraphBuilder;
pub use check::MAX_PARAMETERS;
pub use domain::{Domain, MapSpec, SampleLevel, SampleScale, Source};
pub use op::{BatchNorm, Op};

/// An operation of a graph, by its place in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub(crate) usize);

impl NodeId {
    /// Its place in the graph's list.
    pub fn index(self) -> usize {
        self.0
    }
}

/// A parameter of a graph, by its place in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ParameterId(pub(crate) usize);

impl ParameterId {
    /// Its place in the graph's list.
    pub fn index(self) -> usize {
        self.0
    }
}

/// A map of a graph, by its place in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MapId(pub(crate) usize);

impl MapId {
    /// Its place in the graph's list.
    pub fn index(self) -> usize {
        self.0
    }
}

/// What a parameter is for: how it starts, and whether it is trained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Weights, `fan_in` of which are summed into an output.
    Weight {
        /// Inputs of an output, over all offsets.
        fan_in: usize,
    },
    /// Added to outputs; starts at zero.
    Bias,
    /// Of a batch norm; starts at one.
    Scale,
    /// Of a batch norm; starts at zero.
    Shift,
    /// Running mean of a batch norm, not trained; starts at zero.
    Mean,
    /// Running variance of a batch norm, not trained; starts at one.
    Variance,
}

impl Role {
    /// Whether gradients change it.
    pub fn is_trained(self) -> bool {
        !matches!(self, Self::Mean | Self::Variance)
    }
}

/// Name, shape and role of a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterSpec {
    /// As in a state dict: `block1.0.conv1.kernel`.
    pub name: String,
    /// `[offsets, inputs, outputs]` of a convolution, `[inputs, outputs]` of a linear layer, else
    /// `[channels]`.
    pub shape: Vec<usize>,
    /// What it is for.
    pub role: Role,
}

impl ParameterSpec {
    /// Number of values.
    pub fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Whether it has no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

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

/// A network. [`GraphBuilder`] makes one.
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
