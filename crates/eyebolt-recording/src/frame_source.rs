//! What everything above knows of a recording.

use crate::color::{CameraPicture, ColorImage};
use crate::error::RecordingError;
use crate::frame::Frame;
use crate::manifest::RobotSection;
use crate::message::StaticTransform;
use crate::provenance::{Provenance, UNKNOWN};
use eyebolt_geometry::{DepthImage, PinholeCamera, Transform};
use eyebolt_robot::JointPositions;
use std::fmt::Debug;
use std::path::Path;

/// A source of frames: depth and joint positions, whatever they are stored in.
///
/// Frames are numbered from 0, in the order of [`Self::frame_names`], and read when asked for, from as many
/// threads as wanted. Everything is in metres, radians and the optical frame (x right, y down, z
/// forward).
///
/// Asked again, a source answers the same; frames may be appended in between.
pub trait FrameSource: Debug + Send + Sync {
    /// The camera, unless the frames are clouds without one.
    fn camera(&self) -> Option<&PinholeCamera>;

    /// Name of the camera's optical frame in ROS, where the source knows it.
    fn camera_frame_id(&self) -> Option<&str> {
        None
    }

    /// Transforms between frames that never move against each other, as the source knows them
    /// (`/tf_static`): of the camera's frames, of the robot's, or of others.
    fn static_transforms(&self) -> &[StaticTransform] {
        &[]
    }

    /// What the source says of the robot.
    fn robot(&self) -> &RobotSection {
        &NO_ROBOT
    }

    /// Names of the frames, in their order, each once.
    fn frame_names(&self) -> &[String];

    /// When frame `index` was taken, nanoseconds, by the clock of the depth; `None` where nobody knows.
    fn stamp_ns(&self, _index: usize) -> Option<i64> {
        None
    }

    /// Whether frames come with masks of the arm.
    fn has_masks(&self) -> bool {
        false
    }

    /// Reads frame `index`.
    ///
    /// # Errors
    ///
    /// No such frame, or one that cannot be read; see [`Self::may_leave_out`].
    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError>;

    /// Positions of the joints in frame `index`, without what the camera saw: radians, metres for
    /// prismatic joints.
    ///
    /// # Errors
    ///
    /// No such frame, or positions that cannot be read.
    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError>;

    /// Reads the colour picture of frame `index`; `None` if there is none.
    ///
    /// # Errors
    ///
    /// No such frame, or a picture that cannot be read.
    fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        check_index(self, index).map(|()| None)
    }

    /// Reads the colour picture of frame `index` as it was taken, for those who measure in it; `None` if there
    /// is none, or nobody knows by which camera.
    ///
    /// # Errors
    ///
    /// As [`Self::read_color`].
    fn read_picture(&self, index: usize) -> Result<Option<CameraPicture>, RecordingError> {
        let (Some(picture), Some(camera)) = (self.read_color(index)?, self.camera()) else {
            return Ok(None);
        };
        let fits = (picture.width, picture.height) == (camera.width(), camera.height());
        let camera = camera.clone();
        let depth_from_color = Transform::identity();
        Ok(fits.then_some(CameraPicture { picture, camera, depth_from_color }))
    }

    /// Number of depth images of the scene without the robot, or with the robot out of view.
    fn background_count(&self) -> usize {
        0
    }

    /// Reads background `index`: depth of the camera's size in metres, 0 where there is none. There
    /// may be none at all, where the scene is out of range.
    ///
    /// # Errors
    ///
    /// No such background, or one that cannot be read or is not of the camera's size; see
    /// [`Self::may_leave_out`].
    fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        let path = Path::new(&self.provenance().name).to_path_buf();
        Err(RecordingError::NoSuchBackground { path, index, count: self.background_count() })
    }

    /// Whether a frame or a background whose reading fails with `error` may be left out, since it
    /// is one of many and saw nothing, or is damaged and that was said to be no matter.
    fn may_leave_out(&self, _error: &RecordingError) -> bool {
        false
    }

    /// Whether depth is stored in whole millimetres.
    fn in_millimetres(&self) -> bool {
        false
    }

    /// What one of the integers is that depth is stored in, metres; `None` where it is stored in
    /// floats, or nobody knows. Drivers differ in it by factors of 4 to 10.
    fn integer_unit_m(&self) -> Option<f64> {
        None
    }

    /// Whether backgrounds are stored in whole millimetres.
    fn backgrounds_in_millimetres(&self) -> bool {
        false
    }

    /// Where the frames come from, and what was found out on the way.
    fn provenance(&self) -> &Provenance {
        &UNKNOWN
    }
}

/// Nothing said of a robot.
static NO_ROBOT: RobotSection =
    RobotSection { urdf: None, description: None, base: None, end_effector: None };

/// Refuses the index of a frame that is not there.
pub(crate) fn check_index(
    source: &(impl FrameSource + ?Sized),
    index: usize,
) -> Result<(), RecordingError> {
    let count = source.frame_names().len();
    if index < count {
        return Ok(());
    }
    let path = Path::new(&source.provenance().name).to_path_buf();
    Err(RecordingError::NoSuchFrame { path, index, count })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Range;

    /// As little as a source can have.
    #[derive(Debug)]
    struct Least(Frame, Vec<String>);

    impl FrameSource for Least {
        fn camera(&self) -> Option<&PinholeCamera> {
            None
        }

        fn frame_names(&self) -> &[String] {
            &self.1
        }

        fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
            check_index(self, index).map(|()| self.0.clone())
        }

        fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
            self.read_frame(index).map(|frame| frame.joints)
        }
    }

    #[test]
    fn what_a_source_does_not_tell_is_not_there() {
        let depth = DepthImage::new(1, 1, vec![1.0]).unwrap();
        let (range, joints) = (Range::Depth(depth), JointPositions::default());
        let frame = Frame { name: "a".to_owned(), range, mask: None, joints };
        let least = Least(frame, vec!["a".to_owned()]);
        assert!(least.read_color(0).unwrap().is_none());
        assert!(least.read_picture(0).unwrap().is_none());
        assert_eq!(least.stamp_ns(0), None);
        let error = least.read_color(1).unwrap_err();
        assert!(matches!(error, RecordingError::NoSuchFrame { index: 1, count: 1, .. }));
        let error = least.read_background(0).unwrap_err();
        assert!(matches!(error, RecordingError::NoSuchBackground { index: 0, count: 0, .. }));
        assert!(!least.may_leave_out(&error) && !least.has_masks() && !least.in_millimetres());
        assert_eq!(least.robot(), &RobotSection::default());
        assert_eq!(least.provenance(), &Provenance::default());
    }
}
