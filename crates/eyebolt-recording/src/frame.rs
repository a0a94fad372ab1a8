//! One frame of a recording.

use eyebolt_geometry::{Cloud, DepthImage, Mask};
use eyebolt_robot::JointPositions;

/// What the camera saw and where the joints were.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The frame's number or name in its files.
    pub name: String,
    /// Depth image or cloud.
    pub range: Range,
    /// Pixels of the whole arm, of the size of the depth image or organised cloud.
    pub mask: Option<Mask>,
    /// Positions of the joints at that moment.
    pub joints: JointPositions,
}

/// Distances that a camera measured, in its optical frame (x right, y down, z forward), metres.
#[derive(Clone, Debug)]
pub enum Range {
    /// Depth along z, of the camera's size; 0 where there is none.
    Depth(DepthImage),
    /// Points, NaN where there is none.
    Cloud(Cloud),
}

impl Range {
    /// Width and height, unless it is a cloud without order.
    pub fn size(&self) -> Option<(u32, u32)> {
        match self {
            Self::Depth(image) => Some((image.width(), image.height())),
            Self::Cloud(cloud) => cloud.grid(),
        }
    }
}
