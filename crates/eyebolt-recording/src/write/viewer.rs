//! A calibration for viewers of MCAP: the one place that knows the topics of such files, but for `python/src/eyebolt/_rerun.py`,
//! which shows them to Rerun.

mod layout;
mod topics;
mod writer;

pub use layout::viewer_layout;
pub use writer::{Viewed, ViewerWriter};
