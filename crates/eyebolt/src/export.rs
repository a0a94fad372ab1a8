//! A saved calibration in the forms that other programs read.
//!
//! [`SavedCalibration`] is what a calibration file says. A [`Placement`] is the pose of one frame in
//! another: of the camera in the base, or of any two frames that a [`StaticTree`] (the fixed
//! transforms of the camera or the robot) connects to these. A [`Format`] writes it.
//!
//! Every format tells `parent_from_child`: the pose of the child in the parent, which maps
//! coordinates in the child to coordinates in the parent. That is what tf means by a transform from
//! `frame_id` to `child_frame_id`. Metres, radians.

mod csv;
mod easy_handeye;
mod easy_handeye2;
mod error;
mod file;
mod format;
mod frame_name;
mod graph;
mod mcap;
mod moveit;
mod note;
mod npy;
mod placement;
mod python_launch;
mod ros2_launch;
mod saved;
mod static_tree;
mod text;
mod tf2;
mod urdf;

pub use error::ExportError;
pub(crate) use file::read_text;
pub use format::Format;
pub use frame_name::{BadFrameName, FrameName, Named};
pub use note::Note;
pub use placement::{Placement, Wanted};
pub use saved::{Corrections, MAX_CALIBRATION_BYTES, SavedCalibration, Uncertainty};
pub use static_tree::{MAX_TREE_BYTES, StaticEdge, StaticTree};
