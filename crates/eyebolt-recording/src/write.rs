//! Recordings out: as MCAP with ROS 2 messages, or as a folder of files.

mod copy;
mod definitions;
mod error;
mod folder;
mod from_frames;
mod mcap;
mod messages;
mod npy;
mod png;
mod recording_writer;
mod robot;
mod session;
mod viewer;

pub use error::WriteError;
pub use folder::write_folder;
pub use mcap::{McapWriter, write_static_transforms};
pub use npy::write_npy;
pub use recording_writer::{RecordingInfo, RecordingWriter};
pub use robot::WriteRobot;
pub use session::SessionWriter;
pub use viewer::{Viewed, ViewerWriter, viewer_layout};

use crate::own_metadata;
use crate::progress::Progress;
use crate::recording::Recording;
use crate::truth;
use std::io::{Seek, Write};

/// Writes `recording` to `output` as MCAP with ROS 2 messages: depth, intrinsics, joint states, the
/// robot, backgrounds, masks and pictures where there are any, static transforms.
///
/// Of a bag, all messages of these topics are copied with their times and names; of a folder, every
/// background and every frame becomes a message stamped a second after the one before. One metadata
/// record called `eyebolt` names base and end-effector. The truth of a simulated recording goes with
/// it as it is.
///
/// # Errors
///
/// What cannot be read, or a failing `output`.
pub fn write_mcap(
    recording: &Recording,
    robot: &WriteRobot,
    output: impl Write + Seek,
    progress: &dyn Progress,
) -> Result<(), WriteError> {
    let metadata = from_frames::metadata(recording, robot);
    let truth = truth::text_of(recording)?;
    let Recording::Bag(bag) = recording else {
        return from_frames::write(recording, robot, metadata, truth.as_deref(), output, progress);
    };
    let mut writer = McapWriter::new(output)?;
    writer.metadata(own_metadata::NAME, &metadata)?;
    if let Some(json) = truth {
        writer.metadata(truth::RECORD, &truth::record(&json))?;
    }
    copy::bag(bag.copy_source(), robot, &mut writer, progress)?;
    writer.finish()
}
