//! A batch as it is handed to an executor.

use crate::coordinates::KernelMap;
use crate::graph::{Domain, Graph, MapId, MapSpec, Node, SampleLevel, Source};
use crate::row_map::{RowMap, Runs};
use crate::{Error, Matrix, identity};
use std::sync::Arc;

/// A map of a graph, for the points at hand.
#[derive(Clone, Debug)]
pub enum Map {
    /// Of a [`MapSpec::Kernel`].
    Kernel(Arc<KernelMap>),
    /// Weighted sums of rows.
    Rows(Arc<RowMap>),
    /// Rows to take the largest of.
    Runs(Arc<Runs>),
}

/// The inputs of one run of a graph, with everything that follows from where points are. Made once
/// by [`Batch::from_voxels`] or [`Batch::from_points`] and good for any number of runs.
#[derive(Clone, Debug)]
pub struct Batch {
    id: u64,
    made_for: Shape,
    rows: Vec<usize>,
    maps: Vec<Map>,
    inputs: Vec<Matrix>,
}

/// What a graph asks of a batch.
#[derive(Clone, Debug, PartialEq)]
struct Shape {
    domains: Vec<Domain>,
    maps: Vec<MapSpec>,
    sampling: Vec<SampleLevel>,
    inputs: Vec<(Source, usize)>,
}

impl Shape {
    fn of(graph: &Graph) -> Self {
        Self {
            domains: graph.domains().to_vec(),
            maps: graph.maps().to_vec(),
            sampling: graph.sampling().to_vec(),
            inputs: graph.inputs().map(|(_, node, source)| (source, node.channels)).collect(),
        }
    }
}

impl Batch {
    /// Rows of each domain, each map and each input of a graph, in its order.
    pub(super) fn new(
        graph: &Graph,
        rows: Vec<usize>,
        maps: Vec<Map>,
        inputs: Vec<Matrix>,
    ) -> Self {
        Self { id: identity::fresh(), made_for: Shape::of(graph), rows, maps, inputs }
    }

    /// The same number for this and its clones, another for every other batch.
    pub fn id(&self) -> u64 {
        self.id
    }

    /// Number of rows of each of the graph's [domains](Graph::domains), in its order.
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// The graph's [maps](Graph::maps), in its order.
    pub fn maps(&self) -> &[Map] {
        &self.maps
    }

    /// The values of the graph's [inputs](Graph::inputs), in its order.
    pub fn inputs(&self) -> &[Matrix] {
        &self.inputs
    }

    /// Whether it was made for this graph, or for one that asks for the same neighbours.
    pub fn is_for(&self, graph: &Graph) -> bool {
        self.made_for == Shape::of(graph)
    }

    pub(crate) fn kernel(&self, map: MapId) -> Result<&KernelMap, Error> {
        match &self.maps[map.0] {
            Map::Kernel(map) => Ok(map),
            _ => Err(Error::network("map", "a convolution needs a kernel map")),
        }
    }

    pub(crate) fn row_map(&self, map: MapId) -> Result<&RowMap, Error> {
        match &self.maps[map.0] {
            Map::Rows(map) => Ok(map),
            _ => Err(Error::network("map", "a combination needs a map of rows")),
        }
    }

    pub(crate) fn runs(&self, map: MapId) -> Result<&Runs, Error> {
        match &self.maps[map.0] {
            Map::Runs(map) => Ok(map),
            _ => Err(Error::network("map", "a pool needs runs")),
        }
    }
}

/// The features of the rows of a domain, as an input takes them.
pub(super) fn features_for(
    graph: &Graph,
    input: &Node,
    domain: Domain,
    features: &Matrix,
) -> Result<Matrix, Error> {
    let asked = graph.domains()[input.domain];
    if asked != domain {
        let problem = format!("takes features on {asked:?}; there are only those on {domain:?}");
        return Err(Error::network(&input.name, problem));
    }
    let (have, wanted) = (features.channels(), input.channels);
    if have != wanted {
        return Err(Error::input(
            "features",
            format!("{have} channels; the network takes {wanted}"),
        ));
    }
    Ok(features.clone())
}
