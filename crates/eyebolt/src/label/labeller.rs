//! The door for whatever tells the arm's pixels from the rest.

use crate::observations::Observations;
use eyebolt_registration::Labels;
use std::fmt::Debug;

/// Tells the arm's pixels from the rest: masks, motion, a posed model, a network.
pub trait Labeller: Debug + Sync {
    /// Labels of each configuration of `observations`, in their order: of a rectangle of its image
    /// outside of which everything is background.
    ///
    /// Pixels that show the arm are [`EndEffector`](eyebolt_registration::Label::EndEffector) only
    /// where the labeller can tell, else [`Arm`](eyebolt_registration::Label::Arm).
    fn label(&self, observations: &Observations) -> Vec<Labels>;
}
