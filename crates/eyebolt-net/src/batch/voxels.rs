//! Batches of voxels.

use super::prepared::{Batch, Map, features_for};
use crate::coordinates::{Neighbours, VoxelSet, average_features};
use crate::graph::{Domain, Graph, MapSpec, Source};
use crate::row_map::{RowMap, Runs};
use crate::{Error, Matrix};
use std::sync::Arc;

impl Batch {
    /// For a graph on voxels: coordinates `[item, x, y, z]` of points and their features, one row
    /// each. Points of the same voxel share it, with the mean of their features.
    ///
    /// # Errors
    /// If there are no points, coordinates are out of bounds, a feature is not finite, there are
    /// not as many features as the graph takes, an item has no point, or the graph needs samples.
    pub fn from_voxels(
        graph: &Graph,
        coordinates: &[[i32; 4]],
        features: &Matrix,
    ) -> Result<Self, Error> {
        let (finest, voxel_of_point) = VoxelSet::new(coordinates)?;
        let means = average_features(features, &voxel_of_point, finest.len())?;
        Self::from_neighbours(graph, &mut Neighbours::new(finest), means, voxel_of_point)
    }

    /// For a [flat](crate::coordinates::Kernel::flat) graph, on images: of each item the pixels `[u, v]`
    /// that saw something, and their features, one row each, item after item.
    ///
    /// # Errors
    /// As [`Batch::from_voxels`]; or if there are too many items, or a pixel is beyond 19 bits.
    pub fn from_images(
        graph: &Graph,
        pixels: &[&[[u32; 2]]],
        features: &Matrix,
    ) -> Result<Self, Error> {
        let mut coordinates = Vec::new();
        for (item, pixels) in pixels.iter().enumerate() {
            let many = |_| Error::input("images", format!("{} are too many", item + 1));
            let item = i32::from(u16::try_from(item).map_err(many)?);
            let far = |_| Error::input("images", "a pixel beyond 31 bits");
            for [u, v] in *pixels {
                let [u, v] = [i32::try_from(*u).map_err(far)?, i32::try_from(*v).map_err(far)?];
                coordinates.push([item, u, v, 0]);
            }
        }
        Self::from_voxels(graph, &coordinates, features)
    }

    /// The same from voxels and maps that are there already: `features` of the finest voxels, one
    /// row each, and the voxel of every point, as [`VoxelSet::new`] gives them.
    ///
    /// # Errors
    /// As [`Batch::from_voxels`]; or if there is not one row for every voxel, or a point is of none.
    pub fn from_neighbours(
        graph: &Graph,
        neighbours: &mut Neighbours,
        features: Matrix,
        voxel_of_point: Vec<u32>,
    ) -> Result<Self, Error> {
        let finest = neighbours.voxels(1)?;
        features.check_finite("features")?;
        if features.rows() != finest.len() {
            let problem = format!("{} rows for {} voxels", features.rows(), finest.len());
            return Err(Error::input("features", problem));
        }
        if let Some(at) = voxel_of_point.iter().position(|&voxel| voxel as usize >= finest.len()) {
            let problem =
                format!("point {at} is in voxel {} of {}", voxel_of_point[at], finest.len());
            return Err(Error::input("voxel_of_point", problem));
        }
        let points = voxel_of_point.len();
        let slice = Arc::new(RowMap::gather(finest.len(), voxel_of_point));
        let items = finest.item_starts().len() - 1;
        let rows = graph.domains().iter().map(|&domain| match domain {
            Domain::Voxels { stride } => Ok(neighbours.voxels(stride)?.len()),
            Domain::Points => Ok(points),
            Domain::Items => Ok(items),
            _ => Err(Error::network("graph", "samples points; use Batch::from_points")),
        });
        let rows: Vec<usize> = rows.collect::<Result<_, Error>>()?;
        let mut maps = Vec::new();
        for &spec in graph.maps() {
            maps.push(match spec {
                MapSpec::Kernel(spec) => Map::Kernel(neighbours.map(spec)?),
                MapSpec::Slice => Map::Rows(slice.clone()),
                MapSpec::Maxima(Domain::Voxels { stride }) => {
                    let voxels = neighbours.voxels(stride)?;
                    Map::Runs(Arc::new(runs(&voxels)?))
                }
                MapSpec::Means(Domain::Voxels { stride }) => {
                    let voxels = neighbours.voxels(stride)?;
                    Map::Rows(Arc::new(RowMap::means(&runs(&voxels)?)))
                }
                _ => return Err(Error::network("graph", format!("{spec:?} is not of voxels"))),
            });
        }
        let sources = graph.inputs().map(|(_, node, source)| match source {
            Source::Features => features_for(graph, node, Domain::Voxels { stride: 1 }, &features),
            Source::Offsets { .. } | Source::Positions { .. } => {
                Err(Error::network("graph", "takes places of points; use Batch::from_points"))
            }
        });
        let inputs = sources.collect::<Result<_, Error>>()?;
        Ok(Self::new(graph, rows, maps, inputs))
    }
}

/// Runs of items, none of which may be empty.
fn runs(voxels: &VoxelSet) -> Result<Runs, Error> {
    let starts = voxels.item_starts();
    if let Some(item) = starts.windows(2).position(|pair| pair[0] == pair[1]) {
        return Err(Error::input("coordinates", format!("item {item} of the batch has no point")));
    }
    Ok(Runs::new(starts.to_vec()))
}
