//! Watches simulated arms with calibrations that are true, and with some that are not, and counts alarms.
//!
//! ```text
//! cargo run --release -p eyebolt --example monitor_study -- [SEEDS] [FIRST_SEED] [SENSOR]
//! ```
//!
//! Each seed is one camera and ten configurations. The stored calibration is the truth, off by what it says it is off by;
//! for a bump it is turned or shifted besides, for a joint the recorded positions of that joint are.

#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::calibrate::Deviation;
use eyebolt::monitor::{Known, Monitor, Rate, Suspect, ViewReport};
use eyebolt::observations::Observations;
use eyebolt::record::{RecordOptions, observe};
use eyebolt::robots::BuiltIn;
use eyebolt::simulate::{Faults, Ranges, Scenario, Viewpoint, plan};
use eyebolt_geometry::{Base, Camera, DepthImage, Transform};
use eyebolt_recording::{FrameSource, Range};
use eyebolt_registration::{LinkCache, Start};
use eyebolt_render::{Random, Sensor};
use eyebolt_robot::{Arm, JointPositions};
use nalgebra::{Matrix6, Point3, Vector3, Vector6};
use std::error::Error;
use std::time::Instant;

/// Standard deviations of the stored calibrations, metres and radians.
const STORED: [f64; 2] = [7e-4, 7e-4];
const CONFIGURATIONS: usize = 10;

struct Session<'a> {
    arm: &'a Arm,
    observations: &'a Observations,
    views: Vec<(DepthImage, JointPositions)>,
    truth: Transform<Camera, Base>,
    workspace: Point3<f64>,
}

#[derive(Default)]
struct Tally {
    views: usize,
    false_alarms: usize,
    surprise: Vec<f64>,
    milliseconds: Vec<f64>,
    bumps: usize,
    late: usize,
    small: usize,
    small_within: usize,
    small_alarms: usize,
    joints: usize,
    joints_told: usize,
    joints_alarmed: usize,
    bumps_told: usize,
    too_few: usize,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let seeds: u64 = arguments.next().map_or(Ok(10), |text| text.parse())?;
    let first: u64 = arguments.next().map_or(Ok(1), |text| text.parse())?;
    let sensor = arguments.next().unwrap_or_else(|| "d435".to_owned()).parse::<Sensor>()?;
    let robot = BuiltIn::named("shackle").ok_or("no such robot")?;
    let arm = robot.arm();
    let folder = tempfile::tempdir()?;
    let cache = LinkCache::new(folder.path().to_owned());
    let mut tally = Tally::default();
    for seed in first..first + seeds {
        let scenario = Scenario {
            arm: &arm,
            urdf: robot.urdf,
            sensor,
            viewpoint: Viewpoint::Within(Ranges::default()),
            configurations: CONFIGURATIONS,
            frames: 1,
            moving_frames: 0,
            backgrounds: 0,
            clutter: 5,
            faults: Faults { joint_offset_sigma: 5e-4, ..Faults::default() },
            seed,
        };
        let Ok(plan) = plan(scenario, &cache) else { continue };
        let source = plan.in_memory()?;
        let options = RecordOptions { most_configurations: 2, ..RecordOptions::default() };
        let observations = observe(&source, &arm, &cache, &options)?;
        let mut views = Vec::new();
        for index in 0..source.frame_names().len() {
            let frame = source.read_frame(index)?;
            let Range::Depth(depth) = frame.range else { continue };
            views.push((depth, frame.joints));
        }
        let truth = plan.sought_camera_from_base();
        let workspace = plan.workspace_in_base();
        let session = Session { arm: &arm, observations: &observations, views, truth, workspace };
        session.run(seed, &mut tally)?;
    }
    tally.print();
    Ok(())
}

impl Session<'_> {
    fn known(&self, bump: &Vector6<f64>, random: &mut Random) -> Known {
        let own = Vector6::from_fn(|i, _| STORED[i / 3] * random.normal());
        // The bump is about the middle of the workspace.
        let reach = self.truth.direction(&self.workspace.coords);
        let turn: Vector3<f64> = bump.fixed_rows::<3>(3).into_owned();
        let shift = bump.fixed_rows::<3>(0) - turn.cross(&reach);
        let about_base = Vector6::from_iterator(shift.iter().chain(turn.iter()).copied());
        let variances = Vector6::from_fn(|i, _| STORED[i / 3].powi(2));
        Known {
            start: Start::from(self.truth.retract(&(own + about_base))),
            covariance: Matrix6::from_diagonal(&variances),
            workspace_in_base: self.workspace,
            residual_m: None,
        }
    }

    fn monitor(&self, known: Known) -> Monitor<'_> {
        Monitor::new(self.arm, self.observations, known, &Rate::default())
    }

    fn see(
        &self,
        monitor: &mut Monitor<'_>,
        view: usize,
        joint: Option<(&str, f64)>,
    ) -> Result<ViewReport, Box<dyn Error>> {
        let (depth, joints) = &self.views[view];
        let moved = joints.iter().map(|(name, position)| {
            let by = joint.filter(|(joint, _)| *joint == name).map_or(0.0, |(_, by)| by);
            (name.to_owned(), position + by)
        });
        Ok(monitor.see(&view.to_string(), (depth, None), &moved.collect())?)
    }

    fn run(&self, seed: u64, tally: &mut Tally) -> Result<(), Box<dyn Error>> {
        let mut random = Random::new(seed).at(77);
        let nothing = Vector6::zeros();
        for _ in 0..2 {
            let mut monitor = self.monitor(self.known(&nothing, &mut random));
            for view in 0..self.views.len() {
                let begun = Instant::now();
                let report = self.see(&mut monitor, view, None)?;
                tally.milliseconds.push(1e3 * begun.elapsed().as_secs_f64());
                tally.views += 1;
                tally.surprise.extend(report.surprise);
            }
            if monitor.alarms() {
                println!("seed {seed}: false alarm");
            }
            tally.false_alarms += usize::from(monitor.alarms());
        }
        for number in 0..4 {
            let way = random_direction(&mut random);
            let bump = match number % 2 {
                0 => Vector6::new(0.0, 0.0, 0.0, way.x, way.y, way.z) * 1f64.to_radians(),
                _ => Vector6::new(way.x, way.y, way.z, 0.0, 0.0, 0.0) * 0.010,
            };
            self.bumped(seed, &bump, &mut random, tally)?;
        }
        let (by, about) = (random_direction(&mut random), random_direction(&mut random));
        let about = about * 0.3f64.to_radians();
        let small = Vector6::new(3e-3 * by.x, 3e-3 * by.y, 3e-3 * by.z, about.x, about.y, about.z);
        self.slightly_bumped(&small, &mut random, tally)?;
        let joints = self.observations.arm.joints();
        for _ in 0..2 {
            let joint = 1 + random.index(joints.len().saturating_sub(2).max(1));
            let sign = if random.uniform() < 0.5 { -1.0 } else { 1.0 };
            let by = (joints[joint].name.as_str(), sign * 1f64.to_radians());
            let mut monitor = self.monitor(self.known(&nothing, &mut random));
            let mut last = None;
            for view in 0..self.views.len() {
                last = Some(self.see(&mut monitor, view, Some(by))?);
            }
            let Some(last) = last else { continue };
            tally.joints += 1;
            tally.joints_alarmed += usize::from(last.alarm);
            let told = last.moved.first().is_some_and(|m| matches!(&m.what, Suspect::JointZero(_)));
            tally.joints_told += usize::from(told);
            if !told {
                println!("seed {seed}: joint {by:?} not told: {:?}", last.moved.first());
            }
        }
        Ok(())
    }

    fn bumped(
        &self,
        seed: u64,
        bump: &Vector6<f64>,
        random: &mut Random,
        tally: &mut Tally,
    ) -> Result<(), Box<dyn Error>> {
        let mut monitor = self.monitor(self.known(bump, random));
        // Views that tell nothing do not count, here neither.
        let begin = random.index(self.views.len());
        let mut last = None;
        for view in (0..self.views.len()).map(|view| (begin + view) % self.views.len()) {
            last = Some(self.see(&mut monitor, view, None)?);
            if monitor.counted() >= 3 {
                break;
            }
        }
        let Some(last) = last.filter(|_| monitor.counted() >= 3) else {
            tally.too_few += 1;
            return Ok(());
        };
        tally.bumps += 1;
        tally.late += usize::from(!last.alarm);
        let is_joint = last.moved.first().is_some_and(|m| matches!(&m.what, Suspect::JointZero(_)));
        tally.bumps_told += usize::from(last.alarm && !is_joint);
        if !last.alarm || is_joint {
            println!(
                "seed {seed}: bump {:?} {:?} {:?}",
                last.log10_evidence,
                last.drift,
                last.moved.first()
            );
        }
        Ok(())
    }

    fn slightly_bumped(
        &self,
        bump: &Vector6<f64>,
        random: &mut Random,
        tally: &mut Tally,
    ) -> Result<(), Box<dyn Error>> {
        let known = self.known(bump, random);
        let stored = known.start.camera_from_base;
        let mut monitor = self.monitor(known);
        let mut last = None;
        for view in 0..self.views.len() {
            last = Some(self.see(&mut monitor, view, None)?);
        }
        let Some(drift) = last.as_ref().and_then(|last| last.drift.as_ref()) else { return Ok(()) };
        // How far it really is from where the stored calibration has it.
        let truth = Deviation::between(&stored, &self.truth, &self.workspace);
        let mm =
            (drift.translation_mm - 1e3 * truth.translation_m).abs() / drift.translation_sigma_mm;
        let deg =
            (drift.rotation_deg - truth.rotation_rad.to_degrees()).abs() / drift.rotation_sigma_deg;
        tally.small += 1;
        tally.small_within += usize::from(mm < 2.0 && deg < 2.0);
        tally.small_alarms += usize::from(last.is_some_and(|last| last.alarm));
        Ok(())
    }
}

fn random_direction(random: &mut Random) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.normal()).normalize()
}

impl Tally {
    fn print(mut self) {
        let quantile = |values: &mut Vec<f64>, part: f64| {
            values.sort_by(f64::total_cmp);
            values
                .get((part * (values.len().max(1) - 1) as f64) as usize)
                .copied()
                .unwrap_or(f64::NAN)
        };
        println!("{} views, {} false alarms", self.views, self.false_alarms);
        for part in [0.5, 0.9, 0.95, 0.99, 1.0] {
            println!("surprise at {part}: {:.2}", quantile(&mut self.surprise, part));
        }
        let [usual, worst] = [0.5, 0.99].map(|part| quantile(&mut self.milliseconds, part));
        println!("a view takes {usual:.1} ms, at 0.99 {worst:.1} ms");
        println!(
            "bumps: {} of {} not found in three views that count; {} told as such; in {} no three views count",
            self.late, self.bumps, self.bumps_told, self.too_few
        );
        println!(
            "small drifts: {} of {} within twice their uncertainty, {} alarms",
            self.small_within, self.small, self.small_alarms
        );
        println!(
            "joints: {} of {} told, {} alarms",
            self.joints_told, self.joints, self.joints_alarmed
        );
    }
}
