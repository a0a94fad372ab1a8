//! Adding operations one after the other, with shapes checked on the way.

use super::check;
use super::domain::{Domain, MapSpec, SampleLevel, Source};
use super::ids::{MapId, NodeId, ParameterId};
use super::network::{Graph, Node};
use super::op::{BatchNorm, Op};
use super::parameter::{ParameterSpec, Role};
use crate::Error;
use crate::coordinates::KernelSpec;

/// Makes a [`Graph`]. Every method adds one operation and gives the node of its value.
///
/// A residual block, half the resolution and back, a skip connection, and logits of every point:
///
/// ```
/// use eyebolt_net::coordinates::{Kernel, KernelSpec};
/// use eyebolt_net::graph::{Domain, GraphBuilder, Source};
/// use eyebolt_net::{Batch, Cpu, Executor, Matrix, Parameters};
///
/// # fn main() -> Result<(), eyebolt_net::Error> {
/// let mut g = GraphBuilder::new();
/// let features = g.input(Source::Features, Domain::Voxels { stride: 1 }, 3);
/// let three = KernelSpec::within(Kernel::new(3), 1);
///
/// let stem = g.convolution("stem", features, three, 16, false)?;
/// let stem = g.batch_norm("stem.norm", stem);
/// let stem = g.relu(stem);
///
/// let x = g.convolution("residual", stem, three, 16, true)?;
/// let x = g.add("sum", x, stem)?;
/// let skip = g.relu(x);
///
/// let x = g.convolution("down", skip, KernelSpec::down(2, 1, 2), 32, true)?;
/// let x = g.relu(x);
/// let x = g.convolution("up", x, KernelSpec::up(2, 2, 2), 16, true)?;
/// let x = g.concatenate("skip", &[x, skip])?;
///
/// let x = g.linear("logits", x, 5, true);
/// let logits = g.slice("slice", x)?;
/// let graph = g.finish(&[logits])?;
///
/// let coordinates = [[0, 0, 0, 0], [0, 0, 1, 0], [0, 0, 1, 0], [0, 7, 2, 3]];
/// let batch = Batch::from_voxels(&graph, &coordinates, &Matrix::zeros(4, 3))?;
/// let parameters = Parameters::initial(&graph, 1);
/// let logits = Cpu::new().infer(&graph, &parameters, &batch)?;
/// assert_eq!((logits[0].rows(), logits[0].channels()), (4, 5));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Default)]
pub struct GraphBuilder {
    pub(super) graph: Graph,
    flat: bool,
}

impl GraphBuilder {
    /// Of a network on voxels or points.
    pub fn new() -> Self {
        Self::default()
    }

    /// Of a network that samples points as these levels say.
    pub fn with_sampling(levels: Vec<SampleLevel>) -> Self {
        Self { graph: Graph { sampling: levels, ..Graph::default() }, flat: false }
    }

    /// Of a network on images: every kernel is [flat](crate::coordinates::Kernel::flat), and pixels are
    /// voxels with z = 0.
    pub fn in_plane() -> Self {
        Self { flat: true, ..Self::default() }
    }

    /// Values from outside.
    pub fn input(&mut self, source: Source, domain: Domain, channels: usize) -> NodeId {
        let domain = self.domain(domain);
        self.push("input", Op::Input(source), vec![], channels, domain)
    }

    /// A convolution; `name.kernel` and `name.bias` are its parameters. Within one resolution where
    /// `spec.from == spec.to`, strided where `from < to`, transposed where `from > to`.
    ///
    /// # Errors
    /// If there can be no such convolution, or `input` does not live on the voxels that it comes
    /// from.
    #[doc(alias = "MinkowskiConvolution")]
    #[doc(alias = "MinkowskiConvolutionTranspose")]
    #[doc(alias = "Conv3d")]
    pub fn convolution(
        &mut self,
        name: &str,
        input: NodeId,
        spec: KernelSpec,
        channels: usize,
        bias: bool,
    ) -> Result<NodeId, Error> {
        let spec = if self.flat { spec.in_plane() } else { spec };
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
    #[doc(alias = "MinkowskiLinear")]
    #[doc(alias = "Conv1d")]
    #[doc(alias = "shared MLP")]
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
    #[doc(alias = "MinkowskiBatchNorm")]
    #[doc(alias = "BatchNorm1d")]
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
    #[doc(alias = "MinkowskiReLU")]
    pub fn relu(&mut self, input: NodeId) -> NodeId {
        self.same_shape(Op::Activation { slope: 0.0 }, input)
    }

    /// Leaky ReLU.
    #[doc(alias = "MinkowskiLeakyReLU")]
    pub fn leaky_relu(&mut self, input: NodeId, slope: f32) -> NodeId {
        self.same_shape(Op::Activation { slope }, input)
    }

    /// Dropout.
    #[doc(alias = "MinkowskiDropout")]
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
    #[doc(alias = "cat")]
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

    pub(super) fn node(&self, id: NodeId) -> &Node {
        &self.graph.nodes[id.0]
    }

    fn same_shape(&mut self, op: Op, input: NodeId) -> NodeId {
        let node = self.node(input);
        let (name, channels, domain) = (node.name.clone(), node.channels, node.domain);
        self.push(&name, op, vec![input], channels, domain)
    }

    pub(super) fn push(
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

    pub(super) fn domain(&mut self, domain: Domain) -> usize {
        place_of(&mut self.graph.domains, domain)
    }

    pub(super) fn map(&mut self, spec: MapSpec) -> MapId {
        MapId(place_of(&mut self.graph.maps, spec))
    }

    pub(super) fn expect_domain(
        &self,
        name: &str,
        input: NodeId,
        expected: Domain,
    ) -> Result<(), Error> {
        let found = self.graph.domains[self.node(input).domain];
        if found == expected {
            return Ok(());
        }
        Err(Error::network(name, format!("needs a value on {expected:?}, not on {found:?}")))
    }
}

fn place_of<T: PartialEq>(list: &mut Vec<T>, item: T) -> usize {
    list.iter().position(|have| *have == item).unwrap_or_else(|| {
        list.push(item);
        list.len() - 1
    })
}
