//! From a depth image to labels of its pixels.

use super::classes::{ARM, BACKGROUND, CLASSES, END_EFFECTOR};
use super::cluster::{
    ARM_LINKAGE_M, Cluster, END_EFFECTOR_LINKAGE_M, clusters_by_area, keep_largest_cluster,
};
use super::end_effector_net::EndEffectorNet;
use super::error::SegmentError;
use super::features::FEATURES;
use super::grid::Grid;
use super::second_opinion::SecondOpinion;
use super::thinned::Thinned;
use super::told::Told;
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
    second: Option<SecondOpinion>,
    end_effector: Option<EndEffectorNet>,
    tells_probability: bool,
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
    /// Of each pixel: [`BACKGROUND`], [`ARM`], [`END_EFFECTOR`] or [`UNKNOWN`](super::UNKNOWN).
    pub label: Vec<u8>,
    /// The same by the networks of whole frames alone.
    pub whole: Vec<u8>,
    /// Of each pixel the probability of every class, by the network that looked from nearest, 0 where there is no depth; empty unless
    /// [`Segmenter::with_probabilities`] asked for it.
    pub probability: Vec<[f32; CLASSES.len()]>,
}

impl Segmentation {
    fn new(of: &DepthImage, told: Told, whole: Vec<u8>) -> Self {
        let Told { label, probability } = told;
        Self { width: of.width() as usize, height: of.height() as usize, label, whole, probability }
    }

    /// How likely the networks take it that pixel `at` is what its label says, 0 to 1; `None` where nobody asked, or there is no depth.
    pub fn probability_of_label(&self, at: usize) -> Option<f32> {
        let class = usize::from(*self.label.get(at)?);
        self.probability.get(at)?.get(class).copied()
    }
}

/// An arm may be among so many of the largest things that look like parts of one.
const CLUSTERS: usize = 3;

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
        Ok(Self {
            model,
            executor: Cpu::new(),
            grid,
            second: None,
            end_effector: None,
            tells_probability: false,
            rays: None,
        })
    }

    /// Which also asks `model`, a network that knows arms in general and tells them from the rest: a pixel is as likely of the arm as the surer
    /// one of the two says. One that sees images otherwise is not asked.
    pub fn with_second_opinion(self, model: Model) -> Self {
        Self { second: SecondOpinion::new(model, self.grid), ..self }
    }

    /// With a network that looks at the end-effector from near.
    pub fn with_end_effector(self, net: EndEffectorNet) -> Self {
        Self { end_effector: Some(net), ..self }
    }

    /// Which also tells how likely each class is.
    pub fn with_probabilities(self) -> Self {
        Self { tells_probability: true, ..self }
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
        let (mut told, table) = self.whole(depth, camera)?;
        let whole = told.label.clone();
        keep_largest_cluster(&mut told.label, depth, &table, ARM_LINKAGE_M, is_arm, BACKGROUND);
        keep_largest_hand(&mut told.label, depth, &table);
        if let Some(net) = &mut self.end_effector {
            net.refine(depth, camera, &table, &mut told)?;
            keep_largest_hand(&mut told.label, depth, &table);
        }
        self.rays = Some((camera.clone(), table));
        Ok(Segmentation::new(depth, told, whole))
    }

    /// What else the labels may be than the `first`, which [`Self::segment`] has of the same image: with the end-effector elsewhere on the arm, or on something else that looks like a
    /// part of an arm, the likeliest first, `most` at most. None without a network that looks at it from near.
    ///
    /// # Errors
    ///
    /// As [`Self::segment`].
    pub fn alternatives(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        first: &Segmentation,
        most: usize,
    ) -> Result<Vec<Segmentation>, SegmentError> {
        let (whole, table) = (&first.whole, self.rays_of(camera));
        let mut labelled = Vec::new();
        if let Some(net) = &mut self.end_effector {
            let clusters = clusters_by_area(whole, depth, &table, ARM_LINKAGE_M, is_arm);
            let mut found = Vec::new();
            for (rank, cluster) in clusters.iter().take(CLUSTERS).enumerate() {
                let places = net.found(depth, camera, &table, &only(cluster, whole))?;
                // The first of all is what `segment` has.
                found.extend(
                    places.into_iter().skip(usize::from(rank == 0)).map(|it| (cluster, it)),
                );
            }
            found.sort_by(|(_, a), (_, b)| b.area.total_cmp(&a.area));
            for (cluster, place) in found.into_iter().take(most) {
                let mut label = only(cluster, whole);
                label.iter_mut().filter(|label| is_hand(**label)).for_each(|label| *label = ARM);
                let mut told = Told { label, probability: first.probability.clone() };
                net.paint(depth, camera, place, &mut told)?;
                keep_largest_hand(&mut told.label, depth, &table);
                labelled.push(Segmentation::new(depth, told, whole.clone()));
            }
        }
        self.rays = Some((camera.clone(), table));
        Ok(labelled)
    }

    /// The rays of `camera`: of the last one, if it is the same.
    fn rays_of(&mut self, camera: &PinholeCamera) -> RayTable {
        match self.rays.take() {
            Some((of, table)) if of == *camera => table,
            _ => RayTable::new(camera),
        }
    }

    /// What the networks of whole frames alone tell, and the rays of the camera.
    fn whole(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
    ) -> Result<(Told, RayTable), SegmentError> {
        let (found, size) = ((depth.width(), depth.height()), (camera.width(), camera.height()));
        if found != size {
            return Err(SegmentError::Size { found, camera: size });
        }
        let (width, height) = (depth.width() as usize, depth.height() as usize);
        let table = self.rays_of(camera);
        let mut told = Told::nothing(width * height, self.tells_probability);
        let image = Thinned::new(depth, camera, self.grid.columns());
        let rows: Vec<usize> = image.seen().collect();
        if !rows.is_empty() {
            let batch = self.grid.batch(&self.model.graph, &[&image])?;
            let Model { graph, parameters, .. } = &self.model;
            let mut logits = self.executor.infer(graph, parameters, &batch)?.swap_remove(0);
            if let Some(second) = &mut self.second {
                second.raise(self.grid, &image, &mut logits)?;
            }
            let all = (&image, rows.as_slice(), &logits);
            upsample(depth, all, &[0..width, 0..height], &(0.0..f32::INFINITY), &mut told);
        }
        Ok((told, table))
    }
}

/// Leaves of what is labelled the end-effector the largest connected part; the rest is the arm.
fn keep_largest_hand(label: &mut [u8], depth: &DepthImage, rays: &RayTable) {
    keep_largest_cluster(label, depth, rays, END_EFFECTOR_LINKAGE_M, is_hand, ARM);
}

/// The labels of a cluster of the arm, as if nothing else were the arm.
fn only(cluster: &Cluster, whole: &[u8]) -> Vec<u8> {
    let background = |label: &u8| if is_arm(*label) { BACKGROUND } else { *label };
    let mut label: Vec<u8> = whole.iter().map(background).collect();
    cluster.pixels.iter().for_each(|at| label[*at] = whole[*at]);
    label
}

fn is_arm(label: u8) -> bool {
    label == ARM || label == END_EFFECTOR
}

fn is_hand(label: u8) -> bool {
    label == END_EFFECTOR
}
