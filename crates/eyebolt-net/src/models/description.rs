//! `model.toml`: all that is needed to use weights.

use super::{MinkEncoder, MinkUNet, PointNet2};
use crate::graph::{Domain, Source};
use crate::{Error, Graph};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

pub(super) const FILE: &str = "model.toml";

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
    /// Whether it is on images.
    pub fn is_flat(&self) -> bool {
        match self {
            Self::Minkunet(net) => net.flat,
            Self::MinkunetRegression(net) => net.flat,
            Self::Pointnet2(_) => false,
        }
    }

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
    /// Edge of a voxel; of networks on voxels, and of no others.
    pub voxel_m: Option<f32>,
    /// Columns that images are thinned to; of [flat](crate::coordinates::Kernel::flat) networks, and of
    /// no others.
    pub image_columns: Option<u32>,
    /// Edge of the cube that the network sees, around a place in it; of networks that see a whole frame, none.
    pub window_m: Option<f32>,
    /// Names of the features, one for each input channel.
    pub features: Vec<String>,
    /// Names of the classes or other outputs, one for each output channel.
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
        for (field, length) in [("voxel_m", found.voxel_m), ("window_m", found.window_m)] {
            if let Some(length) = length.filter(|length| !(length.is_finite() && *length > 0.0)) {
                return Err(Error::file(FILE, field, format!("{length} is not a positive length")));
            }
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

    /// The graph of the architecture, if everything else is said of that one.
    ///
    /// # Errors
    /// If the architecture makes no network, there is not one name for each channel in and out, or
    /// `voxel_m` or `image_columns` is missing of a network on voxels or images, or there for another.
    pub fn graph(&self) -> Result<Graph, Error> {
        let graph = self.architecture.graph()?;
        let features = graph.inputs().filter(|(.., source)| *source == Source::Features);
        let inputs = features.map(|(_, node, _)| node.channels).sum();
        check_names("features", self.features.len(), inputs)?;
        let outputs = graph.outputs().iter().map(|id| graph.nodes()[id.index()].channels).sum();
        check_names("classes", self.classes.len(), outputs)?;
        let flat = self.architecture.is_flat();
        let on_cells = graph.domains().iter().any(|it| matches!(it, Domain::Voxels { .. }));
        let on_voxels = on_cells && !flat;
        match self.image_columns {
            None | Some(0) if flat => {
                let problem = "missing; say how many columns images are thinned to";
                return Err(Error::file(FILE, "image_columns", problem));
            }
            Some(_) if !flat => {
                let problem = "the network is not on images; leave it out";
                return Err(Error::file(FILE, "image_columns", problem));
            }
            _ => {}
        }
        match self.voxel_m {
            None if on_voxels => {
                Err(Error::file(FILE, "voxel_m", "missing; say how large voxels are"))
            }
            Some(_) if !on_voxels => Err(Error::file(
                FILE,
                "voxel_m",
                "the network is on points or images; leave it out",
            )),
            _ => Ok(graph),
        }
    }
}

fn check_names(field: &str, names: usize, channels: usize) -> Result<(), Error> {
    if names == channels {
        return Ok(());
    }
    Err(Error::file(FILE, field, format!("{names} names for the network's {channels} channels")))
}
