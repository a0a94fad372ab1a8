//! What is written, as readers of recordings find it.

use crate::shapes;
use crate::stage::{AS_SAID, Recorded, SENSOR, apart, bytes, planned, small};
use eyebolt::simulate::{Plan, Scenario};
use eyebolt_render::Sensor;
use nalgebra::Point2;

fn full() -> Scenario<'static> {
    Scenario { configurations: 3, frames: 4, moving_frames: 5, backgrounds: 3, ..small() }
}

#[test]
fn it_has_what_was_planned() {
    let recorded = Recorded::of(full());
    let bag = recorded.recording.bag().unwrap();
    assert_eq!((recorded.count(), recorded.recording.background_count()), (12, 3));
    assert_eq!(recorded.count() + bag.dropped_frames().len(), 12 + 2 * 5);
    assert!(bag.damage().is_empty());
    assert!(!recorded.recording.has_masks());
    let robot = recorded.recording.robot();
    assert_eq!(
        (robot.base.as_deref(), robot.end_effector.as_deref()),
        (Some("link0"), Some("hand"))
    );
    let camera = recorded.recording.camera().unwrap();
    assert_eq!(camera, &SENSOR.camera());
    // Frames of one configuration have the same joints, those of another other ones.
    let joints = recorded.joints();
    for rest in joints.chunks(4) {
        assert!(rest.iter().all(|joints| apart(joints, &rest[0]) < 2.0 * AS_SAID));
    }
    assert!(apart(&joints[0], &joints[4]) > 0.2 && apart(&joints[4], &joints[8]) > 0.2);
}

/// Largest distance of depth that is recorded from the formulas' at a grid of pixels, but for those
/// at edges, metres; and how many pixels were compared.
pub fn misfit(plan: &Plan<'_>, recorded: &Recorded, frame: usize) -> (f64, usize) {
    const STEP: usize = 4;
    let camera = SENSOR.camera();
    let joints = recorded.recording.read_joints(frame).unwrap();
    let scene: Vec<_> = shapes::arm(&joints).into_iter().chain(shapes::room(plan)).collect();
    let depth = recorded.depth(frame);
    let base_from_camera = recorded.base_from_camera(frame);
    let (mut worst, mut compared) = (0.0_f64, 0);
    for v in (1..camera.height() - 1).step_by(STEP) {
        for u in (1..camera.width() - 1).step_by(STEP) {
            let around = [(0, 0), (2, 0), (0, 2), (2, 2), (1, 1)];
            let around = around.map(|(du, dv)| f64::from(depth.at(u + du - 1, v + dv - 1)));
            let z = around[4];
            let smooth = around.iter().all(|other| (other - z).abs() < 0.01);
            let pixel = Point2::new(f64::from(u), f64::from(v));
            let seen = shapes::seen(&scene, &camera, &base_from_camera, &pixel);
            let Some((expected, _)) = seen.filter(|_| smooth && z > 0.0) else { continue };
            worst = worst.max((expected - z).abs());
            compared += 1;
        }
    }
    (worst, compared)
}

/// Round shapes are drawn with flat sides.
pub const FLAT_SIDES_M: f64 = 1.5e-3;

#[test]
fn depth_is_what_formulas_say() {
    let mut scenario = Scenario { moving_frames: 2, ..small() };
    for in_millimetres in [false, true] {
        scenario.sensor.in_millimetres = in_millimetres;
        let plan = planned(scenario.clone());
        let recorded = Recorded::of_plan(&plan);
        assert_eq!(recorded.recording.in_millimetres(), in_millimetres);
        for frame in [0, 3] {
            let (worst, compared) = misfit(&plan, &recorded, frame);
            assert!(worst < FLAT_SIDES_M && compared > 3000, "{worst} m of {compared}");
        }
    }
}

#[test]
fn millimetres_are_rounded_to_the_nearest() {
    let mut scenario = small();
    let exact = Recorded::of(scenario.clone());
    scenario.sensor.in_millimetres = true;
    let rounded = Recorded::of(scenario);
    let (exact, rounded) = (exact.depth(1), rounded.depth(1));
    for (exact, rounded) in exact.depth_m().iter().zip(rounded.depth_m()) {
        assert!((exact - rounded).abs() < 0.501e-3, "{exact} {rounded}");
    }
}

/// A background is a frame but for the arm: what it shows is nowhere before what a frame shows.
#[test]
fn backgrounds_are_the_scene_without_the_arm() {
    let recorded = Recorded::of(Scenario { backgrounds: 2, clutter: 3, ..small() });
    let background = recorded.recording.read_background(1).unwrap();
    assert_eq!(recorded.recording.read_background(0).unwrap(), background);
    let depth = recorded.depth(0);
    let pairs = || background.depth_m().iter().zip(depth.depth_m());
    assert!(pairs().all(|(behind, z)| *z <= behind + 1e-5));
    let same = pairs().filter(|(behind, z)| behind == z).count();
    let before = pairs().filter(|(behind, z)| **z < **behind - 0.02).count();
    assert!(same > 50_000 && before > 2_500, "{same} {before}");
}

#[test]
fn the_bytes_are_those_of_the_seed_on_any_number_of_threads() {
    let scenario = Scenario {
        sensor: Sensor::KINECT_V1,
        moving_frames: 1,
        backgrounds: 1,
        clutter: 3,
        ..small()
    };
    let on = |threads: usize, scenario: Scenario<'static>| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bytes(&planned(scenario)))
    };
    let expected = on(1, scenario.clone());
    assert!(on(2, scenario.clone()) == expected);
    assert!(on(3, Scenario { seed: 8, ..scenario }) != expected);
}

#[test]
fn noise_differs_from_frame_to_frame() {
    let recorded = Recorded::of(Scenario { sensor: Sensor::KINECT_V1, backgrounds: 2, ..small() });
    assert_ne!(recorded.depth(0), recorded.depth(1));
    let background = |index| recorded.recording.read_background(index).unwrap();
    assert_ne!(background(0), background(1));
}

/// Keeps what it hears, and ends the work after so many words.
struct Heard {
    told: std::cell::RefCell<Vec<(usize, usize)>>,
    patience: usize,
}

impl eyebolt::progress::Progress for Heard {
    fn begin(&self, _: &'static str) -> Result<(), eyebolt::progress::Cancelled> {
        Ok(())
    }

    fn advance(&self, done: usize, total: usize) -> Result<(), eyebolt::progress::Cancelled> {
        self.told.borrow_mut().push((done, total));
        match self.told.borrow().len() <= self.patience {
            true => Ok(()),
            false => Err(eyebolt::progress::Cancelled),
        }
    }
}

#[test]
fn whoever_wants_an_end_gets_one() {
    let plan = planned(full());
    let mut output = std::io::Cursor::new(Vec::new());
    let heard = Heard { told: Vec::new().into(), patience: usize::MAX };
    plan.record(&mut output, &heard).unwrap();
    let told = heard.told.into_inner();
    assert!(told.windows(2).all(|pair| pair[0].0 < pair[1].0), "it gets on");
    assert_eq!(told.last(), Some(&(3 + 12 + 10, 3 + 12 + 10)));
    let heard = Heard { told: Vec::new().into(), patience: 4 };
    let stopped = plan.record(&mut output, &heard);
    assert!(stopped.unwrap_err().to_string().contains("stop"));
    assert_eq!(heard.told.into_inner().len(), 5, "nothing more is done");
}
