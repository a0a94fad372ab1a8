//! In which cells a network sees an image.

use super::features::{FEATURES, features};
use super::thinned::Thinned;
use eyebolt_net::coordinates::voxelise;
use eyebolt_net::models::ModelDescription;
use eyebolt_net::{Batch, Error, Graph, Matrix};

/// In which cells a network sees an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grid {
    /// Pixels of an image thinned to about so many columns.
    Image {
        /// Columns.
        columns: usize,
    },
    /// Voxels of this edge, in the camera's frame.
    Voxels {
        /// Edge, metres.
        edge_m: f32,
    },
}

/// Columns of the images whose points fill voxels: of more, decoders of hundreds of channels would not fit
/// into memory while they learn.
const VOXEL_COLUMNS: usize = 320;

impl Grid {
    /// That of a model, if it has one.
    pub fn of(description: &ModelDescription) -> Option<Self> {
        match (description.image_columns, description.voxel_m) {
            (Some(columns), None) => Some(Self::Image { columns: columns as usize }),
            (None, Some(edge_m)) => Some(Self::Voxels { edge_m }),
            _ => None,
        }
    }

    /// Columns that images are thinned to.
    pub fn columns(self) -> usize {
        match self {
            Self::Image { columns } => columns,
            Self::Voxels { .. } => VOXEL_COLUMNS,
        }
    }

    /// `images` as a network takes them, a row for every pixel that has depth.
    ///
    /// # Errors
    ///
    /// Another network, too many images, or none with depth.
    pub fn batch(self, graph: &Graph, images: &[&Thinned]) -> Result<Batch, Error> {
        let values: Vec<f32> = images.iter().flat_map(|image| features(image)).collect();
        let features = Matrix::new(values.len() / FEATURES.len(), FEATURES.len(), values)?;
        match self {
            Self::Image { .. } => {
                let pixels: Vec<Vec<[u32; 2]>> = images
                    .iter()
                    .map(|image| {
                        let place =
                            |at: usize| [(at % image.width) as u32, (at / image.width) as u32];
                        image.seen().map(place).collect()
                    })
                    .collect();
                let pixels: Vec<&[[u32; 2]]> = pixels.iter().map(Vec::as_slice).collect();
                Batch::from_images(graph, &pixels, &features)
            }
            Self::Voxels { edge_m } => {
                let mut coordinates = Vec::new();
                for (image, item) in images.iter().zip(0_u16..) {
                    let points: Vec<[f32; 3]> = image.seen().map(|at| image.point(at)).collect();
                    coordinates.extend(voxelise(item, &points, edge_m)?);
                }
                Batch::from_voxels(graph, &coordinates, &features)
            }
        }
    }
}
