//! Adding operations one after the other, with shapes checked on the way.

use super::{
    BatchNorm, Domain, Graph, MapId, MapSpec, Node, NodeId, Op, ParameterId, ParameterSpec, Role,
    SampleLevel, Source, check,
};
use crate::Error;
use crate::coordinates::KernelSpec;

/// Makes a [`Graph`]. Every method adds one operation and gives the node of its value.
#[derive(Debug, Default)]
pub struct GraphBuilder {
    graph: Graph,
}

impl GraphBuilder {
    /// Of a network on voxels or points.
    pub fn new() -> Self {
        Self::default()
    }

    /// Of a network that samples points as these levels say.
    pub fn with_sampling(levels: Vec<SampleLevel>) -> Self {
        Self { graph: Graph { sampling: levels, ..Graph::default() } }
    }

    /// Values from outside.
    pub fn input(&mut self, source: Source, domain: Domain, channels: usize) -> NodeId {
        let domain = self.domain(domain);
        self.push("input", Op::Input(source), vec![], channels, domain)
    }

    /// A convolution; `name.kernel` and `name.bias` are its parameters.
    ///
    /// # Errors
    /// If there can be no such convolution, or `input` does not live on the voxels that it comes
    /// from.
    pub fn convolution(
        &mut self,
        name: &str,
        input: NodeId,
        spec: KernelSpec,
        channels: usize,
        bias: bool,
    ) -> Result<NodeId, Error> {
        spec.check()?;
        self.expect_domain(name, input, Domain::Voxels { stride: spec.from })?;
        let domain = self.domain(Domain::Voxels { stride: spec.to });
        // A kernel of one voxel pairs each row with itself, whatever the map.
        let plain = spec.kernel.size == 1 && spec.from == spec.to;
        let map = (!plain).then(|| self.map(MapSpec::Kernel(spec)));
        let (volume, inputs) = (spec.kernel.volume(), self.channels(input));
        let (shape, fan_in) = ([volume, inputs, channels], volume.saturating_mul(inputs));
        let weight = self.weight(format!("{name}.kernel"), &shape, fan_in);
        let bias = bias.then(|| self.parameter(format!("{name}.bias"), &[channels], Role::Bias));
        let op = Op::Convolution { map, weight, bias };
        Ok(self.push(name, op, vec![input], channels, domain))
    }

    /// The same linear layer for every row; `name.weight` and `name.bias`.
    pub fn linear(&mut self, name: &str, input: NodeId, channels: usize, bias: bool) -> NodeId {
        let inputs = self.channels(input);
        let weight = self.weight(format!("{name}.weight"), &[inputs, channels], inputs);
        let bias = bias.then(|| self.parameter(format!("{name}.bias"), &[channels], Role::Bias));
        let op = Op::Convolution { map: None, weight, bias };
        let domain = self.node(input).domain;
        self.push(name, op, vec![input], channels, domain)
    }

    /// Batch norm with the usual constants; `name.weight`, `.bias`, `.running_mean`,
    /// `.running_var`.
    pub fn batch_norm(&mut self, name: &str, input: NodeId) -> NodeId {
        let shape = [self.channels(input)];
        let mut parameter =
            |part: &str, role| self.parameter(format!("{name}.{part}"), &shape, role);
        let norm = BatchNorm {
            scale: parameter("weight", Role::Scale),
            shift: parameter("bias", Role::Shift),
            mean: parameter("running_mean", Role::Mean),
            variance: parameter("running_var", Role::Variance),
            epsilon: 1e-5,
            momentum: 0.1,
        };
        let domain = self.node(input).domain;
        self.push(name, Op::BatchNorm(norm), vec![input], shape[0], domain)
    }

    /// ReLU.
    pub fn relu(&mut self, input: NodeId) -> NodeId {
        self.same_shape(Op::Activation { slope: 0.0 }, input)
    }

    /// Leaky ReLU.
    pub fn leaky_relu(&mut self, input: NodeId, slope: f32) -> NodeId {
        self.same_shape(Op::Activation { slope }, input)
    }

    /// Dropout.
    pub fn dropout(&mut self, input: NodeId, probability: f32) -> NodeId {
        self.same_shape(Op::Dropout { probability }, input)
    }

    /// Sum of two values.
    ///
    /// # Errors
    /// If rows or channels differ.
    pub fn add(&mut self, name: &str, left: NodeId, right: NodeId) -> Result<NodeId, Error> {
        let (a, b) = (self.node(left), self.node(right));
        if (a.channels, a.domain) != (b.channels, b.domain) {
            let problem = format!("adds {} channels to {}, or other rows", b.channels, a.channels);
            return Err(Error::network(name, problem));
        }
        let (channels, domain) = (a.channels, a.domain);
        Ok(self.push(name, Op::Add, vec![left, right], channels, domain))
    }

    /// Channels side by side.
    ///
    /// # Errors
    /// If there is nothing, or rows differ.
    pub fn concatenate(&mut self, name: &str, inputs: &[NodeId]) -> Result<NodeId, Error> {
        let domains: Vec<usize> = inputs.iter().map(|&input| self.node(input).domain).collect();
        let Some((&domain, rest)) = domains.split_first() else {
            return Err(Error::network(name, "concatenates nothing"));
        };
        if rest.iter().any(|&other| other != domain) {
            return Err(Error::network(name, "concatenates values of different rows"));
        }
        let channels = inputs.iter().map(|&input| self.channels(input)).sum();
        Ok(self.push(name, Op::Concatenate, inputs.to_vec(), channels, domain))
    }

    /// Rows of the domain that a map leads to, as weighted sums.
    ///
    /// # Errors
    /// If the input's rows are not those that the map comes from.
    pub fn combine(&mut self, name: &str, input: NodeId, map: MapSpec) -> Result<NodeId, Error> {
        if has_runs(map) {
            return Err(Error::network(name, format!("{map:?} has no weights")));
        }
        let (from, to) = ends(name, map)?;
        self.expect_domain(name, input, from)?;
        let (map, domain, channels) = (self.map(map), self.domain(to), self.channels(input));
        Ok(self.push(name, Op::Combine { map }, vec![input], channels, domain))
    }

    /// Maximum over the runs of a map.
    ///
    /// # Errors
    /// If the map has no runs, or the input's rows are not those that it comes from.
    pub fn max_pool(&mut self, name: &str, input: NodeId, map: MapSpec) -> Result<NodeId, Error> {
        if !has_runs(map) {
            return Err(Error::network(name, format!("cannot pool over {map:?}")));
        }
        let (from, to) = ends(name, map)?;
        self.expect_domain(name, input, from)?;
        let (map, domain, channels) = (self.map(map), self.domain(to), self.channels(input));
        Ok(self.push(name, Op::MaxPool { map }, vec![input], channels, domain))
    }

    /// Channels of a node's value.
    pub fn channels(&self, node: NodeId) -> usize {
        self.node(node).channels
    }

    /// The graph that gives these values.
    ///
    /// # Errors
    /// If there are none, two parameters have one name, there are more than
    /// [`MAX_PARAMETERS`](super::MAX_PARAMETERS) values to learn, or a probability or slope is out of bounds.
    pub fn finish(mut self, outputs: &[NodeId]) -> Result<Graph, Error> {
        self.graph.outputs = outputs.to_vec();
        check::graph(&self.graph)?;
        Ok(self.graph)
    }

    fn node(&self, id: NodeId) -> &Node {
        &self.graph.nodes[id.0]
    }

    fn same_shape(&mut self, op: Op, input: NodeId) -> NodeId {
        let node = self.node(input);
        let (name, channels, domain) = (node.name.clone(), node.channels, node.domain);
        self.push(&name, op, vec![input], channels, domain)
    }

    fn push(
        &mut self,
        name: &str,
        op: Op,
        inputs: Vec<NodeId>,
        channels: usize,
        domain: usize,
    ) -> NodeId {
        self.graph.nodes.push(Node { name: name.into(), op, inputs, channels, domain });
        NodeId(self.graph.nodes.len() - 1)
    }

    fn weight(&mut self, name: String, shape: &[usize], fan_in: usize) -> ParameterId {
        self.parameter(name, shape, Role::Weight { fan_in })
    }

    fn parameter(&mut self, name: String, shape: &[usize], role: Role) -> ParameterId {
        self.graph.parameters.push(ParameterSpec { name, shape: shape.to_vec(), role });
        ParameterId(self.graph.parameters.len() - 1)
    }

    fn domain(&mut self, domain: Domain) -> usize {
        place_of(&mut self.graph.domains, domain)
    }

    fn map(&mut self, spec: MapSpec) -> MapId {
        MapId(place_of(&mut self.graph.maps, spec))
    }

    fn expect_domain(&self, name: &str, input: NodeId, expected: Domain) -> Result<(), Error> {
        let found = self.graph.domains[self.node(input).domain];
        if found == expected {
            return Ok(());
        }
        Err(Error::network(name, format!("needs a value on {expected:?}, not on {found:?}")))
    }
}

/// Whether a map is of runs of rows, rather than of weighted rows.
fn has_runs(map: MapSpec) -> bool {
    matches!(map, MapSpec::Items(_) | MapSpec::Neighbours { .. })
}

/// Where a map comes from and leads to.
fn ends(name: &str, map: MapSpec) -> Result<(Domain, Domain), Error> {
    Ok(match map {
        MapSpec::Slice => (Domain::Voxels { stride: 1 }, Domain::Points),
        MapSpec::Items(domain) | MapSpec::Means(domain) => (domain, Domain::Items),
        MapSpec::Group { level, scale } if level > 0 => {
            (Domain::samples(level - 1), Domain::Groups { level, scale })
        }
        MapSpec::Neighbours { level, scale } => {
            (Domain::Groups { level, scale }, Domain::samples(level))
        }
        MapSpec::Interpolate { level } if level > 0 => {
            (Domain::samples(level), Domain::samples(level - 1))
        }
        _ => return Err(Error::network(name, format!("{map:?} is not a map between rows"))),
    })
}

fn place_of<T: PartialEq>(list: &mut Vec<T>, item: T) -> usize {
    list.iter().position(|have| *have == item).unwrap_or_else(|| {
        list.push(item);
        list.len() - 1
    })
}
