//! Transforms between frames that never move against each other, as `/tf_static` has them.

mod read;
mod tf_message;
mod tree;

pub use read::MAX_TREE_BYTES;
pub(super) use tf_message::pose as static_pose;
pub use tree::{StaticEdge, StaticTree};
