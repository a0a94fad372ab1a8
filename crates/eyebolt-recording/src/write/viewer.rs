//! A calibration for viewers of MCAP: the one place that knows the topics of such files.

mod layout;
mod topics;
mod writer;

pub use layout::viewer_layout;
pub use writer::{Viewed, ViewerWriter};
