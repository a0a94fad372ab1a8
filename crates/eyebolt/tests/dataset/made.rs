//! Recordings that are simulated, calibrated from nothing and labelled.

use crate::stage::{ARM, CACHE, planned, preset, small};
use eyebolt::answer::Answer;
use eyebolt::calibrate::Verdict;
use eyebolt::dataset::{
    Calibrated, Dataset, Description, FillError, Filled, LabelRun, RecordingEntry, Shard, Store,
    fill,
};
use eyebolt::end_effector::EndEffector;
use eyebolt::export::SavedCalibration;
use eyebolt::observations::Observations;
use eyebolt::pipeline::{Request, run};
use eyebolt::record::RecordOptions;
use eyebolt::simulate::{Plan, Scenario};
use eyebolt_recording::{FrameSource, InMemory};
use eyebolt_render::Sensor;
use std::path::Path;
use std::sync::LazyLock;
use tempfile::TempDir;

/// What a person would record in a minute.
pub fn scenario(sensor: Sensor, backgrounds: usize) -> Scenario<'static> {
    Scenario {
        sensor,
        viewpoint: preset("paper-test-p1"),
        configurations: 4,
        frames: 1,
        backgrounds,
        clutter: 6,
        seed: 3,
        ..small()
    }
}

/// A recording with its calibration, found from nothing.
pub struct Calibration {
    pub plan: Plan<'static>,
    pub source: InMemory,
    pub observations: Observations,
    pub json: String,
}

pub static OPTIONS: RecordOptions = RecordOptions { use_masks: false, most_configurations: 30 };
pub static HAND: LazyLock<EndEffector> = LazyLock::new(|| EndEffector::of(&ARM).unwrap());

impl Calibration {
    pub fn of(scenario: Scenario<'static>) -> Self {
        let plan = planned(scenario);
        let source = plan.in_memory().unwrap();
        Self::of_source(plan, source)
    }

    /// Of `source`, which `plan` tells the truth of.
    pub fn of_source(plan: Plan<'static>, source: InMemory) -> Self {
        let request =
            Request { cache: CACHE.clone(), options: OPTIONS, ..Request::new(&source, &ARM) };
        let outcome = run(&request, &()).unwrap();
        assert_eq!(outcome.calibration.verdict, Verdict::Trusted);
        let json = Answer::new(&request, &outcome).to_json();
        let observations = outcome.observations.unwrap();
        Self { plan, source, observations, json }
    }

    /// Labels frames of `source`, which may be others of the same recording.
    pub fn run<'a>(&'a self, source: &'a dyn FrameSource) -> LabelRun<'a> {
        let saved = SavedCalibration::parse("calibration.json", &self.json).unwrap();
        LabelRun::new(source, (&self.observations, &OPTIONS), (&ARM, &HAND), &saved).unwrap()
    }

    pub fn entry(&self) -> RecordingEntry {
        let calibrated = Calibrated::FromNothing;
        RecordingEntry::new("made.mcap", &self.source, &ARM, false, calibrated).unwrap()
    }

    /// Labels a shard into `folder`.
    pub fn label(&self, folder: &Path, shard: Shard) -> Result<Filled, FillError> {
        let mut store = Store::open(folder, Description::new(&ARM, &HAND), shard)?;
        let entry = self.entry();
        store.begin(&entry, &self.json)?;
        let run = self.run(&self.source);
        fill(&mut store, &entry, &self.source, &run, &|_, _| Ok(()), &())
    }
}

/// A Kinect's, shared by all tests.
pub static KINECT: LazyLock<Calibration> =
    LazyLock::new(|| Calibration::of(scenario(Sensor::KINECT_V1, 2)));

/// A data set of it that a test may spoil.
pub fn labelled() -> (TempDir, Dataset) {
    let folder = tempfile::tempdir().unwrap();
    KINECT.label(folder.path(), Shard::WHOLE).unwrap();
    let dataset = Dataset::open(folder.path()).unwrap();
    (folder, dataset)
}
