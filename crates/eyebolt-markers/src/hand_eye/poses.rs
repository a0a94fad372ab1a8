//! Poses of robot, camera and marker, known and unknown.

use crate::frames::Marker;
use crate::planar_pose::MarkerPose;
use crate::sighting::Correspondence;
use eyebolt_geometry::{Camera, CoordinateFrame, Transform};

/// Both unknowns of hand-eye calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandEye<Root: CoordinateFrame, Carrier: CoordinateFrame> {
    /// The camera against what it stands on.
    pub camera_from_root: Transform<Camera, Root>,
    /// The marker against what carries it.
    pub carrier_from_marker: Transform<Carrier, Marker>,
}

impl<Root: CoordinateFrame, Carrier: CoordinateFrame> HandEye<Root, Carrier> {
    /// Where the marker has to be seen.
    pub fn camera_from_marker(
        &self,
        root_from_carrier: &Transform<Root, Carrier>,
    ) -> Transform<Camera, Marker> {
        self.camera_from_root * *root_from_carrier * self.carrier_from_marker
    }
}

/// A pose of the marker, and of the robot at the same time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PosePair<Root: CoordinateFrame, Carrier: CoordinateFrame> {
    /// Where the robot was.
    pub root_from_carrier: Transform<Root, Carrier>,
    /// Where the marker was seen.
    pub camera_from_marker: Transform<Camera, Marker>,
}

/// A picture of the marker, and where the robot was at the same time.
#[derive(Clone, Debug, PartialEq)]
pub struct View<Root: CoordinateFrame, Carrier: CoordinateFrame> {
    /// Where the robot was.
    pub root_from_carrier: Transform<Root, Carrier>,
    /// Points of the marker where they were seen.
    pub points: Vec<Correspondence>,
    /// The poses that these points allow, the best first: see [`planar_poses`](crate::planar_poses).
    pub poses: Vec<MarkerPose>,
}
