//! Learning: optimisers, schedules, steps, checkpoints.

mod checkpoint;
mod optimiser;
mod schedule;

pub use optimiser::{Optimiser, Rule};
pub use schedule::Schedule;

use crate::losses::Loss;
use crate::{Batch, Error, Executor, Graph, Matrix, Parameters};

/// A network while it learns. Everything that the next step depends on is in here and in a
/// [checkpoint](Trainer::checkpoint), so that a run goes on as if nothing had been.
#[derive(Clone, Debug, PartialEq)]
pub struct Trainer {
    parameters: Parameters,
    optimiser: Optimiser,
    schedule: Schedule,
    seed: u64,
    step: u64,
}

impl Trainer {
    /// From initial weights; `seed` is that of weights and dropout.
    pub fn new(graph: &Graph, rule: Rule, schedule: Schedule, seed: u64) -> Self {
        let parameters = Parameters::initial(graph, seed);
        let optimiser = Optimiser::new(rule, &parameters);
        Self { parameters, optimiser, schedule, seed, step: 0 }
    }

    /// The parameters as they are by now.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Steps taken.
    pub fn step_count(&self) -> u64 {
        self.step
    }

    /// One step on a batch: forward, the loss of its outputs (one gradient each), backward, update.
    ///
    /// # Errors
    /// Those of the executor and the loss; or if the loss or a gradient is not finite, in which
    /// case nothing is changed.
    pub fn step(
        &mut self,
        executor: &mut dyn Executor,
        graph: &Graph,
        batch: &Batch,
        loss: impl FnOnce(&[Matrix]) -> Result<Vec<Loss>, Error>,
    ) -> Result<f64, Error> {
        let dropout = self.seed ^ self.step.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let forward = executor.forward(graph, &self.parameters, batch, dropout)?;
        let losses = loss(&forward.outputs)?;
        let value: f64 = losses.iter().map(|loss| loss.value).sum();
        let of: Vec<Matrix> = losses.into_iter().map(|loss| loss.gradient).collect();
        let gradients = executor.backward(graph, &self.parameters, batch, &of, false)?;
        let finite = |values: &Vec<f32>| values.iter().all(|value| value.is_finite());
        if !value.is_finite() || !gradients.parameters.iter().all(finite) {
            let problem = format!("step {}: the loss or a gradient is not finite", self.step);
            return Err(Error::network("training", problem));
        }
        let rate = self.schedule.rate(self.step);
        self.optimiser.update(graph, &mut self.parameters, &gradients.parameters, rate);
        for (id, values) in forward.running {
            self.parameters.get_mut(id).copy_from_slice(&values);
        }
        self.step += 1;
        Ok(value)
    }
}
