//! The arm as the recording's masks have it.

use super::labeller::{Labeller, Labelling};
use crate::observations::{Configuration, Observations};
use eyebolt_registration::{Label, Labels};
use rayon::prelude::*;
use std::error::Error;

/// Takes the masks of the recording; a configuration without one is ignored whole.
#[derive(Clone, Copy, Debug)]
pub struct GivenMasks;

impl Labeller for GivenMasks {
    fn label(
        &self,
        observations: &Observations,
    ) -> Result<Labelling, Box<dyn Error + Send + Sync>> {
        let one = |configuration: &Configuration| {
            let (width, height) = (configuration.depth.width(), configuration.depth.height());
            Labels::from_fn(0..width as usize, 0..height as usize, |u, v| {
                match &configuration.mask {
                    None => Label::Ignore,
                    Some(mask) if mask.at(u as u32, v as u32) => Label::Arm,
                    Some(_) => Label::Background,
                }
            })
        };
        let labels = observations.configurations.par_iter().map(one).collect();
        Ok(Labelling { labels, whole_arm: true })
    }
}
