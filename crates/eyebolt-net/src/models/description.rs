//! `model.toml`: all that is needed to use weights.

use super::{MinkEncoder, MinkUNet, PointNet2};
use crate::{Error, Graph, Parameters, weights};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

const FILE: &str = "model.toml";

/// Which network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Architecture {
    /// Logits of every point by its voxel.
    Minkunet(MinkUNet),
    /// The encoder of a MinkUNet, then linear layers: numbers of every item.
    MinkunetRegression(MinkEncoder),
    /// PointNet++.
    Pointnet2(PointNet2),
}

impl Architecture {
    /// Its graph.
    ///
    /// # Errors
    /// If the description makes no network.
    pub fn graph(&self) -> Result<Graph, Error> {
        match self {
            Self::Minkunet(net) => net.graph(),
            Self::MinkunetRegression(net) => net.graph(),
            Self::Pointnet2(net) => net.graph(),
        }
    }
}

/// What a model is and where it comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelDescription {
    /// Edge of a voxel; none of networks on points.
    pub voxel_m: Option<f32>,
    /// Names of the features, one for each input channel.
    pub features: Vec<String>,
    /// Names of the classes or other outputs.
    pub classes: Vec<String>,
    /// The frame that coordinates are in.
    pub frame: String,
    /// What it learned from.
    pub trained_on: String,
    /// Of the program that trained it.
    pub commit: String,
    /// By name.
    pub metrics: BTreeMap<String, f64>,
    /// Which network.
    pub architecture: Architecture,
}

impl ModelDescription {
    /// From the text of a `model.toml`.
    ///
    /// # Errors
    /// Where the text says something else or not enough, by line.
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        let found: Self = toml::from_str(text)
            .map_err(|error| Error::file(FILE, "content", error.to_string()))?;
        if let Some(voxel_m) = found.voxel_m.filter(|edge| !(edge.is_finite() && *edge > 0.0)) {
            return Err(Error::file(
                FILE,
                "voxel_m",
                format!("{voxel_m} is not a positive length"),
            ));
        }
        Ok(found)
    }

    /// The text of a `model.toml`.
    ///
    /// # Errors
    /// If a number cannot be written.
    pub fn to_toml(&self) -> Result<String, Error> {
        toml::to_string(self).map_err(|error| Error::file(FILE, "content", error.to_string()))
    }
}

/// A network with its weights, ready to be used.
#[derive(Clone, Debug)]
pub struct Model {
    /// What it is.
    pub description: ModelDescription,
    /// Its operations.
    pub graph: Graph,
    /// Its weights.
    pub parameters: Parameters,
}

impl Model {
    /// From the text of `model.toml` and the bytes of `weights.safetensors`.
    ///
    /// # Errors
    /// If either is broken, or they do not belong together: loading is complete or an error.
    pub fn load(description: &str, weight_bytes: &[u8]) -> Result<Self, Error> {
        let description = ModelDescription::from_toml(description)?;
        let graph = description.architecture.graph()?;
        let channels = graph.inputs().find_map(|(_, node, source)| {
            (source == crate::graph::Source::Features).then_some(node.channels)
        });
        if channels != Some(description.features.len()) {
            let problem = format!("{} names for {channels:?} channels", description.features.len());
            return Err(Error::file(FILE, "features", problem));
        }
        let parameters = weights::from_bytes(&graph, weight_bytes)?;
        Ok(Self { description, graph, parameters })
    }
}
