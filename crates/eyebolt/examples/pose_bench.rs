//! Milliseconds of each part of what `eyebolt pose` does with a frame, medians over a recording, as one line of JSON.
//!
//! ```sh
//! cargo run --release -p eyebolt --example pose_bench -- RECORDING MODEL [ROBOT.urdf] [--threads N]
//! ```
//!
//! `shackle` unless a URDF is named. `segment` is the networks' labels, `rpt` and `kpm` what each network
//! proposes, `fused` one contest of poses, `whole` everything as the program does it.
#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::model_files::ModelFiles;
use eyebolt::pose::{EndEffectorShape, PoseEstimator, PoseMethod, Recognizer};
use eyebolt::record::{FrameImage, FrameImages};
use eyebolt::robots::BuiltIn;
use eyebolt::segment::Segmenter;
use eyebolt_recording::{BagOptions, FrameSource, Recording};
use eyebolt_registration::LinkCache;
use eyebolt_robot::{PackageRoots, Robot};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some(at) = arguments.iter().position(|it| it == "--threads") {
        let threads = arguments.get(at + 1).ok_or("--threads N")?.parse()?;
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
        arguments.drain(at..at + 2);
    }
    let [recording, model, robot @ ..] = arguments.as_slice() else {
        return Err("give RECORDING MODEL [ROBOT.urdf]".into());
    };
    let recording = Recording::open(&PathBuf::from(recording), &BagOptions::default())?;
    let arm = match robot {
        [path, ..] => {
            Robot::from_urdf_file(path.as_ref(), &PackageRoots::new())?.arm(None, None)?
        }
        [] => BuiltIn::named("shackle").ok_or("no such robot")?.arm(),
    };
    let model = ModelFiles::at(model.into());
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-bench-links"));
    let shape = EndEffectorShape::of(&arm, &cache)?;
    let mut segmenter = Segmenter::open(&model)?;
    let mut recognizer = Recognizer::open(&model, shape.clone())?;
    let open = |method| PoseEstimator::open(&model, shape.clone(), method);
    let mut rpt = open(PoseMethod::Rpt)?;
    let mut kpm = open(PoseMethod::Kpm)?;
    (rpt.refines, kpm.refines) = (false, false);
    let mut fused = open(PoseMethod::Fused)?;
    let source: &dyn FrameSource = recording.source();
    let images = FrameImages::of(source)?;
    let mut spent: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for index in 0..source.frame_names().len() {
        let Some(FrameImage { depth, .. }) = images.read(source, index)? else { continue };
        let camera = images.camera();
        let mut begun = Instant::now();
        let mut lap = |name| {
            spent.entry(name).or_default().push(1e3 * begun.elapsed().as_secs_f64());
            begun = Instant::now();
        };
        let label = segmenter.segment(&depth, camera)?.label;
        lap("segment");
        rpt.estimate(&depth, camera, &label, None)?;
        lap("rpt");
        kpm.estimate(&depth, camera, &label, None)?;
        lap("kpm");
        fused.estimate(&depth, camera, &label, None)?;
        lap("fused");
        recognizer.recognize(&depth, camera, &[])?;
        lap("whole");
    }
    let median = |mut laps: Vec<f64>| {
        laps.sort_by(f64::total_cmp);
        laps.get(laps.len() / 2).map_or(f64::NAN, |ms| (10.0 * ms).round() / 10.0)
    };
    let medians: BTreeMap<_, _> = spent.into_iter().map(|(name, ms)| (name, median(ms))).collect();
    println!("{}", serde_json::to_string(&medians)?);
    Ok(())
}
