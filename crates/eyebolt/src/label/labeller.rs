//! The door for whatever tells the arm's pixels from the rest.

use crate::observations::Observations;
use eyebolt_registration::Labels;
use std::error::Error;
use std::fmt::Debug;

/// What a labeller tells of observations.
#[derive(Clone, Debug)]
pub struct Labelling {
    /// Labels of each configuration, in their order: of a rectangle of its image outside of which everything is
    /// background.
    pub labels: Vec<Labels>,
    /// Whether all of the arm that is in view is labelled, and not only what of it moved.
    pub whole_arm: bool,
}

/// Tells the arm's pixels from the rest: masks, motion, a posed model, a network.
pub trait Labeller: Debug + Sync {
    /// Labels of each configuration of `observations`.
    ///
    /// Pixels that show the arm are [`EndEffector`](eyebolt_registration::Label::EndEffector) only
    /// where the labeller can tell, else [`Arm`](eyebolt_registration::Label::Arm).
    ///
    /// # Errors
    ///
    /// Whatever keeps the labeller from its work.
    fn label(&self, observations: &Observations)
    -> Result<Labelling, Box<dyn Error + Send + Sync>>;
}
