//! Recordings out: as MCAP with ROS 2 messages, or as a folder of files.

mod copy;
mod definitions;
mod folder;
mod from_frames;
mod mcap;
mod messages;
mod npy;
mod png;
mod recording_writer;

pub use folder::write_folder;
pub use mcap::{McapWriter, write_static_transforms};
pub(crate) use recording_writer::BACKGROUND_TOPIC;
pub use recording_writer::{RecordingInfo, RecordingWriter};

use crate::error::RecordingError;
use crate::recording::Recording;
use crate::truth;
use std::io::{self, Seek, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;

/// Why a recording could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The recording cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A file cannot be written.
    #[error("{path}: cannot write: {cause}. Make room there, or name another place", path = path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system said. Part of the text, so no `source` of the error.
        cause: io::Error,
    },
    /// What was to be written fits no recording.
    #[error("{what} at {:.3} s: {problem}", *stamp_ns as f64 * 1e-9)]
    Unfit {
        /// What it was to be.
        what: &'static str,
        /// Its stamp.
        stamp_ns: i64,
        /// Why it does not fit.
        problem: String,
    },
    /// Whoever was told of the progress wanted it to end.
    #[error("stopped; nothing was written")]
    Stopped,
}

/// Hears how many of how many messages or frames are done; [`ControlFlow::Break`] ends the work.
pub type WriteProgress<'a> = dyn FnMut(usize, usize) -> ControlFlow<()> + 'a;

/// The robot of a recording, for those who read it later.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteRobot {
    /// Text of the URDF.
    pub urdf: Option<String>,
    /// Name of the base link.
    pub base: Option<String>,
    /// Name of the end-effector link.
    pub end_effector: Option<String>,
}

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
    progress: &mut WriteProgress<'_>,
) -> Result<(), WriteError> {
    let metadata = from_frames::metadata(recording, robot);
    let truth = truth::text_of(recording)?;
    let Recording::Bag(bag) = recording else {
        return from_frames::write(recording, robot, metadata, truth.as_deref(), output, progress);
    };
    let mut writer = McapWriter::new(output)?;
    writer.metadata(crate::METADATA_NAME, &metadata)?;
    if let Some(json) = truth {
        writer.metadata(truth::RECORD, &truth::record(&json))?;
    }
    copy::bag(bag, robot, &mut writer, progress)?;
    writer.finish()
}

fn tell(progress: &mut WriteProgress<'_>, done: usize, total: usize) -> Result<(), WriteError> {
    match progress(done, total) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(WriteError::Stopped),
    }
}
