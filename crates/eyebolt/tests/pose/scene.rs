//! The built-in robot before the paper's camera.

use eyebolt::pose::EndEffectorShape;
use eyebolt::robots::BuiltIn;
use eyebolt::segment::UNKNOWN;
use eyebolt::simulate::{Faults, PRESETS, Scenario, Viewpoint, plan};
use eyebolt_geometry::{Base, Camera, DepthImage, PinholeCamera, Transform};
use eyebolt_recording::{FrameSource, Range};
use eyebolt_registration::LinkCache;
use eyebolt_render::Sensor;
use eyebolt_robot::JointPositions;
use std::sync::LazyLock;

/// A frame with the truth about it.
pub struct Truth {
    /// What an ideal camera would see.
    pub ideal: DepthImage,
    /// What the camera saw.
    pub depth: DepthImage,
    pub camera: PinholeCamera,
    /// Of each pixel with depth, its class.
    pub label: Vec<u8>,
    pub joints: JointPositions,
    /// Pose of the end-effector, as of the base of its shape.
    pub pose: Transform<Camera, Base>,
}

fn cache() -> LinkCache {
    LinkCache::new(std::env::temp_dir().join("eyebolt-test-links"))
}

pub static SHAPE: LazyLock<EndEffectorShape> = LazyLock::new(|| {
    EndEffectorShape::of(&BuiltIn::named("shackle").unwrap().arm(), &cache()).unwrap()
});

/// Six configurations before one of the paper's test poses.
pub fn frames(preset: &str) -> Vec<Truth> {
    let robot = BuiltIn::named("shackle").unwrap();
    let arm = robot.arm();
    let preset = PRESETS.iter().find(|it| it.name == preset).unwrap();
    let scenario = Scenario {
        arm: &arm,
        urdf: robot.urdf,
        sensor: *Sensor::ALL.iter().find(|sensor| sensor.name == "kinect-v1").unwrap(),
        viewpoint: Viewpoint::Preset(preset),
        configurations: 6,
        frames: 1,
        moving_frames: 0,
        backgrounds: 0,
        clutter: 2,
        faults: Faults::default(),
        seed: 11,
    };
    let plan = plan(scenario, &cache()).unwrap();
    let source = plan.in_memory().unwrap();
    let camera = source.camera().unwrap().clone();
    let truth = |index: usize| {
        let frame = source.read_frame(index).unwrap();
        let Range::Depth(depth) = frame.range else { panic!("a cloud") };
        let view = plan.true_view(index);
        let labels = view.label.into_iter().zip(depth.depth_m());
        let label = labels.map(|(label, z)| if *z > 0.0 { label } else { UNKNOWN }).collect();
        let ideal = DepthImage::new(camera.width(), camera.height(), view.view.depth_m).unwrap();
        let hand = arm.base_from_end_effector(&frame.joints).unwrap();
        let pose = Transform::from_isometry(plan.camera_from_base().isometry() * hand.isometry());
        let (camera, joints) = (camera.clone(), frame.joints);
        Truth { ideal, depth, camera, label, joints, pose }
    };
    (0..6).map(truth).collect()
}
