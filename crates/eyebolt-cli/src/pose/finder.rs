//! Poses in one frame after the other.

use super::arguments::Arguments;
use super::lines::Line;
use anyhow::Result;
use eyebolt::pose::{EndEffectorShape, PoseEstimator, PoseMethod, Recognizer};
use eyebolt::record::{FrameImage, FrameImages};
use eyebolt_recording::Recording;
use eyebolt_robot::Arm;

/// Finds the pose of the end-effector in one frame after the other.
pub(super) struct Finder<'a> {
    arguments: &'a Arguments,
    recognizer: Recognizer,
    estimator: PoseEstimator,
    images: FrameImages,
}

impl<'a> Finder<'a> {
    /// Of `arm`, in the frames of `recording`.
    pub(super) fn new(
        arguments: &'a Arguments,
        arm: &Arm,
        recording: &Recording<'_>,
    ) -> Result<Self> {
        let shape = EndEffectorShape::of(arm, &arguments.cache.open())?;
        let recognizer = Recognizer::open(&arguments.model, shape.clone())?;
        let mut estimator = PoseEstimator::open(&arguments.model, shape, arguments.method)?;
        estimator.refines = !arguments.no_icp;
        let images = FrameImages::of(recording.source())?;
        Ok(Self { arguments, recognizer, estimator, images })
    }

    /// What is told of frame `index`.
    pub(super) fn line(&mut self, recording: &Recording<'_>, index: usize) -> Result<Line> {
        let Self { arguments, recognizer, estimator, images } = self;
        let frame = (recording.frame_names()[index].as_str(), recording.stamp_ns(index));
        let Some(FrameImage { depth, .. }) = images.read(recording.source(), index)? else {
            return Ok(Line::damaged(frame, arguments.method));
        };
        let read = || recording.source().read_joints(index);
        let joints = arguments.joint_states.then(read).transpose()?;
        let posture = joints.as_ref().map(|joints| estimator.shape().posture(joints));
        let seen = recognizer.recognize(&depth, images.camera(), posture.as_slice())?;
        let found = match (arguments.method, arguments.no_icp) {
            (PoseMethod::Fused, false) => seen.answer,
            _ => {
                let label = &seen.segmentation.label;
                estimator.estimate(&depth, images.camera(), label, joints.as_ref())?
            }
        };
        let how = (arguments.method, joints.is_some());
        Ok(Line::of(frame, how, found, images.optical_from_camera()))
    }
}
