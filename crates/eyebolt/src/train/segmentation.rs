//! Learning which pixels are the arm.

use super::error::TrainError;
use super::images::Images;
use super::lesson::Lesson;
use super::shot::{Framing, Shot};
use crate::segment::Confusion;
use crate::segment::{ARM, CLASSES, END_EFFECTOR, FEATURES, Grid, Thinned, UNKNOWN};
use eyebolt_net::losses::{Loss, cross_entropy, lovasz_softmax};
use eyebolt_net::models::{Architecture, MinkUNet, ModelDescription};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix, Parameters};
use eyebolt_render::Random;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Networks that tell arm and end-effector from the rest.
pub struct SegmentationLesson {
    /// What it learns from.
    pub source: Images,
    /// In which cells the network sees them.
    pub grid: Grid,
    /// Images of a step.
    pub images: u64,
    /// Of all random choices.
    pub seed: u64,
    /// Images of a validation.
    pub validation: u64,
    /// Said of the model.
    pub trained_on: String,
    net: MinkUNet,
    classes: Vec<String>,
    graph: Graph,
    /// Images of the validations, drawn once.
    held_out: OnceLock<Vec<Shot>>,
}

/// The label that losses leave out.
const IGNORED: u32 = UNKNOWN as u32;
/// Cross-entropy and the Jaccard index in one: every point counts, and every class.
pub(super) fn label_loss(logits: &Matrix, labels: &[u32]) -> Result<Loss, eyebolt_net::Error> {
    let cross = cross_entropy(logits, labels, IGNORED, None)?;
    Ok(cross.plus(&lovasz_softmax(logits, labels, IGNORED)?))
}

/// Streams of random numbers: images to learn from, and others.
const LEARN: u64 = 1;
const VALIDATE: u64 = 2;

impl SegmentationLesson {
    /// Of `source`, by `net`, whose outputs are background, arm and, if there are three, the end-effector.
    ///
    /// # Errors
    ///
    /// The network is none.
    pub fn new(source: Images, grid: Grid, net: MinkUNet, seed: u64) -> Result<Self, TrainError> {
        let graph = net.graph()?;
        let names = &CLASSES[..net.outputs.min(CLASSES.len())];
        let classes = names.iter().map(|name| (*name).to_owned()).collect();
        let (images, validation, trained_on) = (4, 64, String::new());
        Ok(Self {
            source,
            grid,
            images,
            seed,
            validation,
            trained_on,
            net,
            classes,
            graph,
            held_out: OnceLock::new(),
        })
    }

    fn shots(&self, stream: u64, step: u64) -> Result<Vec<Shot>, TrainError> {
        let with_end_effector = self.classes.len() > 2;
        let columns = self.grid.columns();
        let framing = Framing { columns, with_end_effector, ..Framing::ARM };
        let random = Random::new(self.seed).at(stream).at(step);
        let mut shots = self.source.shots(random, self.images, framing)?;
        if self.classes.len() < 3 {
            let labels = shots.iter_mut().flat_map(|shot| &mut shot.label);
            labels.filter(|label| **label == END_EFFECTOR).for_each(|label| *label = ARM);
        }
        Ok(shots)
    }

    fn held_out(&self) -> Result<&[Shot], TrainError> {
        if let Some(shots) = self.held_out.get() {
            return Ok(shots);
        }
        let steps = 0..self.validation.div_ceil(self.images);
        let shots = steps.map(|step| self.shots(VALIDATE, step)).collect::<Result<Vec<_>, _>>()?;
        Ok(self.held_out.get_or_init(|| shots.into_iter().flatten().collect()))
    }

    /// Images as the network takes them, and the labels of its rows.
    fn batch_of(&self, shots: &[Shot]) -> Result<(Batch, Vec<u32>), TrainError> {
        let images: Vec<&Thinned> = shots.iter().map(|shot| &shot.image).collect();
        let label = |shot: &Shot, at: usize| u32::from(shot.label[at]);
        let labels = shots
            .iter()
            .flat_map(|shot| shot.image.seen().map(move |at| label(shot, at)))
            .collect();
        Ok((self.grid.batch(&self.graph, &images)?, labels))
    }
}

impl Lesson for SegmentationLesson {
    type Target = Vec<u32>;

    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn description(&self) -> ModelDescription {
        ModelDescription {
            voxel_m: match self.grid {
                Grid::Voxels { edge_m } => Some(edge_m),
                Grid::Image { .. } => None,
            },
            image_columns: match self.grid {
                Grid::Image { columns } => Some(columns as u32),
                Grid::Voxels { .. } => None,
            },
            window_m: None,
            features: FEATURES.map(str::to_owned).to_vec(),
            classes: self.classes.clone(),
            frame: "camera".into(),
            trained_on: self.trained_on.clone(),
            commit: String::new(),
            metrics: BTreeMap::new(),
            architecture: Architecture::Minkunet(self.net.clone()),
        }
    }

    fn batch(&self, step: u64) -> Result<(Batch, Vec<u32>), TrainError> {
        self.batch_of(&self.shots(LEARN, step)?)
    }

    fn loss(&self, outputs: &[Matrix], labels: &Vec<u32>) -> Result<Vec<Loss>, eyebolt_net::Error> {
        Ok(vec![label_loss(&outputs[0], labels)?])
    }

    fn validate(
        &self,
        parameters: &Parameters,
        executor: &mut Cpu,
    ) -> Result<(BTreeMap<String, f64>, f64), TrainError> {
        let mut confusion = Confusion::new(self.classes.len());
        let mut by_image = Vec::new();
        for shot in self.held_out()? {
            let (batch, labels) = self.batch_of(std::slice::from_ref(shot))?;
            let outputs = executor.infer(&self.graph, parameters, &batch)?;
            let mut own = Confusion::new(self.classes.len());
            own.add_rows(&labels, &outputs[0]);
            by_image.push(own.mean_iou());
            confusion.merge(&own);
        }
        // Of all points together, a single image with something large before the camera decides.
        let value = by_image.iter().sum::<f64>() / by_image.len().max(1) as f64;
        let mut scores = confusion.named(&self.classes);
        scores.insert("mean_iou_by_image".into(), value);
        Ok((scores, value))
    }
}
