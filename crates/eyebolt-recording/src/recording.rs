//! A recording, whatever it is stored in.

use crate::bag::is_bag;
use crate::bag_recording::{BagOptions, BagRecording};
use crate::error::RecordingError;
use crate::folder::{Folder, MANIFEST};
use crate::frame_source::FrameSource;
use crate::no_recording;
use std::ops::Deref;
use std::path::Path;

/// A recording of depth and joint positions: a [`FrameSource`], which it dereferences to, of a kind
/// that those can tell who copy it message by message.
#[derive(Debug)]
pub enum Recording<'a> {
    /// A folder of files with a `recording.toml`.
    Folder(Box<Folder>),
    /// A bag.
    Bag(Box<BagRecording>),
    /// Another source of frames.
    Other(Box<dyn FrameSource + 'a>),
}

/// The optical frame of recordings that name none.
pub const OPTICAL_FRAME: &str = "camera_depth_optical_frame";

/// The stamp of image `index` of those that have none, nanoseconds: a second after the one before, and never 0, which
/// would mean "no stamp".
pub(crate) fn stamp_ns(index: usize) -> i64 {
    const STEP_NS: i64 = 1_000_000_000;
    i64::try_from(index).unwrap_or(i64::MAX).saturating_add(1).saturating_mul(STEP_NS)
}

impl<'a> Recording<'a> {
    /// Opens the recording at `path`: a folder with a `recording.toml`, that file itself, a bag, or
    /// a folder with a bag in it. `options` are for bags, but for the unit of depth.
    ///
    /// # Errors
    ///
    /// Neither kind is there, or what [`Folder::open`] and [`BagRecording::open`] report.
    pub fn open(path: &Path, options: &BagOptions) -> Result<Self, RecordingError> {
        let described = path.is_dir() && path.join(MANIFEST).exists();
        if !described && is_bag(path) {
            return BagRecording::open(path, options).map(|bag| Self::Bag(Box::new(bag)));
        }
        if let Some(error) = no_recording::problem(path, is_bag).filter(|_| !described) {
            return Err(error);
        }
        Folder::open_in(path, options.depth_unit).map(|folder| Self::Folder(Box::new(folder)))
    }

    /// What everything but a writer needs to know of it.
    pub fn source(&self) -> &(dyn FrameSource + 'a) {
        match self {
            Self::Folder(folder) => folder.as_ref(),
            Self::Bag(bag) => bag.as_ref(),
            Self::Other(source) => source.as_ref(),
        }
    }

    /// When frame `index` was taken, nanoseconds since 1970; of what has no stamps, when [`crate::write_mcap`] says: images are a second
    /// apart, backgrounds first.
    pub fn stamp_ns(&self, index: usize) -> i64 {
        let known = self.source().stamp_ns(index);
        known.unwrap_or_else(|| stamp_ns(self.background_count().saturating_add(index)))
    }

    /// The bag, if it is one.
    pub fn bag(&self) -> Option<&BagRecording> {
        if let Self::Bag(bag) = self { Some(bag) } else { None }
    }
}

impl<'a> Deref for Recording<'a> {
    type Target = dyn FrameSource + 'a;

    fn deref(&self) -> &Self::Target {
        self.source()
    }
}
