//! Messages that `rosbags` wrote, messages that we write, and bytes that nobody should.

mod hostile;
mod legal;
mod rosbags;
mod support;
mod written;
