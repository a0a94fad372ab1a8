//! Calibrates what was recorded so far, while more comes in.

use super::scout::Scout;
use crate::calibrate::WayArguments;
use crate::inputs::RobotArguments;
use anyhow::{Context, Result};
use eyebolt::pipeline;
use eyebolt_live::{Assessment, Finding};
use eyebolt_recording::{BagOptions, GrowingRecording, Recording};
use eyebolt_robot::JointPositions;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, Sender};

/// A thread that calibrates what was recorded so far, when it is asked to.
pub struct Calibrator {
    asked: Sender<JointPositions>,
    answers: Receiver<Result<Assessment>>,
}

struct Worker {
    path: PathBuf,
    growing: GrowingRecording,
    robot: RobotArguments,
    way: WayArguments,
    scout: Option<Scout>,
}

impl Calibrator {
    /// Of the session at `path`; `scout` is handed what comes of it.
    pub fn start(
        path: &Path,
        (options, robot): (BagOptions, RobotArguments),
        way: WayArguments,
        scout: Option<Scout>,
    ) -> Result<Self> {
        let growing = GrowingRecording::new(path, options);
        let mut worker = Worker { path: path.to_owned(), growing, robot, way, scout };
        let (asked, wanted) = mpsc::channel::<JointPositions>();
        let (answer, answers) = mpsc::channel();
        let pool = few_threads()?;
        std::thread::Builder::new()
            .name("eyebolt-calibrator".to_owned())
            .spawn(move || {
                while let Ok(joints) = wanted.recv() {
                    if answer.send(pool.install(|| worker.assess(joints))).is_err() {
                        return;
                    }
                }
            })
            .context("cannot start a thread to calibrate")?;
        Ok(Self { asked, answers })
    }

    /// Asks for an answer of what is on disk, while the joints are at `joints`.
    pub fn ask(&self, joints: JointPositions) {
        // It ends with the program.
        let _ = self.asked.send(joints);
    }

    /// An answer, if one came.
    pub fn answer(&self) -> Option<Result<Assessment>> {
        self.answers.try_recv().ok()
    }
}

/// All cores but the one that has to keep up with what comes in.
fn few_threads() -> Result<rayon::ThreadPool> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = cores.saturating_sub(1).max(1);
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().context("cannot start the threads")
}

impl Worker {
    fn assess(&mut self, joints: JointPositions) -> Result<Assessment> {
        let recording = Recording::Bag(Box::new(self.growing.now()?));
        let arm = self.robot.arm(&self.path, &recording)?;
        let recording = self.robot.noted(recording, &arm)?;
        let request = self.way.request(&recording, &arm);
        let (cache, seed) = (request.cache.clone(), request.seed);
        let outcome = pipeline::run(&request, &())?;
        let assessment = Assessment::of(&outcome, &arm);
        if let Some(scout) = &self.scout {
            scout.hand(Finding { outcome, arm, joints, cache, seed });
        }
        Ok(assessment)
    }
}
