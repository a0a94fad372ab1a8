//! Simulates the paper's setting with many seeds, calibrates each from nothing and says how far off
//! the answers are.
//!
//! ```text
//! cargo run --release -p eyebolt --example rehearse -- [--seeds 30] [--first-seed 1] [--preset P]
//!     [--sensor kinect-v1] [--backgrounds 10] [--frames 10] [--configurations 6]
//!     [--joint-offset-deg 0] [--joint-offset-sigma-deg 0] [--depth-scale 1] [--jackknife newton]
//! ```
//!
//! One line for each seed and preset, then one JSON line with the figures of all. Without
//! `--preset` seeds take the three test poses in turn; `--preset all` gives each seed all three,
//! and `--preset random` takes a pose that the seed chooses.

#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::calibrate::{Jackknife, Verdict};
use eyebolt::evaluate::Evaluation;
use eyebolt::pipeline::{self, Request};
use eyebolt::robots::BuiltIn;
use eyebolt::simulate::{Faults, Preset, Ranges, Scenario, Viewpoint, plan};
use eyebolt_recording::{BagOptions, Recording};
use eyebolt_registration::LinkCache;
use eyebolt_render::Sensor;
use std::collections::BTreeMap;
use std::error::Error;
use std::io::BufWriter;
use std::time::Instant;

type Flags = BTreeMap<String, String>;

/// What became of one seed.
struct Run {
    evaluation: Option<Evaluation>,
    expected_mm: f64,
    expected_deg: f64,
    trusted: bool,
    simulated_s: f64,
    calibrated_s: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let pairs = arguments.chunks(2).map(|pair| {
        let name = pair[0].trim_start_matches("--").to_owned();
        (name, pair.get(1).cloned().unwrap_or_default())
    });
    let flags: Flags = pairs.collect();
    let first: u64 = number(&flags, "first-seed", 1)?;
    let cache = tempfile::tempdir()?;
    let cache = LinkCache::new(cache.path().to_owned());
    let mut runs = Vec::new();
    for seed in first..first + number(&flags, "seeds", 30)? {
        for viewpoint in viewpoints(&flags, seed) {
            let run = rehearse(&flags, seed, viewpoint, &cache)?;
            println!("{}", line(seed, &viewpoint, &run));
            runs.push(run);
        }
    }
    println!("{}", summary(&runs));
    Ok(())
}

fn number<T: std::str::FromStr>(flags: &Flags, name: &str, default: T) -> Result<T, String> {
    let Some(text) = flags.get(name) else { return Ok(default) };
    text.parse().map_err(|_| format!("--{name} {text}: not a number"))
}

fn viewpoints(flags: &Flags, seed: u64) -> Vec<Viewpoint> {
    let test = |n: u64| Preset::named(&format!("paper-test-p{n}")).expect("one of three");
    match flags.get("preset").map(String::as_str) {
        None => vec![Viewpoint::Preset(test(1 + (seed + 2) % 3))],
        Some("all") => (1..=3).map(|n| Viewpoint::Preset(test(n))).collect(),
        Some(name) => {
            let named = Preset::named(name).map(Viewpoint::Preset);
            vec![named.unwrap_or(Viewpoint::Within(Ranges::default()))]
        }
    }
}

fn rehearse(
    flags: &Flags,
    seed: u64,
    viewpoint: Viewpoint,
    cache: &LinkCache,
) -> Result<Run, Box<dyn Error>> {
    let robot = BuiltIn::named("shackle").expect("built in");
    let arm = robot.arm();
    let sensor = flags.get("sensor").map_or("kinect-v1", String::as_str);
    let scenario = Scenario {
        arm: &arm,
        urdf: robot.urdf,
        sensor: sensor.parse::<Sensor>()?,
        viewpoint,
        configurations: number(flags, "configurations", 6)?,
        frames: number(flags, "frames", 10)?,
        moving_frames: 0,
        backgrounds: number(flags, "backgrounds", 10)?,
        clutter: 8,
        faults: Faults {
            joint_offset: number::<f64>(flags, "joint-offset-deg", 0.0)?.to_radians(),
            joint_offset_sigma: number::<f64>(flags, "joint-offset-sigma-deg", 0.0)?.to_radians(),
            depth_scale: number(flags, "depth-scale", 1.0)?,
            ..Faults::default()
        },
        seed,
    };
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("session.mcap");
    let begun = Instant::now();
    let plan = plan(scenario, cache)?;
    let file = BufWriter::new(std::fs::File::create(&path)?);
    plan.record(file, &())?;
    let simulated_s = begun.elapsed().as_secs_f64();
    let begun = Instant::now();
    let recording = Recording::open(&path, &BagOptions::default())?;
    let jackknife = match flags.get("jackknife").map(String::as_str) {
        None | Some("newton") => Jackknife::Newton,
        Some("exact") => Jackknife::Exact,
        Some(other) => return Err(format!("--jackknife {other}: newton or exact").into()),
    };
    let request =
        Request { cache: cache.clone(), jackknife, ..Request::new(recording.source(), &arm) };
    let calibration = pipeline::run(&request, &())?.calibration;
    let truth = plan.sought_camera_from_base();
    let expected = calibration.error.as_ref().map(|error| error.expected);
    Ok(Run {
        evaluation: calibration.camera_from_base.map(|pose| Evaluation::of(&pose, &truth)),
        expected_mm: expected.map_or(f64::NAN, |expected| 1e3 * expected.translation_m),
        expected_deg: expected.map_or(f64::NAN, |expected| expected.rotation_rad.to_degrees()),
        trusted: calibration.verdict == Verdict::Trusted,
        simulated_s,
        calibrated_s: begun.elapsed().as_secs_f64(),
    })
}

fn line(seed: u64, viewpoint: &Viewpoint, run: &Run) -> String {
    let place = match viewpoint {
        Viewpoint::Preset(preset) => preset.name,
        Viewpoint::Within(_) => "random",
    };
    let found = run.evaluation.map_or("no pose".to_owned(), |evaluation| {
        let Evaluation { translation_mm, rotation_deg, .. } = evaluation;
        format!("{translation_mm:7.2} mm {rotation_deg:7.3} deg")
    });
    format!(
        "{seed:3} {place:14} {found} (expected {:.3} mm {:.4} deg) {:7} simulated {:.1} s, calibrated {:.1} s",
        run.expected_mm,
        run.expected_deg,
        if run.trusted { "trusted" } else { "refused" },
        run.simulated_s,
        run.calibrated_s
    )
}

fn summary(runs: &[Run]) -> String {
    let sorted = |of: &dyn Fn(&Run) -> Option<f64>| {
        let mut values: Vec<f64> = runs.iter().filter_map(of).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let mm = sorted(&|run| run.evaluation.map(|e| e.translation_mm));
    let deg = sorted(&|run| run.evaluation.map(|e| e.rotation_deg));
    let seconds = sorted(&|run| Some(run.calibrated_s));
    let median = |values: &[f64]| values.get(values.len() / 2).copied().unwrap_or(f64::NAN);
    let worst = |values: &[f64]| values.last().copied().unwrap_or(f64::NAN);
    let within = |run: &&Run, mm: f64, deg: f64| {
        run.evaluation.is_some_and(|e| e.translation_mm <= mm && e.rotation_deg <= deg)
    };
    let good = runs.iter().filter(|run| within(run, 5.0, 0.3)).count();
    let trusted = runs.iter().filter(|run| run.trusted).count();
    let misled = runs.iter().filter(|run| run.trusted && !within(run, 10.0, 0.6)).count();
    // How often the error stays below twice what was expected: about 19 times in 20 if honest.
    let honest =
        runs.iter().filter(|run| within(run, 2.0 * run.expected_mm, 2.0 * run.expected_deg));
    format!(
        "{{\"runs\":{},\"within_5mm_0.3deg\":{good},\"trusted\":{trusted},\"trusted_beyond_10mm_0.6deg\":{misled},\
         \"median_mm\":{:.3},\"median_deg\":{:.4},\"worst_mm\":{:.3},\"worst_deg\":{:.4},\
         \"within_twice_expected\":{},\"median_calibrate_s\":{:.2},\"worst_calibrate_s\":{:.2}}}",
        runs.len(),
        median(&mm),
        median(&deg),
        worst(&mm),
        worst(&deg),
        honest.count(),
        median(&seconds),
        worst(&seconds)
    )
}
