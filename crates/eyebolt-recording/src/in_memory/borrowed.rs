//! Frames in somebody else's memory.

use super::place::{NAME, Place};
use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use crate::frame::{Frame, Range};
use crate::frame_source::{FrameSource, check_index};
use crate::provenance::Provenance;
use eyebolt_geometry::{DepthImage, ImageError, Mask, PinholeCamera};
use eyebolt_robot::JointPositions;
use std::collections::BTreeSet;
use std::fmt;
use std::path::Path;

/// Makes an image from what is borrowed; asked again, the same.
pub type Make<'a, T> = Box<dyn Fn() -> Result<T, ImageError> + Send + Sync + 'a>;

/// A frame whose images are made when they are asked for.
pub struct BorrowedFrame<'a> {
    /// Number or name, another for each frame.
    pub name: String,
    /// Makes the depth image, of the camera's size, in metres.
    pub depth: Make<'a, DepthImage>,
    /// Makes the mask of the arm, of the camera's size.
    pub mask: Option<Make<'a, Mask>>,
    /// Positions of the joints: radians, metres for prismatic joints.
    pub joints: JointPositions,
}

/// Frames whose depth lies in somebody else's memory, of whatever layout and unit: arrays of another language,
/// a file that is mapped into memory, the buffers of a driver.
///
/// Nothing is copied before a frame is read, and then that frame alone. What a reader of files checks in a frame is
/// checked whenever it is read; errors name the frame.
///
/// ```
/// use eyebolt_geometry::{Distortion, PinholeCamera};
/// use eyebolt_recording::{
///     BorrowedFrame, BorrowedFrames, DepthUnit, FrameSource, depth_from_millimetres,
/// };
///
/// let millimetres: Vec<u16> = vec![1250; 24];
/// let camera = PinholeCamera::new(4, 3, 5.0, 5.0, 1.5, 1.0, Distortion::None)?;
/// let mut frames = BorrowedFrames::new(camera).of_integers(DepthUnit::MILLIMETRES);
/// for (number, image) in millimetres.chunks(12).enumerate() {
///     frames.push(BorrowedFrame {
///         name: number.to_string(),
///         depth: Box::new(|| depth_from_millimetres(4, 3, image)),
///         mask: None,
///         joints: [("elbow".to_owned(), 0.5)].into_iter().collect(),
///     })?;
/// }
/// assert_eq!(frames.read_frame(1)?.range.size(), Some((4, 3)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct BorrowedFrames<'a> {
    camera: PinholeCamera,
    camera_frame_id: Option<String>,
    /// What depth is stored in, and whether in integers.
    unit: DepthUnit,
    integers: bool,
    frames: Vec<BorrowedFrame<'a>>,
    /// Of each frame, and the same to look them up.
    names: Vec<String>,
    known: BTreeSet<String>,
    backgrounds: Vec<Make<'a, DepthImage>>,
    provenance: Provenance,
}

impl<'a> BorrowedFrames<'a> {
    /// No frames yet; their depth will be of `camera`, stored in metres.
    pub fn new(camera: PinholeCamera) -> Self {
        let provenance =
            Provenance { name: NAME.to_owned(), kind: "memory", ..Provenance::default() };
        Self {
            camera,
            camera_frame_id: None,
            unit: DepthUnit::METRES,
            integers: false,
            frames: Vec::new(),
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

    /// The same, of depth that was stored in integers, one of which is `unit`.
    #[must_use]
    pub fn of_integers(self, unit: DepthUnit) -> Self {
        Self { unit, integers: true, ..self }
    }

    /// The same, of depth that was stored in floats, one of which is `unit`.
    #[must_use]
    pub fn of_floats(self, unit: DepthUnit) -> Self {
        Self { unit, integers: false, ..self }
    }

    /// Appends a frame; its index. Its images are not made yet.
    ///
    /// # Errors
    ///
    /// A name that another frame has, or that no file could have; no joints; a position that is not finite or cannot
    /// be in radians. Nothing is appended then.
    pub fn push(&mut self, frame: BorrowedFrame<'a>) -> Result<usize, RecordingError> {
        let place = Place::frame(&self.provenance.name, &frame.name);
        place.check_name(&frame.name, &self.known)?;
        place.check_joints(&frame.joints)?;
        self.names.push(frame.name.clone());
        self.known.insert(frame.name.clone());
        self.frames.push(frame);
        Ok(self.frames.len() - 1)
    }

    /// Adds a depth image of the scene without the robot, of the camera's size and stored as the frames are; its index.
    /// It is not made yet.
    pub fn push_background(&mut self, depth: Make<'a, DepthImage>) -> usize {
        self.backgrounds.push(depth);
        self.backgrounds.len() - 1
    }

    fn place(&self, name: &str) -> Place<'_> {
        Place::frame(&self.provenance.name, name).stored_in(self.unit)
    }

    fn frame(&self, index: usize) -> Result<&BorrowedFrame<'a>, RecordingError> {
        check_index(self, index)?;
        Ok(self.frames.get(index).expect("as many frames as names"))
    }
}

fn in_part(place: &Place<'_>, field: &str, error: ImageError) -> RecordingError {
    place.invalid(field, error.to_string(), "Hand in whole images")
}

impl FrameSource for BorrowedFrames<'_> {
    fn camera(&self) -> Option<&PinholeCamera> {
        Some(&self.camera)
    }

    fn camera_frame_id(&self) -> Option<&str> {
        self.camera_frame_id.as_deref()
    }

    fn frame_names(&self) -> &[String] {
        &self.names
    }

    /// Whether some frame has a mask.
    fn has_masks(&self) -> bool {
        self.frames.iter().any(|frame| frame.mask.is_some())
    }

    /// # Errors
    ///
    /// No such frame; images that cannot be made, or are not of the camera's size; depth that cannot be in the unit
    /// that was told; a frame that saw nothing; an empty mask.
    fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        let BorrowedFrame { name, depth, mask, joints } = self.frame(index)?;
        let place = self.place(name);
        let range = Range::Depth(depth().map_err(|error| in_part(&place, "depth", error))?);
        place.check_range(&range, Some(&self.camera))?;
        let made = mask.as_ref().map(|make| make().map_err(|error| in_part(&place, "mask", error)));
        let mask = made.transpose()?;
        mask.as_ref().map_or(Ok(()), |mask| place.check_mask(mask, &range))?;
        Ok(Frame { name: name.clone(), range, mask, joints: joints.clone() })
    }

    fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        Ok(self.frame(index)?.joints.clone())
    }

    fn background_count(&self) -> usize {
        self.backgrounds.len()
    }

    /// # Errors
    ///
    /// No such background; one that cannot be made, is not of the camera's size, or cannot be in the unit that was told.
    fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        let Some(make) = self.backgrounds.get(index) else {
            let path = Path::new(&self.provenance.name).to_path_buf();
            return Err(RecordingError::NoSuchBackground {
                path,
                index,
                count: self.backgrounds.len(),
            });
        };
        let place = Place::background(&self.provenance.name, index).stored_in(self.unit);
        let depth = make().map_err(|error| in_part(&place, "depth", error))?;
        place.check_size("depth", (depth.width(), depth.height()), Some(&self.camera))?;
        place.check_metres("depth", depth.depth_m().iter().copied())?;
        Ok(depth)
    }

    fn backgrounds_in_millimetres(&self) -> bool {
        self.in_millimetres()
    }

    fn in_millimetres(&self) -> bool {
        self.integers && self.unit == DepthUnit::MILLIMETRES
    }

    fn integer_unit_m(&self) -> Option<f64> {
        self.integers.then(|| self.unit.metres())
    }

    fn provenance(&self) -> &Provenance {
        &self.provenance
    }
}

impl fmt::Debug for BorrowedFrame<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("BorrowedFrame");
        shown.field("name", &self.name).field("joints", &self.joints).finish_non_exhaustive()
    }
}

impl fmt::Debug for BorrowedFrames<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("BorrowedFrames");
        shown.field("camera", &self.camera).field("frames", &self.frames).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
