//! What a network is taught: one trait for all of them.

use super::error::TrainError;
use eyebolt_net::losses::Loss;
use eyebolt_net::models::ModelDescription;
use eyebolt_net::training::{Rule, Schedule};
use eyebolt_net::{Batch, Cpu, Graph, Matrix, Parameters};
use std::collections::BTreeMap;

/// What a network is taught, from what and by which measure.
///
/// A batch depends on its number alone, so that a run that was killed goes on as if nothing had been.
pub trait Lesson: Sync {
    /// What outputs are compared with.
    type Target: Send;

    /// The network.
    fn graph(&self) -> &Graph;

    /// What it is, for whoever uses it; its metrics are still empty.
    fn description(&self) -> ModelDescription;

    /// Inputs and targets of step `step`.
    ///
    /// # Errors
    ///
    /// Nothing can be drawn, or read.
    fn batch(&self, step: u64) -> Result<(Batch, Self::Target), TrainError>;

    /// One loss for each output of the network.
    ///
    /// # Errors
    ///
    /// Outputs that are not finite.
    fn loss(
        &self,
        outputs: &[Matrix],
        target: &Self::Target,
    ) -> Result<Vec<Loss>, eyebolt_net::Error>;

    /// How good it is on what it never learns from: names with units, and what is compared, larger being
    /// better.
    ///
    /// # Errors
    ///
    /// As [`Self::batch`].
    fn validate(
        &self,
        parameters: &Parameters,
        executor: &mut Cpu,
    ) -> Result<(BTreeMap<String, f64>, f64), TrainError>;
}

/// How a network is taught.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Steps in all.
    pub steps: u64,
    /// How parameters follow gradients.
    pub rule: Rule,
    /// The highest learning rate.
    pub rate: f64,
    /// Of initial weights and dropout.
    pub seed: u64,
    /// Steps from one validation and checkpoint to the next.
    pub every: u64,
    /// End after so many validations without a better one.
    pub patience: u64,
    /// Threads that make batches.
    pub threads: usize,
}

impl Plan {
    /// The learning rate over the steps: a short rise, then half a cosine to zero.
    pub fn schedule(&self) -> Schedule {
        Schedule::Cosine { rate: self.rate, warm_up: (self.steps / 30).max(1), total: self.steps }
    }
}
