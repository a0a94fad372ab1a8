//! How to read a bag.

use crate::depth_unit::DepthUnit;
use crate::manifest::CloudFrame;
use std::path::{Path, PathBuf};

/// How to read a bag. The default finds out by itself what it can.
#[derive(Clone, Debug, Default)]
pub struct BagOptions {
    /// Topic of the depth images or clouds.
    pub depth_topic: Option<String>,
    /// Of several topics of depth, take one: the one that the others were made of, if that is known.
    pub any_depth: bool,
    /// Topic of their intrinsics.
    pub camera_info_topic: Option<String>,
    /// File of their intrinsics, instead of a topic.
    pub camera_info: Option<PathBuf>,
    /// Topic of the joint states.
    pub joint_topic: Option<String>,
    /// Names of the robot's joints, where the robot is known: of several topics of joint states, the one
    /// that tells most of them is the arm's. Otherwise those of the bag's own description.
    pub robot_joints: Vec<String>,
    /// Topic of the robot's description.
    pub description_topic: Option<String>,
    /// Topic of colour pictures registered to the depth.
    pub color_topic: Option<String>,
    /// Topic of masks of the arm.
    pub mask_topic: Option<String>,
    /// Topic of depth images of the scene without the robot.
    pub background_topic: Option<String>,
    /// What the numbers of depth are, where the driver does not keep to millimetres of integers and
    /// metres of floats (REP 118).
    pub depth_unit: Option<DepthUnit>,
    /// Frame of the points of clouds.
    pub cloud_frame: Option<CloudFrame>,
    /// How far a joint may move while a frame is taken, radians or metres; otherwise the data tell.
    pub max_motion: Option<f64>,
    /// Use what can be read of a damaged bag.
    pub partial: bool,
    /// Folder for decompressed copies; the current one if empty.
    pub scratch: PathBuf,
}

impl BagOptions {
    pub(super) fn scratch(&self) -> &Path {
        let empty = self.scratch.as_os_str().is_empty();
        if empty { Path::new(".") } else { &self.scratch }
    }
}
