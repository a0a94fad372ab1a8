//! A recording, whatever it is stored in.

use crate::bag::is_bag;
use crate::bag_recording::{BagOptions, BagRecording};
use crate::color::ColorImage;
use crate::error::RecordingError;
use crate::folder::{Folder, MANIFEST};
use crate::frame::Frame;
use crate::manifest::RobotSection;
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_robot::JointPositions;
use std::path::{Path, PathBuf};

/// A recording of depth and joint positions. Frames are read when asked for, from as many threads
/// as wanted.
#[derive(Debug)]
pub enum Recording {
    /// A folder of files with a `recording.toml`.
    Folder(Box<Folder>),
    /// A bag.
    Bag(Box<BagRecording>),
}

impl Recording {
    /// Opens the recording at `path`: a folder with a `recording.toml`, that file itself, a bag, or
    /// a folder with a bag in it. `options` are for bags.
    ///
    /// # Errors
    ///
    /// Neither kind is there, or what [`Folder::open`] and [`BagRecording::open`] report.
    pub fn open(path: &Path, options: &BagOptions) -> Result<Self, RecordingError> {
        let described = path.is_dir() && path.join(MANIFEST).exists();
        if !described && is_bag(path) {
            return BagRecording::open(path, options).map(|bag| Self::Bag(Box::new(bag)));
        }
        Folder::open(path).map(|folder| Self::Folder(Box::new(folder)))
    }

    /// The camera, unless the frames are clouds without one.
    pub fn camera(&self) -> Option<&PinholeCamera> {
        match self {
            Self::Folder(folder) => folder.camera(),
            Self::Bag(bag) => bag.camera(),
        }
    }

    /// Name of the camera's optical frame in ROS, where the recording says it.
    pub fn camera_frame_id(&self) -> Option<&str> {
        match self {
            Self::Folder(folder) => folder.camera_frame_id(),
            Self::Bag(bag) => bag.camera_frame_id(),
        }
    }

    /// What the recording says of the robot.
    pub fn robot(&self) -> &RobotSection {
        match self {
            Self::Folder(folder) => folder.robot(),
            Self::Bag(bag) => bag.robot(),
        }
    }

    /// Names of the frames, in their order.
    pub fn frame_names(&self) -> &[String] {
        match self {
            Self::Folder(folder) => folder.frame_names(),
            Self::Bag(bag) => bag.frame_names(),
        }
    }

    /// Whether frames come with masks of the arm.
    pub fn has_masks(&self) -> bool {
        match self {
            Self::Folder(folder) => folder.has_masks(),
            Self::Bag(bag) => bag.has_masks(),
        }
    }

    /// Reads frame `index`, counted from 0.
    ///
    /// # Errors
    ///
    /// No such frame, or one that cannot be read.
    pub fn read_frame(&self, index: usize) -> Result<Frame, RecordingError> {
        match self {
            Self::Folder(folder) => folder.read_frame(index),
            Self::Bag(bag) => bag.read_frame(index),
        }
    }

    /// Positions of the joints in frame `index`, counted from 0, without what the camera saw.
    ///
    /// # Errors
    ///
    /// No such frame, or positions that cannot be read.
    pub fn read_joints(&self, index: usize) -> Result<JointPositions, RecordingError> {
        match self {
            Self::Folder(folder) => folder.read_joints(index),
            Self::Bag(bag) => bag.read_joints(index),
        }
    }

    /// Reads the colour picture of frame `index`; `None` if there is none.
    ///
    /// # Errors
    ///
    /// No such frame, or a picture that cannot be read.
    pub fn read_color(&self, index: usize) -> Result<Option<ColorImage>, RecordingError> {
        match self {
            Self::Folder(folder) => folder.read_color(index),
            Self::Bag(bag) => bag.read_color(index),
        }
    }

    /// Number of depth images of the scene without the robot, or with the robot out of view.
    pub fn background_count(&self) -> usize {
        match self {
            Self::Folder(folder) => folder.background_count(),
            Self::Bag(bag) => bag.background_count(),
        }
    }

    /// Reads background `index`, counted from 0: depth of the camera's size in metres, 0 where there
    /// is none. There may be none at all, where the scene is out of range.
    ///
    /// # Errors
    ///
    /// No such background, or one that cannot be read or is not of the camera's size.
    pub fn read_background(&self, index: usize) -> Result<DepthImage, RecordingError> {
        match self {
            Self::Folder(folder) => folder.read_background(index),
            Self::Bag(bag) => bag.read_background(index),
        }
    }

    /// Whether backgrounds are stored in whole millimetres.
    pub(crate) fn backgrounds_in_millimetres(&self) -> bool {
        match self {
            Self::Folder(folder) => folder.backgrounds_in_millimetres(),
            Self::Bag(bag) => bag.backgrounds_in_millimetres(),
        }
    }

    /// Whether depth is stored in whole millimetres.
    pub fn in_millimetres(&self) -> bool {
        match self {
            Self::Folder(folder) => folder.in_millimetres(),
            Self::Bag(bag) => bag.in_millimetres(),
        }
    }

    /// Whether a frame that [`Self::read_frame`] fails with `error` for may be left out, since it is
    /// one of many and saw nothing, or is damaged and that was said to be no matter.
    pub fn may_leave_out(&self, error: &RecordingError) -> bool {
        self.bag().is_some_and(|bag| bag.may_leave_out(error))
    }

    /// The files that the recording was read from, or the folder that they lie in.
    pub fn sources(&self) -> Vec<PathBuf> {
        match self {
            Self::Folder(folder) => vec![folder.path().to_path_buf()],
            Self::Bag(bag) => bag.sources(),
        }
    }

    /// The bag, if it is one.
    pub fn bag(&self) -> Option<&BagRecording> {
        match self {
            Self::Folder(_) => None,
            Self::Bag(bag) => Some(bag),
        }
    }
}
