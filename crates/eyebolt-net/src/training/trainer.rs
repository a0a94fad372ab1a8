//! A network while it learns.

use super::optimiser::{Optimiser, Rule};
use super::schedule::Schedule;
use crate::losses::Loss;
use crate::random::Random;
use crate::{Batch, Error, Executor, Forward, Gradients, Graph, Matrix, Parameters, PassOptions};

/// Its square is well within 32 bits.
const LARGEST_GRADIENT: f32 = 1e18;

/// A network while it learns. Everything that the next step depends on is in here and in a
/// [checkpoint](Trainer::checkpoint), so that a run goes on as if nothing had been.
#[derive(Clone, Debug, PartialEq)]
pub struct Trainer {
    pub(super) parameters: Parameters,
    pub(super) optimiser: Optimiser,
    pub(super) schedule: Schedule,
    pub(super) seed: u64,
    pub(super) step: u64,
}

impl Trainer {
    /// From initial weights; `seed` is that of weights and dropout.
    pub fn new(graph: &Graph, rule: Rule, schedule: Schedule, seed: u64) -> Self {
        Self::from_parameters(Parameters::initial(graph, seed), rule, schedule, seed)
    }

    /// From weights that are there already, to tune them; `seed` is that of dropout.
    pub fn from_parameters(
        parameters: Parameters,
        rule: Rule,
        schedule: Schedule,
        seed: u64,
    ) -> Self {
        let optimiser = Optimiser::new(rule, &parameters);
        Self { parameters, optimiser, schedule, seed, step: 0 }
    }

    /// Another learning rate from the next step on, as when a run that was resumed should last
    /// longer.
    pub fn set_schedule(&mut self, schedule: Schedule) {
        self.schedule = schedule;
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
    /// Those of the executor and the loss; or if the rule or the schedule is out of bounds, the loss
    /// or a running value is not finite, or a gradient so large that its square is not. Nothing is
    /// changed then.
    pub fn step(
        &mut self,
        executor: &mut dyn Executor,
        graph: &Graph,
        batch: &Batch,
        loss: impl FnOnce(&[Matrix]) -> Result<Vec<Loss>, Error>,
    ) -> Result<f64, Error> {
        self.optimiser.rule.check()?;
        self.schedule.check()?;
        let seed = Random::new(self.seed).at(self.step).next();
        let options = PassOptions { seed, with_inputs: false };
        let (mut loss, mut value) = (Some(loss), 0.0);
        let mut output_gradients = |outputs: &[Matrix]| {
            let loss = loss.take().ok_or_else(|| Error::network("training", "a second loss"))?;
            let losses = loss(outputs)?;
            value = losses.iter().map(|loss| loss.value).sum();
            Ok(losses.into_iter().map(|loss| loss.gradient).collect())
        };
        let of = &mut output_gradients;
        let (forward, gradients) =
            executor.forward_backward(graph, &self.parameters, batch, options, of)?;
        self.check_sizes(graph, value, &forward, &gradients)?;
        let rate = self.schedule.rate(self.step);
        self.optimiser.update(graph, &mut self.parameters, &gradients.parameters, rate);
        for (id, values) in forward.running {
            self.parameters.get_mut(id).copy_from_slice(&values);
        }
        self.step += 1;
        Ok(value)
    }

    /// That nothing is so large that it would spoil the parameters, or what the optimiser remembers.
    fn check_sizes(
        &self,
        graph: &Graph,
        loss: f64,
        forward: &Forward,
        gradients: &Gradients,
    ) -> Result<(), Error> {
        let bad = |what: String| {
            let problem = format!("step {}: {what}; a smaller rate or features?", self.step);
            Err(Error::network("training", problem))
        };
        if !loss.is_finite() {
            return bad(format!("the loss is {loss}"));
        }
        let is_large = |value: &f32| value.is_nan() || value.abs() > LARGEST_GRADIENT;
        for (spec, values) in graph.parameters().iter().zip(&gradients.parameters) {
            if let Some(value) = values.iter().copied().find(is_large) {
                return bad(format!("a gradient of {} is {value}", spec.name));
            }
        }
        for (id, values) in &forward.running {
            if let Some(value) = values.iter().find(|value| !value.is_finite()) {
                return bad(format!("{} would be {value}", graph.parameters()[id.index()].name));
            }
        }
        Ok(())
    }
}
