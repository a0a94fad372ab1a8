//! What a network is run on: features, and who is whose neighbour.

mod points;
mod voxels;

pub use points::Sampling;

use crate::coordinates::KernelMap;
use crate::graph::{Graph, MapId};
use crate::row_map::{RowMap, Runs};
use crate::{Error, Matrix, Parameters};
use std::sync::Arc;

/// A map of a graph, for the points at hand.
#[derive(Clone, Debug)]
pub(crate) enum Map {
    Kernel(Arc<KernelMap>),
    Rows(Arc<RowMap>),
    Runs(Arc<Runs>),
}

impl Map {
    fn ends(&self) -> (usize, usize) {
        match self {
            Self::Kernel(map) => (map.inputs(), map.outputs()),
            Self::Rows(map) => (map.inputs(), map.outputs()),
            Self::Runs(runs) => (runs.inputs(), runs.len()),
        }
    }
}

/// The inputs of one run of a graph, with everything that follows from where points are. Made once
/// by [`Batch::from_voxels`] or [`Batch::from_points`] and good for any number of runs.
#[derive(Clone, Debug)]
pub struct Batch {
    /// Rows of each of the graph's domains.
    pub(crate) rows: Vec<usize>,
    /// In the graph's order.
    pub(crate) maps: Vec<Map>,
    /// Of the graph's inputs, in its order.
    pub(crate) inputs: Vec<Matrix>,
}

impl Batch {
    /// The values of the graph's inputs.
    pub fn inputs(&self) -> &[Matrix] {
        &self.inputs
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

    /// That it was made for this graph, and the parameters too.
    pub(crate) fn check(&self, graph: &Graph, parameters: &Parameters) -> Result<(), Error> {
        let fits =
            self.rows.len() == graph.domains().len() && self.maps.len() == graph.maps().len();
        if !fits {
            return Err(Error::input("batch", "made for another network"));
        }
        let inputs: Vec<_> = graph.inputs().collect();
        if inputs.len() != self.inputs.len() {
            return Err(Error::input("batch", "made for another network"));
        }
        for ((_, node, source), matrix) in inputs.into_iter().zip(&self.inputs) {
            let expected = (self.rows[node.domain], node.channels);
            if (matrix.rows(), matrix.channels()) != expected {
                let (rows, channels) = (matrix.rows(), matrix.channels());
                let problem = format!(
                    "{source:?}: {rows} rows of {channels} channels; the network takes {} of {}",
                    expected.0, expected.1
                );
                return Err(Error::input("batch", problem));
            }
        }
        let lengths = parameters.values().iter().map(Vec::len);
        if !lengths.eq(graph.parameters().iter().map(|spec| spec.len())) {
            return Err(Error::input("parameters", "made for another network"));
        }
        self.check_maps(graph)
    }

    /// That every operation's map leads from its input's rows to its own.
    fn check_maps(&self, graph: &Graph) -> Result<(), Error> {
        use crate::graph::Op;
        for node in graph.nodes() {
            let map = match node.op {
                Op::Convolution { map: Some(map), .. } => map,
                Op::Combine { map } | Op::MaxPool { map } => map,
                _ => continue,
            };
            let from = graph.nodes()[node.inputs[0].0].domain;
            if self.maps[map.0].ends() != (self.rows[from], self.rows[node.domain]) {
                return Err(Error::input(
                    "batch",
                    format!("{}: made for another network", node.name),
                ));
            }
        }
        Ok(())
    }
}
