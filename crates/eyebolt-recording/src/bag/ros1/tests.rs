//! Bags that `rosbags` wrote, and bags that nobody should write.

mod buffer;
mod hostile;
mod recorder;
mod rosbags;
mod support;
mod unfinished;
mod writer;
