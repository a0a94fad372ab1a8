//! From frames and a robot to observations: everything is read and checked here.

mod background;
mod configurations;
mod error;
mod frame_images;
mod joints;
mod merge;
mod observe;
mod options;
mod places;
mod posture;
mod projection;
mod reader;
mod shapes;
mod spread;

pub(crate) use configurations::{Group, Groups, group_frames};
pub use error::RecordError;
pub use frame_images::{FrameImage, FrameImages};
pub(crate) use joints::offered;
pub use observe::observe;
pub(crate) use options::MOST_CONFIGURATIONS;
pub use options::RecordOptions;
pub use places::Places;
pub(crate) use posture::posture;
pub(crate) use reader::{SingleFrame, SingleFrames};
pub(crate) use shapes::{plausible_mesh, shapes};
pub(crate) use spread::most_spread;
