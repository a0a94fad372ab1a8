//! Names of the topics that only viewers look at. `image_transport` finds the picture and its intrinsics by theirs.

pub(super) const POINTS: &str = "/eyebolt/points";
pub(super) const OUTLINE: &str = "/eyebolt/outline";
pub(super) const CAPTION: &str = "/eyebolt/caption";
pub(super) const OVERLAY: &str = "/eyebolt/overlay/compressed";
pub(super) const CAMERA_INFO: &str = "/eyebolt/camera_info";
