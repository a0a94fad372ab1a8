//! Data sets to learn from: every frame of recordings, labelled.
//!
//! [`LabelRun`] labels the frames of one recording whose calibration is known. [`Store`] keeps them
//! in a folder that NumPy opens without eyebolt, and [`Dataset`] reads it:
//!
//! ```text
//! dataset.toml                     what the numbers mean: robot, classes, keypoints, units, frames
//! recordings/ID.toml               one recording: where it came from, how many frames it has
//! recordings/ID.calibration.json   the calibration that its labels are made by
//! frames/ID/NUMBER_NAME.npz        one frame
//! index.jsonl                      one line for each frame, in order, with a reason if it is left out
//! index.I-of-N.jsonl               the same of shard I, until all are merged
//! ```
//!
//! Every file appears whole or not at all, and depends on nothing but the recording, the robot and
//! the calibration: machines that share a folder can label the same recordings, each its shard.

mod applied;
mod classes;
mod decode;
mod description;
mod error;
mod files;
mod fill;
mod frame;
mod index;
mod merge;
mod npz;
mod reader;
mod recording;
mod run;
mod shard;
mod store;
mod symmetry;

pub use applied::start;
pub use classes::{code, label};
pub use description::{Classes, Description, KeypointDescription, RobotDescription, SCHEMA};
pub use error::DatasetError;
pub use fill::{FillError, Filled, Look, fill};
pub use frame::DatasetFrame;
pub use index::{FileLine, FrameKey, IndexLine, PixelCounts};
pub use merge::{Merged, merge};
pub use reader::{Dataset, FrameEntry};
pub(crate) use recording::file_safe;
pub use recording::{Calibrated, RecordingEntry};
pub use run::{LabelRun, Labelled, LeftOut};
pub use shard::Shard;
pub use store::Store;
pub use symmetry::SymmetryDescription;
