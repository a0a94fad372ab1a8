//! From a depth image to labels of its pixels.

use super::classes::{ARM, BACKGROUND, END_EFFECTOR, UNKNOWN};
use super::cluster::{ARM_LINKAGE_M, END_EFFECTOR_LINKAGE_M, keep_largest_cluster};
use super::end_effector_net::EndEffectorNet;
use super::error::SegmentError;
use super::features::FEATURES;
use super::grid::Grid;
use super::thinned::Thinned;
use super::upsample::upsample;
use eyebolt_geometry::{DepthImage, PinholeCamera, RayTable};
use eyebolt_net::models::{Architecture, Model};
use eyebolt_net::{Cpu, Executor};

/// A network that tells the arm from the rest.
#[derive(Debug)]
pub struct Segmenter {
    model: Model,
    executor: Cpu,
    grid: Grid,
    end_effector: Option<EndEffectorNet>,
    /// Of the last camera: it is mostly the same.
    rays: Option<(PinholeCamera, RayTable)>,
}

/// Labels of an image.
#[derive(Clone, Debug, PartialEq)]
pub struct Segmentation {
    /// Pixels in a row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Of each pixel: [`BACKGROUND`], [`ARM`], [`END_EFFECTOR`] or [`UNKNOWN`].
    pub label: Vec<u8>,
}

impl Segmenter {
    /// From the text of a `model.toml` and the bytes of its weights.
    ///
    /// # Errors
    ///
    /// Broken files, or a model of something else.
    pub fn load(description: &str, weights: &[u8]) -> Result<Self, SegmentError> {
        Self::new(Model::load(description, weights)?)
    }

    /// Of a model that is there already.
    ///
    /// # Errors
    ///
    /// It is a model of something else.
    pub fn new(model: Model) -> Result<Self, SegmentError> {
        let about = &model.description;
        let other = |field, problem: String| Err(SegmentError::OtherModel { field, problem });
        let Some(grid) = Grid::of(about) else {
            return other("image_columns", "the model is neither on images nor on voxels".into());
        };
        if about.features != FEATURES {
            return other("features", format!("{:?} are not {FEATURES:?}", about.features));
        }
        let names: Vec<&str> = about.classes.iter().map(String::as_str).collect();
        let right = matches!(about.architecture, Architecture::Minkunet(_))
            && matches!(names[..], ["background", "arm"] | ["background", "arm", "end_effector"]);
        if !right {
            return other("classes", format!("{names:?} are not background, arm and end_effector"));
        }
        Ok(Self { model, executor: Cpu::new(), grid, end_effector: None, rays: None })
    }

    /// With a network that looks at the end-effector from near.
    pub fn with_end_effector(self, net: EndEffectorNet) -> Self {
        Self { end_effector: Some(net), ..self }
    }

    /// Whether the end-effector is told apart.
    pub fn tells_end_effector(&self) -> bool {
        self.end_effector.is_some() || self.model.description.classes.len() > 2
    }

    /// Labels of the pixels of `depth`, which `camera` saw.
    ///
    /// # Errors
    ///
    /// Image and camera of different sizes; no memory.
    pub fn segment(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
    ) -> Result<Segmentation, SegmentError> {
        let (found, size) = ((depth.width(), depth.height()), (camera.width(), camera.height()));
        if found != size {
            return Err(SegmentError::Size { found, camera: size });
        }
        let (width, height) = (depth.width() as usize, depth.height() as usize);
        let image = Thinned::new(depth, camera, self.grid.columns());
        let rows: Vec<usize> = image.seen().collect();
        if rows.is_empty() {
            return Ok(Segmentation { width, height, label: vec![UNKNOWN; width * height] });
        }
        let batch = self.grid.batch(&self.model.graph, &[&image])?;
        let Model { graph, parameters, .. } = &self.model;
        let outputs = self.executor.infer(graph, parameters, &batch)?;
        let mut label = vec![UNKNOWN; width * height];
        let all = (&image, rows.as_slice(), &outputs[0]);
        upsample(depth, all, &[0..width, 0..height], &(0.0..f32::INFINITY), &mut label);
        let table = match self.rays.take() {
            Some((of, table)) if of == *camera => table,
            _ => RayTable::new(camera),
        };
        let arm = |label| label == ARM || label == END_EFFECTOR;
        keep_largest_cluster(&mut label, depth, &table, ARM_LINKAGE_M, arm, BACKGROUND);
        let hand = |label| label == END_EFFECTOR;
        keep_largest_cluster(&mut label, depth, &table, END_EFFECTOR_LINKAGE_M, hand, ARM);
        if let Some(net) = &mut self.end_effector {
            net.refine(depth, camera, &table, &mut label)?;
            keep_largest_cluster(&mut label, depth, &table, END_EFFECTOR_LINKAGE_M, hand, ARM);
        }
        self.rays = Some((camera.clone(), table));
        Ok(Segmentation { width, height, label })
    }
}
