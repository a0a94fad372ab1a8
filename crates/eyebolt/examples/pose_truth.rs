//! How far poses of an end-effector are off where the truth is known:
//!
//! ```text
//! pose_truth MODEL [ROBOT.urdf] [--frames N] [--each] [--only ROW] [--labels true|predicted] [--joint-states] [--sensor NAME]
//! ```
//!
//! The paper's three test poses of the camera, its Kinect v1, six configurations of ten frames each (or N). ROBOT is
//! `shackle` unless a URDF is named. As the paper's table of poses: mean and standard deviation of translation, rotation
//! and ADD, with true labels and with predicted ones.
#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::model_files::ModelFiles;
use eyebolt::pose::{EndEffectorShape, PoseAnswer, PoseEstimator, PoseMethod, Recognizer};
use eyebolt::robots::BuiltIn;
use eyebolt::segment::{END_EFFECTOR, Segmenter, UNKNOWN};
use eyebolt::simulate::{Faults, PRESETS, Plan, Scenario, Viewpoint, plan};
use eyebolt_geometry::{Camera, DepthImage, EndEffector, Transform};
use eyebolt_recording::{FrameSource, Range};
use eyebolt_registration::LinkCache;
use eyebolt_render::Sensor;
use eyebolt_robot::{Arm, JointPositions, PackageRoots, Robot};
use std::time::Instant;

type Failure = Box<dyn std::error::Error>;

const CONFIGURATIONS: usize = 6;
/// Points that ADD is a mean over.
const POINTS: usize = 1000;

/// How a pose is made, and its row of the table.
const ROWS: [(&str, PoseMethod, bool); 5] = [
    ("RPT", PoseMethod::Rpt, false),
    ("RPT + ICP", PoseMethod::Rpt, true),
    ("KPM", PoseMethod::Kpm, false),
    ("KPM + ICP", PoseMethod::Kpm, true),
    ("fused", PoseMethod::Fused, true),
];

/// Errors of one row.
#[derive(Default)]
struct Row {
    /// Whether every frame is told.
    each: bool,
    frames: usize,
    answered: usize,
    translation_mm: Vec<f64>,
    rotation_deg: Vec<f64>,
    add_mm: Vec<f64>,
    within_bound: usize,
    refused_right: usize,
    /// Pixels that are the end-effector's in truth, that are found to be, and both.
    pixels: [usize; 3],
}

impl Row {
    fn count(&mut self, truth: &[u8], found: &[u8], depth: &DepthImage) {
        for ((truth, found), z) in truth.iter().zip(found).zip(depth.depth_m()) {
            let [truth, found] = [truth, found].map(|of| *of == END_EFFECTOR && *z > 0.0);
            let counts = [truth, found, truth && found];
            self.pixels.iter_mut().zip(counts).for_each(|(sum, is)| *sum += usize::from(is));
        }
    }

    fn add(
        &mut self,
        shape: &EndEffectorShape,
        joints: &JointPositions,
        found: Option<&PoseAnswer>,
        truth: &Transform<Camera, EndEffector>,
    ) {
        self.frames += 1;
        let Some(found) = found else { return };
        let pose = found.camera_from_end_effector;
        let (metres, radians) = shape.apart(pose.isometry(), truth.isometry());
        let points = shape.end_effector.points(joints, POINTS);
        let add = |twin: &nalgebra::Isometry3<f64>| {
            let truth = truth.isometry() * twin;
            let off = points.iter().map(|point| (pose.isometry() * point - truth * point).norm());
            off.sum::<f64>() / points.len() as f64
        };
        let add = shape.twins().iter().map(add).fold(f64::INFINITY, f64::min);
        if self.each {
            let (support, refusal) = (found.support, found.refusal);
            let expected =
                found.expected_error.map_or((0.0, 0.0), |it| (it.translation_mm, it.rotation_deg));
            let ray = truth.translation_m().normalize();
            let off = pose.translation_m() - truth.translation_m();
            println!("  {:.2} m along {:.2} mm", truth.translation_m().norm(), 1e3 * off.dot(&ray));
            println!(
                "  ADD {:.2} mm, {:.2} mm {:.2} deg of expected {expected:.2?}, {:?}, {support:.3?} {refusal:?}",
                1e3 * add,
                1e3 * metres,
                radians.to_degrees(),
                found.source
            );
            for rival in &found.rivals {
                let (other, of) = (rival.camera_from_end_effector, rival.comparison);
                let apart = other.distance_to(&pose);
                println!(
                    "    rival {:.1} mm {:.1} deg apart: {:.2} +- {:.2} of {} pixels",
                    1e3 * apart.0,
                    apart.1.to_degrees(),
                    of.advantage,
                    of.deviation,
                    of.pixels
                );
            }
        }
        if found.refusal.is_some() {
            self.refused_right += usize::from(add < 0.01);
            return;
        }
        self.answered += 1;
        self.translation_mm.push(1e3 * metres);
        self.rotation_deg.push(radians.to_degrees());
        self.add_mm.push(1e3 * add);
        if let Some(expected) = found.expected_error {
            // Twice the root mean square of three numbers is beyond their 95 % bound.
            let within = 1e3 * metres < 1.6 * expected.translation_mm
                && radians.to_degrees() < 1.6 * expected.rotation_deg;
            self.within_bound += usize::from(within);
        }
    }

    fn text(&self) -> String {
        let both = |values: &[f64]| {
            let count = values.len().max(1) as f64;
            let mean = values.iter().sum::<f64>() / count;
            let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count;
            let mut sorted = values.to_vec();
            sorted.sort_by(f64::total_cmp);
            let median = sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN);
            format!("{mean:6.2} +- {:6.2} ({median:5.2})", variance.sqrt())
        };
        let far = self.add_mm.iter().filter(|add| **add > 10.0).count();
        format!(
            "{} mm  {} deg  ADD {}  labels {:.3}/{:.3}  answered {}/{} (beyond 10 mm {far}, right but refused {}, within bound {})",
            both(&self.translation_mm),
            both(&self.rotation_deg),
            both(&self.add_mm),
            self.pixels[2] as f64 / self.pixels[1].max(1) as f64,
            self.pixels[2] as f64 / self.pixels[0].max(1) as f64,
            self.answered,
            self.frames,
            self.refused_right,
            self.within_bound,
        )
    }
}

fn main() -> Result<(), Failure> {
    let (mut model, mut urdf, mut frames, mut each) = (None, None, 10, false);
    let (mut only, mut labels, mut joint_states) = (None, None, false);
    let mut sensor = "kinect-v1".to_owned();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--frames" => frames = arguments.next().ok_or("--frames N")?.parse()?,
            "--each" => each = true,
            "--joint-states" => joint_states = true,
            "--only" => only = arguments.next(),
            "--labels" => labels = arguments.next(),
            "--sensor" => sensor = arguments.next().ok_or("--sensor NAME")?,
            _ if model.is_none() => model = Some(argument),
            _ => urdf = Some(argument),
        }
    }
    let model = model.ok_or("give MODEL [ROBOT.urdf]")?;
    let model = ModelFiles::at(model.into());
    let (arm, urdf) = robot(urdf.as_deref())?;
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-pose-truth-links"));
    let shape = EndEffectorShape::of(&arm, &cache)?;
    let sensor: Sensor = sensor.parse()?;
    let wanted = |of: bool| labels.as_deref().is_none_or(|labels| (labels == "true") == of);
    for true_labels in [true, false].into_iter().filter(|of| wanted(*of)) {
        println!("{} labels", if true_labels { "true" } else { "predicted" });
        let wanted = |row: &&(&str, PoseMethod, bool)| only.as_deref().is_none_or(|it| it == row.0);
        for (name, method, refines) in ROWS.iter().filter(wanted).copied() {
            let Ok(mut estimator) = PoseEstimator::open(&model, shape.clone(), method) else {
                continue;
            };
            estimator.refines = refines;
            let mut recognizer = match true_labels {
                true => None,
                false => Some(Recognizer::new(
                    Segmenter::open(&model)?,
                    PoseEstimator::open(&model, shape.clone(), PoseMethod::Fused)?,
                )),
            };
            let (mut row, mut seconds) = (Row { each, ..Row::default() }, 0.0);
            for (index, preset) in
                PRESETS.iter().enumerate().filter(|(_, it)| it.name.contains("test"))
            {
                let plan = plan(
                    scenario(&arm, &urdf, (sensor, Viewpoint::Preset(preset)), frames, index),
                    &cache,
                )?;
                let source = plan.in_memory()?;
                let camera = source.camera().ok_or("no camera")?;
                for frame in 0..CONFIGURATIONS * frames {
                    let (joints, truth) = truth(&arm, &plan, &source, frame)?;
                    let Range::Depth(depth) = &source.read_frame(frame)?.range else {
                        return Err("no depth".into());
                    };
                    let truth_of_labels = plan.true_view(frame / frames).label;
                    let begun = Instant::now();
                    let label = match &mut recognizer {
                        None => {
                            let truth = truth_of_labels.into_iter();
                            truth
                                .zip(depth.depth_m())
                                .map(|(label, z)| if *z > 0.0 { label } else { UNKNOWN })
                                .collect()
                        }
                        Some(recognizer) => {
                            let found = recognizer.recognize(depth, camera, &[])?;
                            let label = found.segmentation.label;
                            row.count(&truth_of_labels, &label, depth);
                            if method == PoseMethod::Fused && !joint_states {
                                // As the program does it.
                                seconds += begun.elapsed().as_secs_f64();
                                row.add(&shape, &joints, found.answer.as_ref(), &truth);
                                continue;
                            }
                            label
                        }
                    };
                    let begun = Instant::now();
                    let found = estimator.estimate(
                        depth,
                        camera,
                        &label,
                        joint_states.then_some(&joints),
                    )?;
                    seconds += begun.elapsed().as_secs_f64();
                    row.add(&shape, &joints, found.as_ref(), &truth);
                }
            }
            println!(
                "{name:10} {}  {:.1} ms",
                row.text(),
                1e3 * seconds / row.frames.max(1) as f64
            );
        }
    }
    Ok(())
}

fn robot(urdf: Option<&str>) -> Result<(Arm, String), Failure> {
    match urdf {
        Some(path) => {
            let robot = Robot::from_urdf_file(path.as_ref(), &PackageRoots::new())?;
            Ok((robot.arm(None, None)?, std::fs::read_to_string(path)?))
        }
        None => {
            let robot = BuiltIn::named("shackle").ok_or("no such robot")?;
            Ok((robot.arm(), robot.urdf.to_owned()))
        }
    }
}

fn scenario<'a>(
    arm: &'a Arm,
    urdf: &'a str,
    (sensor, viewpoint): (Sensor, Viewpoint),
    frames: usize,
    index: usize,
) -> Scenario<'a> {
    Scenario {
        arm,
        urdf,
        sensor,
        viewpoint,
        configurations: CONFIGURATIONS,
        frames,
        moving_frames: 0,
        backgrounds: 0,
        clutter: 4,
        faults: Faults::default(),
        seed: 100 + index as u64,
    }
}

/// Joints in a frame, and where the end-effector is.
fn truth(
    arm: &Arm,
    plan: &Plan<'_>,
    source: &dyn FrameSource,
    frame: usize,
) -> Result<(JointPositions, Transform<Camera, EndEffector>), Failure> {
    let joints = source.read_frame(frame)?.joints;
    let base_from_end_effector = arm.base_from_end_effector(&joints)?;
    Ok((joints, plan.camera_from_base() * base_from_end_effector))
}
