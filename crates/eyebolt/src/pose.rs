//! Where the base may be: hypotheses for `camera_from_base`; and what networks say of the end-effector.

mod global_search;
mod keypoint_net;
mod patches;
mod proposer;
mod rotation_net;
mod view;

pub use global_search::GlobalSearch;
pub use keypoint_net::{
    KeypointNet, MatchedPose, PARTS, POINT_OUTPUTS, keypoint_outputs, matched_pose,
};
pub use proposer::{Hypothesis, PoseProposer};
pub use rotation_net::{Decoder, PoseNetError, QUATERNION, RotationMode, RotationNet, view_batch};
pub use view::{CELLS, EndEffectorView, VIEW_FEATURES};
