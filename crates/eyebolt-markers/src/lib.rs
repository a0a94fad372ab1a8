//! ArUco and AprilTag markers in pictures, their poses, and hand-eye calibration from them.
//!
//! SI units and radians; pixels have their centres at whole numbers. `a_from_b` maps coordinates in frame
//! `b` to coordinates in frame `a`. The same input gives the same bytes on any number of threads.

mod detect;
mod dictionary;
mod frames;
mod grey;
pub mod hand_eye;
mod homography;
mod planar_pose;
mod sighting;
mod target;

pub use detect::{Detection, detect};
pub use dictionary::Dictionary;
pub use frames::Marker;
pub use grey::GreyImage;
pub use planar_pose::{MarkerPose, planar_poses};
pub use sighting::Correspondence;
pub use target::{Layout, NotSeen, Sighting, Target, TargetError};
