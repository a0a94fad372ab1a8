//! A recording that is a bag: MCAP, a ROS 2 bag in SQLite, or a ROS 1 bag.
//!
//! One pass over the bag finds the topics, the frames of depth and the path of the joints; frames
//! are read when asked for. Memory grows by some bytes a frame, not by its pixels.
//!
//! Opening is a row of steps over plain data: [`scan`] the bag, [`choose`] the topics, [`check`]
//! them, [`pair`] frames and joints; of what these find, [`recording`] is put together.

mod camera;
mod check;
mod choose;
mod clock;
mod color_view;
mod copy_source;
mod frame_reader;
mod frames;
mod growing;
mod growing_scan;
mod known;
mod options;
mod pair;
mod picture_topic;
mod recording;
mod scan;
mod skew;
mod stamps;
mod topics;
mod track;

pub(crate) use copy_source::CopySource;
pub use growing::GrowingRecording;
pub use options::BagOptions;
pub use recording::BagRecording;
pub use topics::{list_topics, static_transforms};
