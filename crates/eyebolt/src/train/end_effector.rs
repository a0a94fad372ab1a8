//! Learning where an end-effector ends.

use super::error::TrainError;
use super::images::Images;
use super::lesson::Lesson;
use super::segmentation::label_loss;
use super::shot::{At, Framing, Shot};
use crate::segment::Confusion;
use crate::segment::{
    ARM, BACKGROUND, CLASSES, END_EFFECTOR, UNKNOWN, WINDOW_COLUMNS, WINDOW_FEATURES, Window,
    window_batch, window_half_m,
};
use eyebolt_net::losses::Loss;
use eyebolt_net::models::{Architecture, MinkUNet, ModelDescription};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix, Parameters};
use eyebolt_render::Random;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Networks that tell an end-effector from its arm, in windows around it.
pub struct EndEffectorLesson {
    /// Images of the arm.
    pub source: Images,
    /// Images of a step, with two windows in each.
    pub images: u64,
    /// Of all random choices.
    pub seed: u64,
    /// Images of a validation.
    pub validation: u64,
    /// Said of the model.
    pub trained_on: String,
    half_m: f32,
    net: MinkUNet,
    graph: Graph,
    held_out: OnceLock<Vec<Labelled>>,
}

/// A window, and the class of each of its pixels.
struct Labelled {
    window: Window,
    labels: Vec<u32>,
}

const LEARN: u64 = 7;
const VALIDATE: u64 = 8;
/// Windows in each image.
const WINDOWS: u64 = 2;
/// How far their middles are beside that of the end-effector, of half a window and along each axis: as far as
/// a network that sees the whole frame may be off. And how often one is anywhere on the arm.
const OFF: f64 = 0.25;
const ANYWHERE: f64 = 0.15;
/// Share of the steps whose images look at any part of the arm: where it is not known where the end-effector is, it
/// is looked for all along the arm.
const ALONG_THE_ARM: f64 = 0.4;
/// Rooms and cameras that are drawn for a step until something is seen.
const TRIES: u64 = 20;
/// Share of the steps whose images have a room around: it takes longer to draw than all else.
const IN_A_ROOM: f64 = 0.35;

impl EndEffectorLesson {
    /// Of `source`, for an end-effector of this largest extent, by `net` with an output for each of [`CLASSES`].
    ///
    /// # Errors
    ///
    /// The network is none.
    pub fn new(
        source: Images,
        extent_m: f64,
        net: MinkUNet,
        seed: u64,
    ) -> Result<Self, TrainError> {
        let graph = net.graph()?;
        let (images, validation, trained_on) = (6, 96, String::new());
        let (half_m, held_out) = (window_half_m(extent_m), OnceLock::new());
        Ok(Self { source, images, seed, validation, trained_on, half_m, net, graph, held_out })
    }

    /// Windows of a step, at least one: a camera may see nothing of an arm that is before it.
    fn windows(&self, stream: u64, step: u64) -> Result<Vec<Labelled>, TrainError> {
        let first = Random::new(self.seed).at(stream).at(step);
        let others = (0..TRIES).map(|attempt| first.at(3).at(attempt));
        for random in std::iter::once(first).chain(others) {
            let windows = self.windows_of(random)?;
            if !windows.is_empty() {
                return Ok(windows);
            }
        }
        Err(TrainError::NothingToSee { tries: TRIES * self.images })
    }

    fn windows_of(&self, random: Random) -> Result<Vec<Labelled>, TrainError> {
        let room = random.at(0).uniform() < IN_A_ROOM;
        let along = random.at(0).at(1).uniform() < ALONG_THE_ARM;
        let framing = match along {
            true => Framing {
                room,
                at: At::AnyPart,
                with_end_effector: false,
                ..Framing::AT_END_EFFECTOR
            },
            false => Framing { room, ..Framing::AT_END_EFFECTOR },
        };
        let shots = self.source.shots(random.at(1), self.images, framing)?;
        let windows = shots.iter().zip(0..).flat_map(|(shot, image)| {
            let random = random.at(2).at(image);
            (0..WINDOWS).filter_map(move |window| self.window(shot, along, &mut random.at(window)))
        });
        Ok(windows.collect())
    }

    fn window(&self, shot: &Shot, along: bool, random: &mut Random) -> Option<Labelled> {
        let anywhere = along || random.uniform() < ANYWHERE;
        let counts = |label: u8| if anywhere { label != BACKGROUND } else { label == END_EFFECTOR };
        let seen: Vec<usize> = shot.image.seen().filter(|at| counts(shot.label[*at])).collect();
        if seen.is_empty() {
            return None;
        }
        let any = shot.image.point(seen[random.index(seen.len())]);
        let middle = if anywhere { any } else { mean(shot, &seen) };
        let off = OFF * f64::from(self.half_m);
        let middle = middle.map(|value| value + (off * random.normal()) as f32);
        let window = Window::new(&shot.image, middle, self.half_m)?;
        let labels = window.pixels.iter().map(|at| class(shot, *at)).collect();
        Some(Labelled { window, labels })
    }

    fn held_out(&self) -> Result<&[Labelled], TrainError> {
        if let Some(windows) = self.held_out.get() {
            return Ok(windows);
        }
        let steps = 0..self.validation.div_ceil(self.images);
        let windows = steps.map(|step| self.windows(VALIDATE, step));
        let windows = windows.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
        Ok(self.held_out.get_or_init(|| windows))
    }

    fn batch_of(&self, windows: &[Labelled]) -> Result<(Batch, Vec<u32>), TrainError> {
        let labels = windows.iter().flat_map(|window| window.labels.clone()).collect();
        let windows: Vec<&Window> = windows.iter().map(|labelled| &labelled.window).collect();
        Ok((window_batch(&self.graph, &windows)?, labels))
    }
}

/// What is mounted on an arm and in no description is no part of its end-effector, where that is known: it was drawn. In recordings nobody
/// knows what is unknown.
fn class(shot: &Shot, at: usize) -> u32 {
    let label = match shot.label[at] {
        UNKNOWN if shot.drawn => ARM,
        label => label,
    };
    u32::from(label)
}

fn mean(shot: &Shot, pixels: &[usize]) -> [f32; 3] {
    let sum = pixels
        .iter()
        .map(|at| shot.image.point(*at))
        .fold([0.0; 3], |sum, point| [0, 1, 2].map(|axis| sum[axis] + point[axis]));
    sum.map(|value: f32| value / pixels.len() as f32)
}

impl Lesson for EndEffectorLesson {
    type Target = Vec<u32>;

    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn description(&self) -> ModelDescription {
        ModelDescription {
            voxel_m: None,
            image_columns: Some(WINDOW_COLUMNS as u32),
            window_m: Some(2.0 * self.half_m),
            features: WINDOW_FEATURES.map(str::to_owned).to_vec(),
            classes: CLASSES.map(str::to_owned).to_vec(),
            frame: "camera, turned to the middle of the window".into(),
            trained_on: self.trained_on.clone(),
            commit: String::new(),
            metrics: BTreeMap::new(),
            architecture: Architecture::Minkunet(self.net.clone()),
        }
    }

    fn batch(&self, step: u64) -> Result<(Batch, Vec<u32>), TrainError> {
        self.batch_of(&self.windows(LEARN, step)?)
    }

    fn loss(&self, outputs: &[Matrix], labels: &Vec<u32>) -> Result<Vec<Loss>, eyebolt_net::Error> {
        Ok(vec![label_loss(&outputs[0], labels)?])
    }

    fn validate(
        &self,
        parameters: &Parameters,
        executor: &mut Cpu,
    ) -> Result<(BTreeMap<String, f64>, f64), TrainError> {
        let mut confusion = Confusion::new(CLASSES.len());
        for window in self.held_out()? {
            let (batch, labels) = self.batch_of(std::slice::from_ref(window))?;
            let outputs = executor.infer(&self.graph, parameters, &batch)?;
            confusion.add_rows(&labels, &outputs[0]);
        }
        let classes = CLASSES.map(str::to_owned);
        let value = confusion.class(usize::from(END_EFFECTOR)).iou;
        Ok((confusion.named(&classes), value))
    }
}
