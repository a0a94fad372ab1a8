//! Six planned configurations against six random ones: how far off calibrations of simulated cameras are with each.
//!
//! ```text
//! cargo run --release -p eyebolt --example plan_study -- [CAMERAS] [FIRST] [SETS]
//! ```
//!
//! Each camera is a good session of `eyebolt study`: its robot, sensor, place, clutter, depth scale and joint zeros that are
//! off. The plan knows the camera to 20 mm and a degree along and about each axis, and nothing of the rest. The random
//! configurations, SETS times six of them, keep to the same rules: within limits, in view, free; the first that were drawn.
//! Errors are those at the middle of the workspace.

#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::calibrate::Deviation;
use eyebolt::pipeline::{self, Request};
use eyebolt::plan::{
    MovableArm, PlanRequest, RoughCamera, Speed, free_and_in_view, middle_of, plan_next,
};
use eyebolt::simulate::{Plan, Scenario, plan};
use eyebolt::study::{Kind, Session};
use eyebolt_registration::LinkCache;
use eyebolt_render::Random;
use eyebolt_robot::{Arm, JointPositions};
use nalgebra::{Point3, Vector6};
use std::error::Error;
use std::time::Instant;

const COUNT: usize = 6;
const FRAMES: usize = 3;
const SEED: u64 = 11;
/// How far off the rough pose is along and about each axis, metres and radians.
const ROUGH: [f64; 2] = [0.02, 0.0175];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let (cameras, first, sets) = (number(30)?, number(0)?, number(1)?);
    let folder = tempfile::tempdir()?;
    let cache = LinkCache::new(folder.path().to_owned());
    let mut tally = Tally::default();
    let mut number = first;
    while tally.cameras < cameras && number < first + 4 * cameras {
        try_camera(number, sets as usize, &cache, &mut tally)?;
        number += 1;
    }
    tally.print();
    Ok(())
}

#[derive(Default)]
struct Tally {
    cameras: u64,
    planned: Vec<Deviation>,
    random: Vec<Deviation>,
    /// Logarithms of planned over random, of each camera.
    ratios: Vec<f64>,
    seconds: Vec<f64>,
    expected: Vec<f64>,
}

fn try_camera(
    number: u64,
    sets: usize,
    cache: &LinkCache,
    tally: &mut Tally,
) -> Result<(), Box<dyn Error>> {
    let session = Session::draw(SEED, number, Some(Kind::Plain));
    let arm = session.robot.arm();
    let scenario = Scenario {
        arm: &arm,
        urdf: session.robot.urdf,
        sensor: session.sensor,
        viewpoint: session.viewpoint,
        configurations: COUNT,
        frames: FRAMES,
        moving_frames: 0,
        backgrounds: 0,
        clutter: session.clutter,
        faults: session.faults,
        seed: session.seed,
    };
    // A camera that hardly sees the arm is none.
    let Ok(mut simulated) = plan(scenario, cache) else { return Ok(()) };
    let mut random = Random::new(number).at(7);
    let off = Vector6::from_fn(|axis, _| ROUGH[axis / 3] * random.normal());
    let rough = [RoughCamera {
        camera: session.sensor.camera(),
        camera_from_base: simulated.camera_from_base().retract(&off),
        range_m: session.sensor.range_m,
    }];
    let movable = MovableArm::new(&arm, &JointPositions::default(), cache)?;
    let request = PlanRequest {
        arm: &movable,
        cameras: &rough,
        recorded: None,
        calibrated: None,
        start: None,
        count: COUNT,
        table: true,
        seen_only: false,
        speed: Speed::new(movable.joints(), 0.2, 0.05),
        rest_s: 3.0,
        seed: number,
    };
    let begun = Instant::now();
    let planned = plan_next(&request);
    let seconds = begun.elapsed().as_secs_f64();
    let others = free_and_in_view(&request, COUNT * sets);
    if planned.configurations.len() < COUNT || others.len() < COUNT * sets {
        println!("{number}: {} planned, {} random", planned.configurations.len(), others.len());
        return Ok(());
    }
    let at = middle_of(&movable, &others);
    let all = |positions: &[f64]| movable.all_joints(positions);
    let chosen: Vec<_> = planned.configurations.iter().map(|one| all(&one.positions)).collect();
    let (own, back) = error_with(simulated, &chosen, &arm, cache, &at)?;
    simulated = back;
    let mut mean = 0.0;
    for set in others.chunks(COUNT) {
        let set: Vec<_> = set.iter().map(|positions| all(positions)).collect();
        let (error, back) = error_with(simulated, &set, &arm, cache, &at)?;
        simulated = back;
        mean += error.translation_m / sets as f64;
        tally.random.push(error);
    }
    println!(
        "{number}: {} before {}: planned {:.2} mm, {:.3} deg; random {:.2} mm; in {seconds:.2} s",
        session.robot.name,
        session.sensor.name,
        1e3 * own.translation_m,
        own.rotation_rad.to_degrees(),
        1e3 * mean
    );
    tally.cameras += 1;
    tally.planned.push(own);
    tally.ratios.push((own.translation_m / mean).ln());
    tally.seconds.push(seconds);
    tally.expected.extend(planned.configurations.last().map(|last| last.expected.translation_m));
    Ok(())
}

/// How far off the calibration of `simulated` is with the arm in `configurations`; infinitely without a pose.
fn error_with<'a>(
    simulated: Plan<'a>,
    configurations: &[JointPositions],
    arm: &Arm,
    cache: &LinkCache,
    at: &Point3<f64>,
) -> Result<(Deviation, Plan<'a>), Box<dyn Error>> {
    let simulated = simulated.at(configurations)?;
    let source = simulated.in_memory()?;
    let request = Request { cache: cache.clone(), ..Request::new(&source, arm) };
    let calibration = pipeline::run(&request, &())?.calibration;
    let never = Deviation { translation_m: f64::INFINITY, rotation_rad: f64::INFINITY };
    let sought = simulated.sought_camera_from_base();
    let found = calibration.camera_from_base.as_ref();
    Ok((found.map_or(never, |pose| Deviation::between(pose, &sought, at)), simulated))
}

impl Tally {
    fn print(&self) {
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let mm = |errors: &[Deviation]| -> Vec<f64> {
            errors.iter().map(|error| 1e3 * error.translation_m).collect()
        };
        let deg = |errors: &[Deviation]| -> Vec<f64> {
            errors.iter().map(|error| error.rotation_rad.to_degrees()).collect()
        };
        let (planned, random) = (mean(&mm(&self.planned)), mean(&mm(&self.random)));
        let (turned, turned_random) = (mean(&deg(&self.planned)), mean(&deg(&self.random)));
        println!("\n{} cameras, mean error at the middle of the workspace:", self.cameras);
        println!("planned {planned:.3} mm, {turned:.4} deg");
        println!("random  {random:.3} mm, {turned_random:.4} deg");
        println!(
            "ratio   {:.3} of mm, {:.3} of degrees; geometric mean over the cameras {:.3}",
            planned / random,
            turned / turned_random,
            mean(&self.ratios).exp()
        );
        let slowest = self.seconds.iter().copied().fold(0.0, f64::max);
        println!("a plan takes {:.2} s, at most {slowest:.2} s", mean(&self.seconds));
    }
}
