//! A network with its weights.

use super::description::{FILE, ModelDescription};
use crate::coordinates::voxelise;
use crate::{Batch, Error, Executor, Graph, Matrix, Parameters, Sampling, weights};

/// A network with its weights, ready to be used.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// What it is.
    pub description: ModelDescription,
    /// Its operations.
    pub graph: Graph,
    /// Its weights.
    pub parameters: Parameters,
}

impl Model {
    /// Of weights that are there already.
    ///
    /// # Errors
    /// If the description contradicts itself, as [`ModelDescription::graph`] says, or the
    /// parameters are another network's.
    pub fn new(description: ModelDescription, parameters: Parameters) -> Result<Self, Error> {
        let graph = description.graph()?;
        if !graph.has_parameters(parameters.values()) {
            return Err(Error::input("parameters", "made for another network"));
        }
        Ok(Self { description, graph, parameters })
    }

    /// From the text of `model.toml` and the bytes of `weights.safetensors`.
    ///
    /// # Errors
    /// If either is broken, or they do not belong together: loading is complete or an error.
    pub fn load(description: &str, weight_bytes: &[u8]) -> Result<Self, Error> {
        let description = ModelDescription::from_toml(description)?;
        let graph = description.graph()?;
        let parameters = weights::from_bytes(&graph, weight_bytes)?;
        Ok(Self { description, graph, parameters })
    }

    /// The text of `model.toml` and the bytes of `weights.safetensors`, which [`Model::load`] takes.
    ///
    /// # Errors
    /// If they could not be loaded: the description contradicts itself or is another graph's, or a
    /// weight is not finite.
    pub fn save(&self) -> Result<(String, Vec<u8>), Error> {
        Ok((self.text()?, weights::to_bytes(&self.graph, &self.parameters)?))
    }

    /// As [`Model::save`], with weights of 16 bits, which are half as large.
    ///
    /// # Errors
    /// As [`Model::save`]; or if a weight is beyond 65 504.
    pub fn save_half(&self) -> Result<(String, Vec<u8>), Error> {
        Ok((self.text()?, weights::to_half_bytes(&self.graph, &self.parameters)?))
    }

    fn text(&self) -> Result<String, Error> {
        if self.description.graph()? != self.graph {
            return Err(Error::file(FILE, "architecture", "describes another graph"));
        }
        let text = self.description.to_toml()?;
        // What is written is what is read: `voxel_m`, for one, is checked by reading.
        ModelDescription::from_toml(&text)?;
        Ok(text)
    }

    /// The batch of some clouds, an item each: their points, and one row of features for every
    /// point. Points are in metres for networks on voxels, which are cut here into voxels of
    /// `voxel_m`; in the unit of the network's radii for networks on points, which are sampled each
    /// the farthest from those before.
    ///
    /// # Errors
    /// If a cloud is empty or has not as many rows of features as points, or as
    /// [`Batch::from_voxels`] and [`Batch::from_points`].
    pub fn batch(&self, clouds: &[(&[[f32; 3]], &Matrix)]) -> Result<Batch, Error> {
        let features = stacked(clouds)?;
        if let Some(voxel_m) = self.description.voxel_m {
            let mut coordinates = Vec::new();
            for (item, (points_m, _)) in clouds.iter().enumerate() {
                let many = |_| Error::input("clouds", format!("{} are too many", clouds.len()));
                let item = u16::try_from(item).map_err(many)?;
                coordinates.extend(voxelise(item, points_m, voxel_m)?);
            }
            return Batch::from_voxels(&self.graph, &coordinates, &features);
        }
        let points: Vec<[f32; 3]> =
            clouds.iter().flat_map(|(points, _)| *points).copied().collect();
        let sizes: Vec<usize> = clouds.iter().map(|(points, _)| points.len()).collect();
        Batch::from_points(&self.graph, &points, &sizes, &features, Sampling::Farthest)
    }

    /// The outputs for one cloud, as [`Model::batch`] takes it: a row for every point of
    /// segmentations, a single one of classifications and regressions.
    ///
    /// # Errors
    /// As [`Model::batch`] and [`Executor::infer`].
    pub fn infer(
        &self,
        executor: &mut dyn Executor,
        points: &[[f32; 3]],
        features: &Matrix,
    ) -> Result<Matrix, Error> {
        let batch = self.batch(&[(points, features)])?;
        let outputs = executor.infer(&self.graph, &self.parameters, &batch)?;
        let first = outputs.into_iter().next();
        first.ok_or_else(|| Error::network("outputs", "the network has none"))
    }
}

/// The features of all clouds, one after the other.
fn stacked(clouds: &[(&[[f32; 3]], &Matrix)]) -> Result<Matrix, Error> {
    let channels = clouds.first().map_or(0, |(_, features)| features.channels());
    let mut values = Vec::new();
    for (item, (points, features)) in clouds.iter().enumerate() {
        let (rows, width) = (features.rows(), features.channels());
        if points.is_empty() || rows != points.len() || width != channels {
            let problem = format!(
                "cloud {item}: {rows} rows of {width} features for {} points; there must be one of \
                 {channels} for each of at least one point",
                points.len()
            );
            return Err(Error::input("clouds", problem));
        }
        values.extend_from_slice(features.values());
    }
    let rows = clouds.iter().map(|(points, _)| points.len()).sum();
    Matrix::new(rows, channels, values)
}
