//! A small lesson, and a keeper that keeps everything in memory.

use eyebolt::end_effector::EndEffector;
use eyebolt::progress::{Cancelled, Progress};
use eyebolt::robots::BuiltIn;
use eyebolt::segment::Grid;
use eyebolt::train::{
    Actor, Cast, EndEffectorLesson, Hand, Images, Keep, Lesson, Plan, Preset, Report,
    SegmentationLesson, TrainError,
};
use eyebolt_net::losses::Loss;
use eyebolt_net::models::{MinkUNet, ModelDescription};
use eyebolt_net::{Batch, Cpu, Graph, Matrix, Parameters};
use eyebolt_registration::LinkCache;
use std::collections::BTreeMap;

/// The segmentation of the built-in robot on images of 64 columns, by few channels.
pub fn lesson() -> SegmentationLesson {
    small_net(3)
}

/// The same with so many classes.
pub fn small_net(classes: usize) -> SegmentationLesson {
    let net = Preset::Default.segmentation(classes).unwrap();
    let net = MinkUNet { channels: [16, 16, 32, 32, 32, 16, 16, 16], stem_channels: 8, ..net };
    let mut lesson =
        SegmentationLesson::new(images(), Grid::Image { columns: 64 }, net, 5).unwrap();
    lesson.validation = 8;
    lesson
}

/// The built-in robot's end-effector in windows, by few channels.
pub fn end_effector_lesson() -> EndEffectorLesson {
    let arm = BuiltIn::named("shackle").unwrap().arm();
    let extent_m = EndEffector::of(&arm).unwrap().extent_m();
    let net = Preset::Default.end_effector().unwrap();
    let net = MinkUNet { channels: [16, 16, 32, 32, 32, 16, 16, 16], stem_channels: 8, ..net };
    let mut lesson = EndEffectorLesson::new(images(), extent_m, net, 5).unwrap();
    (lesson.images, lesson.validation) = (3, 24);
    lesson
}

/// The built-in robot's end-effector.
pub fn hand() -> Hand {
    let arm = BuiltIn::named("shackle").unwrap().arm();
    let end_effector = EndEffector::of(&arm).unwrap();
    let extent_m = end_effector.extent_m();
    Hand { images: images(), end_effector, extent_m, seed: 5 }
}

/// Images of the built-in robot.
fn images() -> Images {
    let arm = BuiltIn::named("shackle").unwrap().arm();
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-test-links"));
    Images::simulated(Cast::Known(vec![Actor::new(arm, &cache).unwrap()]))
}

/// A plan of so many steps, with a validation after every `every`.
pub fn plan(steps: u64, every: u64) -> Plan {
    Plan { every, patience: 1000, ..Preset::Default.plan(steps, 7, 1) }
}

/// Keeps everything; ends the run after so many checkpoints.
#[derive(Default)]
pub struct Memory {
    pub reports: Vec<Report>,
    pub checkpoints: Vec<Vec<u8>>,
}

impl Keep for Memory {
    fn report(&mut self, report: &Report) -> Result<(), TrainError> {
        self.reports.push(report.clone());
        Ok(())
    }

    fn checkpoint(&mut self, bytes: &[u8]) -> Result<(), TrainError> {
        self.checkpoints.push(bytes.to_vec());
        Ok(())
    }
}

/// Says nothing, and ends the work after step `.0`.
pub struct Until(pub usize);

impl Progress for Until {
    fn begin(&self, _: &'static str) -> Result<(), Cancelled> {
        Ok(())
    }

    fn advance(&self, done: usize, _: usize) -> Result<(), Cancelled> {
        if done > self.0 { Err(Cancelled) } else { Ok(()) }
    }
}

/// A lesson that has the batches of two steps and no others, in turn.
pub struct Repeated<L>(pub L);

impl<L: Lesson> Lesson for Repeated<L> {
    type Target = L::Target;

    fn graph(&self) -> &Graph {
        self.0.graph()
    }

    fn description(&self) -> ModelDescription {
        self.0.description()
    }

    fn batch(&self, step: u64) -> Result<(Batch, L::Target), TrainError> {
        self.0.batch(step % 2)
    }

    fn loss(
        &self,
        outputs: &[Matrix],
        target: &L::Target,
    ) -> Result<Vec<Loss>, eyebolt_net::Error> {
        self.0.loss(outputs, target)
    }

    fn validate(
        &self,
        _: &Parameters,
        _: &mut Cpu,
    ) -> Result<(BTreeMap<String, f64>, f64), TrainError> {
        Ok((BTreeMap::new(), 0.0))
    }
}
