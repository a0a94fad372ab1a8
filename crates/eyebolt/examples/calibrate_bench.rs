//! Milliseconds of each stage of a calibration, median over some runs, as one line of JSON.
//!
//! ```sh
//! cargo run --release -p eyebolt --example calibrate_bench -- RECORDING [RUNS] [--no-masks] [--threads N]
//! ```
//!
//! The first run, not counted, fills the cache of link shapes.
#![allow(clippy::print_stdout)]

use eyebolt::pipeline::{Request, run};
use eyebolt::progress::{Cancelled, Progress};
use eyebolt::record::RecordOptions;
use eyebolt_recording::{BagOptions, Recording};
use eyebolt_registration::LinkCache;
use eyebolt_robot::{PackageRoots, Robot};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

type Failure = Box<dyn std::error::Error>;

/// When each step began.
#[derive(Default)]
struct Clock(RefCell<Vec<(&'static str, Instant)>>);

impl Progress for Clock {
    fn begin(&self, stage: &'static str) -> Result<(), Cancelled> {
        self.0.borrow_mut().push((stage, Instant::now()));
        Ok(())
    }

    fn advance(&self, _: usize, _: usize) -> Result<(), Cancelled> {
        Ok(())
    }
}

impl Clock {
    fn spent_ms(&self, end: Instant) -> Vec<(&'static str, f64)> {
        let begun = self.0.borrow();
        let ends = begun.iter().skip(1).map(|(_, next)| *next).chain([end]);
        let spans = begun.iter().zip(ends);
        spans.map(|((name, from), to)| (*name, 1e3 * (to - *from).as_secs_f64())).collect()
    }
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |flag: &str| {
        let at = arguments.iter().position(|a| a == flag)?;
        arguments.get(at + 1)
    };
    if let Some(threads) = value("--threads") {
        rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build_global()?;
    }
    let recording = arguments.first().ok_or("give a RECORDING")?;
    let runs: usize = arguments.get(1).and_then(|a| a.parse().ok()).unwrap_or(5).max(1);
    let use_masks = !arguments.iter().any(|a| a == "--no-masks");
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-bench-links"));
    let mut spent: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for counted in (0..=runs).map(|index| index > 0) {
        let stages = time_one(Path::new(recording), &cache, use_masks)?;
        for (name, ms) in stages.into_iter().filter(|_| counted) {
            spent.entry(name).or_default().push(ms);
        }
    }
    let medians = spent.into_iter().map(|(name, mut values)| {
        values.sort_by(f64::total_cmp);
        (name, values[values.len() / 2])
    });
    let line: BTreeMap<&str, f64> = medians.collect();
    println!("{}", serde_json::to_string(&line)?);
    Ok(())
}

fn time_one(
    recording: &Path,
    cache: &LinkCache,
    use_masks: bool,
) -> Result<Vec<(&'static str, f64)>, Failure> {
    let start = Instant::now();
    let recording = Recording::open(recording, &BagOptions::default())?;
    let section = recording.robot();
    let urdf: &PathBuf = section.urdf.as_ref().ok_or("recording.toml names no urdf")?;
    let robot = Robot::from_urdf_file(urdf, &PackageRoots::new())?;
    let arm = robot.arm(section.base.as_deref(), section.end_effector.as_deref())?;
    let options = RecordOptions { use_masks, ..RecordOptions::default() };
    let request =
        Request { cache: cache.clone(), options, ..Request::new(recording.source(), &arm) };
    let clock = Clock::default();
    let opened = Instant::now();
    run(&request, &clock)?;
    let end = Instant::now();
    let mut stages = clock.spent_ms(end);
    stages.push(("open", 1e3 * (opened - start).as_secs_f64()));
    stages.push(("total", 1e3 * (end - start).as_secs_f64()));
    Ok(stages)
}
