//! The arm as networks tell it.

use super::labeller::{Labeller, Labelling};
use crate::observations::{Configuration, Observations};
use crate::segment::{ARM, END_EFFECTOR, SegmentError, Segmenter, UNKNOWN};
use eyebolt_registration::{Label, Labels};
use std::error::Error;
use std::sync::{Mutex, PoisonError};

/// Takes what networks say of each image by itself: that people, or the scene, move does not matter.
///
/// Where the recording has masks, they say what the arm is, and the networks which part of it is the end-effector.
#[derive(Debug)]
pub struct Learned {
    segmenter: Mutex<Segmenter>,
}

impl Learned {
    /// By `segmenter`.
    pub fn new(segmenter: Segmenter) -> Self {
        Self { segmenter: Mutex::new(segmenter) }
    }
}

impl Labeller for Learned {
    fn label(
        &self,
        observations: &Observations,
    ) -> Result<Labelling, Box<dyn Error + Send + Sync>> {
        // What was left half done by a panic is begun anew with each image.
        let mut segmenter = self.segmenter.lock().unwrap_or_else(PoisonError::into_inner);
        let one = |configuration: &Configuration| -> Result<Labels, SegmentError> {
            let found = segmenter.segment(&configuration.depth, &observations.camera)?;
            let (width, mask) = (found.width, configuration.mask.as_ref());
            Ok(Labels::from_fn(0..width, 0..found.height, |u, v| {
                let label = found.label.get(v * width + u).copied().unwrap_or(UNKNOWN);
                match (label, mask.map(|mask| mask.at(u as u32, v as u32))) {
                    (_, Some(false)) => Label::Background,
                    (END_EFFECTOR, _) => Label::EndEffector,
                    (ARM, _) | (_, Some(true)) => Label::Arm,
                    (UNKNOWN, None) => Label::Ignore,
                    _ => Label::Background,
                }
            }))
        };
        let labels = observations.configurations.iter().map(one).collect::<Result<_, _>>()?;
        Ok(Labelling { labels, whole_arm: true })
    }
}
