//! Where the base may be: hypotheses for `camera_from_base`; and what networks say of the end-effector.

mod by_end_effector;
mod comparison;
mod consensus;
mod contest;
mod estimator;
mod global_search;
mod hypotheses;
mod judge;
mod judged;
mod keypoint_net;
mod method;
mod observed;
mod open;
mod patches;
mod proposer;
mod recognizer;
mod rotation_net;
mod shape;
mod smooth;
mod through;
mod trust;
mod view;

pub use by_end_effector::ByEndEffector;
pub use comparison::Comparison;
pub use estimator::{PoseAnswer, PoseEstimator};
pub use global_search::GlobalSearch;
pub use hypotheses::{PoseHypothesis, Source, half_turns, with_translation};
pub use judge::{Judge, Support};
pub use keypoint_net::{
    KeypointNet, MatchedPose, PARTS, POINT_OUTPUTS, keypoint_outputs, matched_pose,
};
pub use method::{PoseError, PoseMethod};
pub use observed::Observed;
pub use proposer::{Hypothesis, PoseProposer};
pub use recognizer::{RecognizeError, Recognized, Recognizer};
pub use rotation_net::{Decoder, PoseNetError, QUATERNION, RotationMode, RotationNet, view_batch};
pub use shape::EndEffectorShape;
pub use smooth::SmoothSurface;
pub use trust::{ExpectedError, Refusal, Rival};
pub use view::{CELLS, EndEffectorView, VIEW_FEATURES, view_edge_m};
