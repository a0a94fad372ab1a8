//! A labelled frame, and who takes it.

use anyhow::Result;
use eyebolt::record::{FrameImage, FrameImages};
use eyebolt::segment::Segmentation;

/// A frame whose pixels are labelled.
pub(crate) struct Segmented<'a> {
    /// Which frame of the recording it is.
    pub(crate) index: usize,
    pub(crate) name: &'a str,
    pub(crate) images: &'a FrameImages,
    pub(crate) image: FrameImage,
    pub(crate) found: Segmentation,
}

/// Takes labelled frames, in their order.
pub(super) trait Sink {
    /// Takes one.
    fn frame(&mut self, frame: &Segmented<'_>) -> Result<()>;
}
