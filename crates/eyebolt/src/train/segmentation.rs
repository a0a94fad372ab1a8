//! Learning which pixels are the arm.

use super::error::TrainError;
use super::lesson::Lesson;
use super::scores::Confusion;
use super::shot::{Cast, Framing, IGNORE, Shot};
use crate::segment::{END_EFFECTOR, FEATURES, features};
use eyebolt_net::losses::{Loss, cross_entropy, lovasz_softmax};
use eyebolt_net::models::{Architecture, MinkUNet, ModelDescription};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix, Parameters};
use eyebolt_render::Random;
use std::collections::BTreeMap;

/// Networks that tell arm and end-effector from the rest.
pub struct SegmentationLesson {
    /// Whose images.
    pub cast: Cast,
    /// What images are like.
    pub framing: Framing,
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
}

/// The label that losses leave out.
const IGNORED: u32 = IGNORE as u32;
/// Streams of random numbers: images to learn from, and others.
const LEARN: u64 = 1;
const VALIDATE: u64 = 2;

impl SegmentationLesson {
    /// Of `cast`, by `net`, whose outputs are background, arm and, if there are three, the end-effector.
    ///
    /// # Errors
    ///
    /// The network is none.
    pub fn new(cast: Cast, framing: Framing, net: MinkUNet, seed: u64) -> Result<Self, TrainError> {
        let graph = net.graph()?;
        let names = ["background", "arm", "end_effector"];
        let classes = names[..net.outputs.min(3)].iter().map(|name| (*name).to_owned()).collect();
        let (images, validation, trained_on) = (4, 64, String::new());
        Ok(Self { cast, framing, images, seed, validation, trained_on, net, classes, graph })
    }

    fn shot(&self, stream: u64, index: u64) -> Result<Shot, TrainError> {
        let mut shot = self.cast.shot(Random::new(self.seed).at(stream).at(index), self.framing)?;
        if self.classes.len() < 3 {
            shot.label
                .iter_mut()
                .filter(|label| **label == END_EFFECTOR)
                .for_each(|label| *label = 1);
        }
        Ok(shot)
    }
}

/// Images as a network takes them, and the labels of its rows.
pub fn batch_of(graph: &Graph, shots: &[Shot]) -> Result<(Batch, Vec<u32>), TrainError> {
    let (mut values, mut pixels, mut labels) = (Vec::new(), Vec::new(), Vec::new());
    for shot in shots {
        values.extend(features(&shot.image));
        let width = shot.image.width;
        let place = |at: usize| [(at % width) as u32, (at / width) as u32];
        pixels.push(shot.image.seen().map(place).collect::<Vec<[u32; 2]>>());
        labels.extend(shot.image.seen().map(|at| u32::from(shot.label[at])));
    }
    let features = Matrix::new(labels.len(), FEATURES.len(), values)?;
    let pixels: Vec<&[[u32; 2]]> = pixels.iter().map(Vec::as_slice).collect();
    Ok((Batch::from_images(graph, &pixels, &features)?, labels))
}

impl Lesson for SegmentationLesson {
    type Target = Vec<u32>;

    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn description(&self) -> ModelDescription {
        ModelDescription {
            voxel_m: None,
            image_columns: Some(self.framing.columns as u32),
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
        let shots = (0..self.images).map(|image| self.shot(LEARN, step * self.images + image));
        batch_of(&self.graph, &shots.collect::<Result<Vec<_>, _>>()?)
    }

    fn loss(&self, outputs: &[Matrix], labels: &Vec<u32>) -> Result<Vec<Loss>, eyebolt_net::Error> {
        let cross = cross_entropy(&outputs[0], labels, IGNORED, None)?;
        let jaccard = lovasz_softmax(&outputs[0], labels, IGNORED)?;
        Ok(vec![cross.plus(&jaccard)])
    }

    fn validate(
        &self,
        parameters: &Parameters,
        executor: &mut Cpu,
    ) -> Result<(BTreeMap<String, f64>, f64), TrainError> {
        let mut confusion = Confusion::new(self.classes.len());
        for index in 0..self.validation {
            let shot = self.shot(VALIDATE, index)?;
            let (batch, labels) = batch_of(&self.graph, std::slice::from_ref(&shot))?;
            let outputs = executor.infer(&self.graph, parameters, &batch)?;
            let narrow = |labels: Vec<u32>| labels.into_iter().map(|label| label as u8).collect();
            let found: Vec<u8> = narrow(outputs[0].argmax());
            confusion.add(&narrow(labels), &found);
        }
        Ok((confusion.named(&self.classes), confusion.mean_iou()))
    }
}
