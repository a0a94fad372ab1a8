//! Calibrates what was recorded so far, while more comes in.

use crate::calibrate::MOST_CONFIGURATIONS;
use crate::inputs::RobotArguments;
use anyhow::{Context, Result};
use eyebolt::calibrate::Limits;
use eyebolt::pipeline::{self, Request};
use eyebolt::record::RecordOptions;
use eyebolt_live::Assessment;
use eyebolt_recording::{BagOptions, GrowingRecording, Recording};
use eyebolt_registration::LinkCache;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, Sender};

/// A thread that calibrates what was recorded so far, when it is asked to.
pub struct Calibrator {
    asked: Sender<()>,
    answers: Receiver<Result<Assessment>>,
}

struct Worker {
    path: PathBuf,
    growing: GrowingRecording,
    robot: RobotArguments,
    cache: LinkCache,
    limits: Limits,
    seed: u64,
}

impl Calibrator {
    /// Of the session at `path`.
    pub fn start(
        path: &Path,
        (options, robot): (BagOptions, RobotArguments),
        (cache, limits, seed): (LinkCache, Limits, u64),
    ) -> Result<Self> {
        let growing = GrowingRecording::new(path, options);
        let mut worker = Worker { path: path.to_owned(), growing, robot, cache, limits, seed };
        let (asked, wanted) = mpsc::channel();
        let (answer, answers) = mpsc::channel();
        let pool = few_threads()?;
        std::thread::Builder::new()
            .name("eyebolt-calibrator".to_owned())
            .spawn(move || {
                while wanted.recv().is_ok() {
                    if answer.send(pool.install(|| worker.assess())).is_err() {
                        return;
                    }
                }
            })
            .context("cannot start a thread to calibrate")?;
        Ok(Self { asked, answers })
    }

    /// Asks for an answer of what is on disk.
    pub fn ask(&self) {
        // It ends with the program.
        let _ = self.asked.send(());
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
    fn assess(&mut self) -> Result<Assessment> {
        let recording = Recording::Bag(Box::new(self.growing.now()?));
        let arm = self.robot.arm(&self.path, &recording)?;
        let recording = self.robot.noted(recording, &arm)?;
        let options = RecordOptions {
            most_configurations: usize::from(MOST_CONFIGURATIONS),
            ..RecordOptions::default()
        };
        let request = Request {
            cache: self.cache.clone(),
            options,
            limits: self.limits,
            seed: self.seed,
            ..Request::new(recording.source(), &arm)
        };
        let outcome = pipeline::run(&request, &())?;
        Ok(Assessment::of(&outcome, &arm))
    }
}
