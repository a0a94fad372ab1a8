//! What is learned from windows around an end-effector, and views of it.

use crate::small::{Memory, Until, end_effector_lesson, hand, plan};
use eyebolt::robots::BuiltIn;
use eyebolt::segment::{ARM, END_EFFECTOR, EndEffectorNet};
use eyebolt::simulate::{Faults, PRESETS, Scenario, Viewpoint, plan as plan_of};
use eyebolt::train::{Beginning, teach};
use eyebolt_geometry::{DepthImage, PinholeCamera, RayTable};
use eyebolt_recording::FrameSource;
use eyebolt_registration::LinkCache;
use eyebolt_render::Sensor;
use nalgebra::{Isometry3, Point3};

/// A hand is told from its arm, and found along it by a segmentation that does not know of hands.
#[test]
fn a_short_lesson_tells_a_hand_from_its_arm() {
    let lesson = end_effector_lesson();
    let mut keep = Memory::default();
    let model =
        teach(&lesson, &plan(200, 100), Beginning::Anew, &mut keep, &Until(usize::MAX)).unwrap();
    let metrics = &model.description.metrics;
    assert!(metrics["end_effector_iou"] > 0.4, "{metrics:?}");
    let mut net = EndEffectorNet::new(model).unwrap();
    let (depth, camera, truth) = ideal_view();
    let rays = RayTable::new(&camera);
    let (mut right, mut wrong) = (0, 0);
    let mut label: Vec<u8> = truth.iter().map(|label| (*label).min(ARM)).collect();
    net.refine(&depth, &camera, &rays, &mut label).unwrap();
    for (found, truth) in label.iter().zip(&truth) {
        match (*found == END_EFFECTOR, *truth == END_EFFECTOR) {
            (true, true) => right += 1,
            (false, false) => {}
            _ => wrong += 1,
        }
    }
    assert!(right > wrong && right > 200, "{right} right, {wrong} wrong");
}

/// Depth and labels of the built-in robot on its table, without the faults of a camera.
fn ideal_view() -> (DepthImage, PinholeCamera, Vec<u8>) {
    let robot = BuiltIn::named("shackle").unwrap();
    let cache = LinkCache::new(std::env::temp_dir().join("eyebolt-test-links"));
    let scenario = Scenario {
        arm: &robot.arm(),
        urdf: robot.urdf,
        sensor: *Sensor::ALL.iter().find(|sensor| sensor.name == "kinect-v1").unwrap(),
        viewpoint: Viewpoint::Preset(&PRESETS[0]),
        configurations: 1,
        frames: 1,
        moving_frames: 0,
        backgrounds: 0,
        clutter: 0,
        faults: Faults::default(),
        seed: 3,
    };
    let plan = plan_of(scenario, &cache).unwrap();
    let camera = plan.in_memory().unwrap().camera().unwrap().clone();
    let view = plan.true_view(0);
    let depth = DepthImage::new(camera.width(), camera.height(), view.view.depth_m).unwrap();
    (depth, camera, view.label)
}

/// However a view is rolled, its points are on the end-effector where the truth has it; no two views are alike.
#[test]
fn views_of_one_image_agree_with_the_truth() {
    let hand = hand();
    let views = hand.views(3, 5, 8).unwrap();
    assert!(views.len() >= 6, "{}", views.len());
    for view in &views {
        let surface = hand.end_effector.points(&view.joints, 3000);
        let end_effector_from_view: Isometry3<f64> =
            view.view_from_end_effector.inverse().isometry().to_owned();
        let distance = |point: &[f32; 3]| {
            let point = end_effector_from_view * Point3::from(*point).cast::<f64>();
            let distances = surface.iter().map(|of| (of - point).norm());
            distances.fold(f64::INFINITY, f64::min)
        };
        let mut off: Vec<f64> = view.view.points_m.iter().map(distance).collect();
        off.sort_by(f64::total_cmp);
        assert!(off[off.len() / 2] < 0.02, "{}", off[off.len() / 2]);
    }
    let turns: Vec<_> = views.iter().map(|view| view.view_from_end_effector.rotation()).collect();
    for (index, turn) in turns.iter().enumerate() {
        assert!(turns[index + 1..].iter().all(|other| other.angle_to(turn) > 1e-3));
    }
}
