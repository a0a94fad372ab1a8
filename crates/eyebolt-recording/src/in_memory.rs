//! Frames that are in memory and in no file.

mod borrowed;
mod millimetres;
mod place;

pub use borrowed::{BorrowedFrame, BorrowedFrames, Make};
pub use millimetres::depth_from_millimetres;

use crate::color::ColorImage;
use crate::error::RecordingError;
use crate::frame::{Frame, Range};
use crate::frame_source::{FrameSource, check_index};
use crate::manifest::RobotSection;
use crate::provenance::Provenance;
use eyebolt_geometry::{Cloud, DepthImage, Mask, PinholeCamera};
use eyebolt_robot::JointPositions;
use place::{NAME, Place};
use std::collections::BTreeSet;
use std::path::Path;

/// Frames in memory: from a driver, a queue that is still being filled, or arrays of another
/// language.
///
/// Whatever is put in is checked then, as the readers of files check it; errors name the frame.
///
/// ```
/// use eyebolt_geometry::{DepthImage, Distortion, PinholeCamera};
/// use eyebolt_recording::{FrameSource, InMemory};
///
/// let camera = PinholeCamera::new(4, 3, 5.0, 5.0, 1.5, 1.0, Distortion::None)?;
/// let mut frames = InMemory::new(camera);
/// let depth = DepthImage::new(4, 3, vec![1.25; 12])?;
/// let joints = [("shoulder".to_owned(), 0.5), ("elbow".to_owned(), -1.25)].into_iter().collect();
/// let index = frames.push("0", depth, joints)?;
/// assert_eq!(frames.read_joints(index)?.get("elbow"), Some(-1.25));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct InMemory {
    camera: Option<PinholeCamera>,
    camera_frame_id: Option<String>,
    robot: RobotSection,
    frames: Vec<Frame>,
    /// Of each frame.
    colors: Vec<Option<ColorImage>>,
    /// Of each frame, and the same to look them up.
    names: Vec<String>,
    known: BTreeSet<String>,
    backgrounds: Vec<DepthImage>,
    provenance: Provenance,
}

impl InMemory {
    /// No frames yet; they will be depth images or organised clouds of `camera`, or clouds without
    /// order.
    pub fn new(camera: PinholeCamera) -> Self {
        Self { camera: Some(camera), ..Self::of_clouds() }
    }

    /// No frames yet; they will be clouds of a camera that nobody knows.
    pub fn of_clouds() -> Self {
        let provenance =
            Provenance { name: NAME.to_owned(), kind: "memory", ..Provenance::default() };
        Self {
            camera: None,
            camera_frame_id: None,
            robot: RobotSection::default(),
            frames: Vec::new(),
            colors: Vec::new(),
            names: Vec::new(),
            known: BTreeSet::new(),
            backgrounds: Vec::new(),
            provenance,
        }
    }

    /// The same, called `name` in messages.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.provenance.name = name.into();
        self
    }

    /// The same, with the name of the camera's optical frame in ROS.
    #[must_use]
    pub fn with_camera_frame_id(mut self, frame_id: impl Into<String>) -> Self {
        self.camera_frame_id = Some(frame_id.into());
        self
    }

    /// The same, with what is known of the robot.
    #[must_use]
    pub fn with_robot(mut self, robot: RobotSection) -> Self {
        self.robot = robot;
        self
    }

    /// Appends a depth image with the positions of the joints (radians, metres for prismatic
    /// joints); its index.
    ///
    /// # Errors
    ///
    /// As of [`Self::push_frame`].
    pub fn push(
        &mut self,
        name: impl Into<String>,
        depth: DepthImage,
        joints: JointPositions,
    ) -> Result<usize, RecordingError> {
        self.push_frame(Frame { name: name.into(), range: Range::Depth(depth), mask: None, joints })
    }

    /// Appends a cloud, in metres in the optical frame, with the positions of the joints (radians,
    /// metres for prismatic joints); its index.
    ///
    /// # Errors
    ///
    /// As of [`Self::push_frame`].
    pub fn push_cloud(
        &mut self,
        name: impl Into<String>,
        cloud: Cloud,
        joints: JointPositions,
    ) -> Result<usize, RecordingError> {
        self.push_frame(Frame { name: name.into(), range: Range::Cloud(cloud), mask: None, joints })
    }

    /// Appends a frame; its index.
    ///
    /// # Errors
    ///
    /// A name that another frame has, or that no file could have; a size that is not the camera's;
    /// a frame that saw nothing ([`RecordingError::EmptyFrame`]); depth or points that cannot be in
    /// metres; a cloud after depth images, or the other way round; no joints; a position that is not
    /// finite or cannot be in radians; a mask of another size, or an empty one. Nothing is appended
    /// then.
    pub fn push_frame(&mut self, frame: Frame) -> Result<usize, RecordingError> {
        let place = Place::frame(&self.provenance.name, &frame.name);
        place.check_name(&frame.name, &self.known)?;
        place.check_range(&frame.range, self.camera.as_ref())?;
        place.check_kind(&frame.range, self.frames.first().map(|first| &first.range))?;
        place.check_joints(&frame.joints)?;
        if let Some(mask) = &frame.mask {
            place.check_mask(mask, &frame.range)?;
        }
        self.names.push(frame.name.clone());
        self.known.insert(frame.name.clone());
        self.colors.push(None);
        self.frames.push(frame);
        Ok(self.frames.len() - 1)
    }

    /// Says which pixels of frame `index` are the arm.
    ///
    /// # Errors
    ///
    /// No such frame; a cloud without order, of which no pixel is known; a mask of another size, or
    /// an empty one.
    pub fn set_mask(&mut self, index: usize, mask: Mask) -> Result<(), RecordingError> {
        check_index(self, index)?;
        let Some(frame) = self.frames.get_mut(index) else { return Ok(()) };
        let place = Place::frame(&self.provenance.name, &frame.name);
        place.check_mask(&mask, &frame.range)?;
        frame.mask = Some(mask);
        Ok(())
    }

    /// Adds the colour picture of frame `index`, registered to its depth.
    ///
    /// # Errors
    ///
    /// No such frame; a picture of another size than the camera, or of another number of pixels
    /// than its size says.
    pub fn set_color(&mut self, index: usize, color: ColorImage) -> Result<(), RecordingError> {
        check_index(self, index)?;
        let name = self.names.get(index).map(String::as_str).unwrap_or_default();
        let place = Place::frame(&self.provenance.name, name);
        place.check_size("color", (color.width, color.height), self.camera.as_ref())?;
        if color.rgb.len() as u64 != u64::from(color.width) * u64::from(color.height) {
            let problem = format!("{} x {} is not its number of pixels", color.width, color.height);
            return Err(place.invalid("color", problem, "Hand in the whole picture"));
        }
        if let Some(known) = self.colors.get_mut(index) {
            *known = Some(color);
        }
        Ok(())
    }

    /// Adds a depth image of the scene without the robot, or with the robot out of view; its index.
    ///
    /// # Errors
    ///
    /// No camera, or one of another size; depth that cannot be in metres.
    pub fn push_background(&mut self, depth: DepthImage) -> Result<usize, RecordingError> {
        let index = self.backgrounds.len();
        let place = Place::background(&self.provenance.name, index);
        if self.camera.is_none() {
            let problem = "a background is a depth image, and there is no camera for it";
            return Err(place.invalid("depth", problem, "Give the camera, or clouds only"));
        }
        place.check_size("depth", (depth.width(), depth.height()), self.camera.as_ref())?;
        place.check_metres("depth", depth.depth_m().iter().copied())?;
        self.backgrounds.push(depth);
        Ok(index)
    }
}

impl FrameSource for InMemory {
    fn camera(&self) -> Option<&PinholeCamera> {
        self.camera.as_ref()
    }

    fn camera_frame_id(&self) -> Option<&str> {
        self.camera_frame_id.as_deref()
    }

    fn robot(&self) -> &RobotSection {
        &self.robot
    }

    fn frame_names(&self) -> &[String] {
        &self.names
    }

    /// Whether some frame has a mask.
    fn has_masks(&self) -> bool {
        self.frames.iter().any(|frame| frame.mask.is_some())
    }

    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        check_index(self, index)?;
        Ok(self.frames.get(index).expect("as many frames as names").clone())
    }

    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        check_index(self, index)?;
        Ok(self.frames.get(index).expect("as many frames as names").joints.clone())
    }

    fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        check_index(self, index)?;
        Ok(self.colors.get(index).cloned().flatten())
    }

    fn background_count(&self) -> usize {
        self.backgrounds.len()
    }

    fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        self.backgrounds.get(index).cloned().ok_or_else(|| {
            let path = Path::new(&self.provenance.name).to_path_buf();
            RecordingError::NoSuchBackground { path, index, count: self.backgrounds.len() }
        })
    }

    fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}

#[cfg(test)]
mod tests;
