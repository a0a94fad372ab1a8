//! The labeller for observations whose pose is not known yet.

use super::labeller::Labeller;
use super::masks::GivenMasks;
use super::moving::Motion;
use crate::observations::Observations;

/// Masks if every configuration has one, else motion.
pub fn before_pose(observations: &Observations) -> &'static dyn Labeller {
    match observations.has_masks() {
        true => &GivenMasks,
        false => &Motion,
    }
}
