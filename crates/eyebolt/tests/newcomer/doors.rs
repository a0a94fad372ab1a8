//! Labels, poses and progress of one's own.

use crate::run::{MASKED, difference, truth};
use crate::scene::{CAMERA, CAMERA_FROM_BASE, JOINT_NAMES, Shot, URDF, shots};
use eyebolt::calibrate::Verdict;
use eyebolt::label::{GivenMasks, Labeller, Labelling, PosedModel};
use eyebolt::observations::Observations;
use eyebolt::pipeline::{Failure, Request, run};
use eyebolt::pose::{Hypothesis, PoseProposer};
use eyebolt::progress::{Cancelled, Progress, Step};
use eyebolt::record::{RecordOptions, observe};
use eyebolt_geometry::{DepthImage, Mask};
use eyebolt_recording::{Frame, FrameSource, InMemory, Range, RecordingError};
use eyebolt_registration::{Label, Labels, LinkCache};
use eyebolt_robot::{Arm, JointPositions, PackageRoots, Robot};
use std::cell::RefCell;
use std::error::Error;

fn arm() -> Arm {
    let robot = Robot::from_urdf_str(URDF, None, &PackageRoots::new()).unwrap();
    robot.arm(Some("base"), Some("hand")).unwrap()
}

/// The shots in memory, with their masks.
fn source(shots: Vec<Shot>) -> InMemory {
    let (width, height) = (CAMERA.width(), CAMERA.height());
    let mut source = InMemory::new(CAMERA.clone());
    for (number, shot) in shots.into_iter().enumerate() {
        let joints = JOINT_NAMES.iter().zip(shot.joints);
        let frame = Frame {
            name: number.to_string(),
            range: Range::Depth(DepthImage::new(width, height, shot.depth_m).unwrap()),
            mask: Some(Mask::new(width, height, shot.mask).unwrap()),
            joints: joints.map(|(name, rad)| ((*name).to_owned(), rad)).collect(),
        };
        source.push_frame(frame).unwrap();
    }
    source
}

/// Somebody who knows where the camera is, to a few centimetres.
#[derive(Debug)]
struct Tip;

impl PoseProposer for Tip {
    fn propose(
        &self,
        _: &Observations,
        labelling: &Labelling,
    ) -> Result<Vec<Hypothesis>, Box<dyn Error + Send + Sync>> {
        assert!(labelling.labels.iter().all(|labels| labels.count(Label::Arm) > 1000));
        let off = nalgebra::Vector6::new(0.03, -0.02, 0.02, 0.03, 0.02, -0.03);
        Ok(vec![Hypothesis { camera_from_base: CAMERA_FROM_BASE.retract(&off), score: 0.0 }])
    }
}

#[test]
fn a_labeller_and_a_proposer_of_ones_own() {
    let (source, arm) = (source(shots()), arm());
    let request = Request {
        labeller: Some(&GivenMasks),
        proposer: Some(&Tip),
        ..Request::new(&source, &arm)
    };
    let outcome = run(&request, &()).unwrap();
    assert_eq!(outcome.calibration.verdict, Verdict::Trusted);
    let pose = outcome.calibration.camera_from_base.unwrap();
    let (mm, degrees) = difference(&pose, &truth());
    assert!(mm < MASKED.0 && degrees < MASKED.1, "{mm} mm, {degrees} degrees");
}

/// Nobody who has no idea is given one.
#[test]
fn without_a_hypothesis_there_is_no_answer() {
    #[derive(Debug)]
    struct Clueless;
    impl PoseProposer for Clueless {
        fn propose(
            &self,
            _: &Observations,
            _: &Labelling,
        ) -> Result<Vec<Hypothesis>, Box<dyn Error + Send + Sync>> {
            Ok(Vec::new())
        }
    }
    let (source, arm) = (source(shots()), arm());
    let request = Request { proposer: Some(&Clueless), ..Request::new(&source, &arm) };
    let outcome = run(&request, &()).unwrap();
    assert_eq!(outcome.calibration.camera_from_base, None);
    assert_ne!(outcome.calibration.verdict, Verdict::Trusted);
}

/// Ends the work when a stage begins.
struct Until {
    stage: &'static str,
    heard: RefCell<Vec<&'static str>>,
}

impl Progress for Until {
    fn begin(&self, stage: &'static str) -> Result<(), Cancelled> {
        self.heard.borrow_mut().push(stage);
        if stage == self.stage { Err(Cancelled) } else { Ok(()) }
    }

    fn advance(&self, done: usize, total: usize) -> Result<(), Cancelled> {
        assert!(done <= total);
        Ok(())
    }
}

#[test]
fn work_ends_where_it_is_ended() {
    let (source, arm) = (source(shots()), arm());
    let request = Request::new(&source, &arm);
    let stages = Step::ALL.map(Step::name);
    for (number, stage) in stages.iter().enumerate().take(5) {
        let progress = Until { stage, heard: RefCell::default() };
        assert!(matches!(run(&request, &progress), Err(Failure::Cancelled(_))), "{stage}");
        assert_eq!(progress.heard.into_inner(), stages[..=number]);
    }
}

/// Labels of a posed model against what was drawn: the arm is the arm, and the hand its end.
#[test]
fn a_posed_model_tells_the_end_effector_from_the_arm() {
    let (source, arm) = (source(shots()), arm());
    let options = RecordOptions { use_masks: false, ..RecordOptions::default() };
    let observations = observe(&source, &arm, &LinkCache::disabled(), &options).unwrap();
    let labels = PosedModel { at: truth().into() }.label(&observations).unwrap().labels;
    let (width, height) = (CAMERA.width(), CAMERA.height());
    for (labels, shot) in labels.iter().zip(shots()) {
        let found = labels.robot_mask(width, height);
        let drawn = Mask::new(width, height, shot.mask).unwrap();
        let clear = drawn.eroded(3);
        let pairs = || found.as_slice().iter().zip(clear.as_slice()).zip(&shot.depth_m);
        let seen = pairs().filter(|((_, clear), z)| **clear && **z > 0.0).count();
        let both = pairs().filter(|((found, clear), z)| **found && **clear && **z > 0.0).count();
        assert!(both * 100 > seen * 97, "{both} of {seen}");
        let (hand, rest) = (labels.count(Label::EndEffector), labels.count(Label::Arm));
        assert!(hand > 100 && rest > 2 * hand, "{hand} of the hand, {rest} of the rest");
    }
}

/// Labels one configuration, whatever there are.
#[derive(Debug)]
struct Lazy;

impl Labeller for Lazy {
    fn label(&self, _: &Observations) -> Result<Labelling, Box<dyn Error + Send + Sync>> {
        let labels = vec![Labels::from_fn(0..0, 0..0, |_, _| Label::Background)];
        Ok(Labelling { labels, whole_arm: true })
    }
}

#[test]
fn a_labeller_that_leaves_configurations_out_is_an_error() {
    let (source, arm) = (source(shots()), arm());
    let request = Request { labeller: Some(&Lazy), ..Request::new(&source, &arm) };
    let failed = run(&request, &()).unwrap_err();
    assert!(matches!(failed, Failure::Labels { found: 1, wanted: 5 }), "{failed}");
}

/// The frames of another source, one of its images or its background cut.
#[derive(Debug)]
struct Cut {
    whole: InMemory,
    frame: Option<usize>,
}

impl FrameSource for Cut {
    fn camera(&self) -> Option<&eyebolt_geometry::PinholeCamera> {
        self.whole.camera()
    }

    fn frame_names(&self) -> &[String] {
        self.whole.frame_names()
    }

    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let frame = self.whole.read_frame(index)?;
        let range = match self.frame == Some(index) {
            true => Range::Depth(DepthImage::new(2, 2, vec![1.0; 4]).unwrap()),
            false => frame.range,
        };
        Ok(Frame { range, mask: None, ..frame })
    }

    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        self.whole.read_joints(index)
    }

    fn background_count(&self) -> usize {
        1
    }

    fn read_background(&self, _: usize) -> Result<DepthImage, RecordingError> {
        Ok(DepthImage::new(3, 1, vec![2.0; 3]).unwrap())
    }
}

#[test]
fn images_of_another_size_than_the_cameras_are_errors() {
    let arm = arm();
    for (frame, named) in [(Some(3), "frame 3"), (None, "background 0")] {
        let source = Cut { whole: source(shots()), frame };
        let failed = run(&Request::new(&source, &arm), &()).unwrap_err().to_string();
        assert!(failed.contains(named) && failed.contains("pixels"), "{failed}");
    }
}
