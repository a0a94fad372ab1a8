//! How good a network's labels are where the truth is known: `segment_truth MODEL [ROBOT.urdf]`
//!
//! The paper's three test poses of the camera, its Kinect v1, six configurations each; then the same with
//! people and things in view that come and go. ROBOT is `shackle` unless a URDF is named. As the paper's table of
//! segmentation: precision and recall by point.
#![allow(clippy::print_stdout, reason = "what an example is for")]

use eyebolt::model_files::ModelFiles;
use eyebolt::robots::BuiltIn;
use eyebolt::segment::Confusion;
use eyebolt::segment::{Segmenter, UNKNOWN};
use eyebolt::simulate::{Faults, Lab, PRESETS, Scenario, Viewpoint, plan};
use eyebolt_recording::{FrameSource, Range};
use eyebolt_registration::LinkCache;
use eyebolt_render::Sensor;
use eyebolt_robot::{PackageRoots, Robot};

type Failure = Box<dyn std::error::Error>;

const CONFIGURATIONS: usize = 6;

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let model = arguments.next().ok_or("give MODEL [ROBOT.urdf]")?;
    let mut segmenter = Segmenter::open(&ModelFiles::at(model.into()))?;
    let (arm, urdf) = match arguments.next() {
        Some(path) => {
            let robot = Robot::from_urdf_file(path.as_ref(), &PackageRoots::new())?;
            (robot.arm(None, None)?, std::fs::read_to_string(path)?)
        }
        None => {
            let robot = BuiltIn::named("shackle").ok_or("no such robot")?;
            (robot.arm(), robot.urdf.to_owned())
        }
    };
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-segment-truth-links"));
    let sensor =
        *Sensor::ALL.iter().find(|sensor| sensor.name == "kinect-v1").ok_or("no Kinect")?;
    println!(
        "scene     end-effector precision recall   arm precision recall   background precision recall"
    );
    for passers_by in [0, 3] {
        let mut confusion = Confusion::new(3);
        for (index, preset) in PRESETS.iter().enumerate().filter(|(_, it)| it.name.contains("test"))
        {
            let lab = Lab { passers_by, ..Lab::default() };
            let scenario = Scenario {
                arm: &arm,
                urdf: &urdf,
                sensor,
                viewpoint: Viewpoint::Preset(preset),
                configurations: CONFIGURATIONS,
                frames: 1,
                moving_frames: 0,
                backgrounds: 0,
                clutter: if passers_by > 0 { 12 } else { 4 },
                faults: Faults { lab, ..Faults::default() },
                seed: 100 + index as u64,
            };
            let plan = plan(scenario, &cache)?;
            let source = plan.in_memory()?;
            let camera = source.camera().ok_or("no camera")?;
            for configuration in 0..CONFIGURATIONS {
                let frame = source.read_frame(configuration)?;
                let Range::Depth(depth) = &frame.range else { return Err("no depth".into()) };
                let found = segmenter.segment(depth, camera)?;
                let truth = plan.true_view(configuration).label.into_iter().zip(depth.depth_m());
                let truth: Vec<u8> =
                    truth.map(|(label, z)| if *z > 0.0 { label } else { UNKNOWN }).collect();
                confusion.add(&truth, &found.label);
            }
        }
        let [rest, arm, hand] = [0, 1, 2].map(|class| confusion.class(class));
        let shown = |score: eyebolt::segment::ClassScore| {
            format!("{:.3} {:.3}", score.precision, score.recall)
        };
        let scene = if passers_by > 0 { "people" } else { "plain" };
        let any = confusion.foreground();
        println!(
            "{scene:8}  {}   {}   {}   (whole arm IoU {:.3})",
            shown(hand),
            shown(arm),
            shown(rest),
            any.iou
        );
    }
    Ok(())
}
