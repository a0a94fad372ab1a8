//! From gradients to steps.

use crate::{Error, Graph, Parameters};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// How parameters follow their gradients.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Rule {
    /// Adam (Kingma and Ba, ICLR 2015, algorithm 1).
    Adam {
        /// Of the mean of gradients.
        beta1: f32,
        /// Of the mean of their squares.
        beta2: f32,
        /// Added to the root.
        epsilon: f32,
        /// Share of the parameters.
        weight_decay: f32,
        /// Decay apart from the gradient: AdamW (Loshchilov and Hutter, ICLR 2019).
        decoupled: bool,
    },
    /// Stochastic gradient descent with momentum.
    Sgd {
        /// Share of the last step that goes on.
        momentum: f32,
        /// Share of the parameters that joins the gradient.
        weight_decay: f32,
    },
}

impl Rule {
    /// That steps by it can lead anywhere.
    ///
    /// # Errors
    /// If a constant is out of bounds.
    pub fn check(self) -> Result<(), Error> {
        let share = |name: &str, value: f32| match (0.0..1.0).contains(&value) {
            true => Ok(()),
            false => {
                let problem = format!("{value} is not from 0 up to but not including 1");
                Err(Error::input(name, problem))
            }
        };
        let (epsilon, decay) = match self {
            Self::Adam { beta1, beta2, epsilon, weight_decay, .. } => {
                share("beta1", beta1)?;
                share("beta2", beta2)?;
                (epsilon, weight_decay)
            }
            Self::Sgd { momentum, weight_decay } => {
                share("momentum", momentum)?;
                (1.0, weight_decay)
            }
        };
        if !(epsilon.is_finite() && epsilon > 0.0) {
            return Err(Error::input("epsilon", format!("{epsilon} is not positive")));
        }
        if !(decay.is_finite() && decay >= 0.0) {
            return Err(Error::input(
                "weight_decay",
                format!("{decay} is negative or not a number"),
            ));
        }
        Ok(())
    }

    /// Adam with its usual constants and decay as part of the gradient.
    pub fn adam(weight_decay: f32) -> Self {
        Self::Adam { beta1: 0.9, beta2: 0.999, epsilon: 1e-8, weight_decay, decoupled: false }
    }

    /// AdamW with its usual constants.
    pub fn adamw(weight_decay: f32) -> Self {
        Self::Adam { beta1: 0.9, beta2: 0.999, epsilon: 1e-8, weight_decay, decoupled: true }
    }
}

/// A rule and what it remembers.
#[derive(Clone, Debug, PartialEq)]
pub struct Optimiser {
    pub(super) rule: Rule,
    pub(super) updates: u64,
    /// Mean of gradients, or velocity.
    pub(super) first: Vec<Vec<f32>>,
    /// Mean of squares; empty of SGD.
    pub(super) second: Vec<Vec<f32>>,
}

impl Optimiser {
    /// Remembering nothing yet.
    pub fn new(rule: Rule, parameters: &Parameters) -> Self {
        let zeros = || parameters.values().iter().map(|values| vec![0.0; values.len()]).collect();
        let second = match rule {
            Rule::Adam { .. } => zeros(),
            Rule::Sgd { .. } => Vec::new(),
        };
        Self { rule, updates: 0, first: zeros(), second }
    }

    /// One step of so large a rate. `gradients` in the graph's order.
    ///
    /// # Panics
    /// If gradients or parameters are not those of the graph.
    pub fn update(
        &mut self,
        graph: &Graph,
        parameters: &mut Parameters,
        gradients: &[Vec<f32>],
        rate: f64,
    ) {
        let lengths = |list: &[Vec<f32>]| list.iter().map(Vec::len).collect::<Vec<_>>();
        let own = lengths(&self.first);
        assert_eq!(lengths(gradients), own, "a gradient for each value");
        assert_eq!(lengths(parameters.values()), own, "the parameters that it began with");
        self.updates += 1;
        let (rule, updates) = (self.rule, self.updates);
        let mut nothing: Vec<Vec<f32>> = vec![Vec::new(); gradients.len()];
        let second = if self.second.is_empty() { &mut nothing } else { &mut self.second };
        let memory = self.first.par_iter_mut().zip(second.par_iter_mut());
        let parts = parameters.values_mut().par_iter_mut().zip(gradients).zip(memory);
        parts.zip(graph.parameters()).for_each(|(((values, gradient), (first, second)), spec)| {
            if spec.role.is_trained() {
                step(rule, updates, rate, values, gradient, first, second);
            }
        });
    }
}

fn step(
    rule: Rule,
    updates: u64,
    rate: f64,
    values: &mut [f32],
    gradient: &[f32],
    first: &mut [f32],
    second: &mut [f32],
) {
    assert_eq!(values.len(), gradient.len(), "a gradient for each value");
    match rule {
        Rule::Sgd { momentum, weight_decay } => {
            for ((value, gradient), velocity) in values.iter_mut().zip(gradient).zip(first) {
                let gradient = gradient + weight_decay * *value;
                *velocity = momentum * *velocity + gradient;
                *value -= rate as f32 * *velocity;
            }
        }
        Rule::Adam { beta1, beta2, epsilon, weight_decay, decoupled } => {
            // What the means lack of their first steps.
            let power = updates.min(i32::MAX as u64) as i32;
            let bias1 = 1.0 - f64::from(beta1).powi(power);
            let bias2 = 1.0 - f64::from(beta2).powi(power);
            let (size, root) = ((rate / bias1) as f32, (1.0 / bias2.sqrt()) as f32);
            let kept = 1.0 - (rate * f64::from(weight_decay)) as f32;
            let memory = first.iter_mut().zip(second);
            for ((value, &gradient), (mean, square)) in values.iter_mut().zip(gradient).zip(memory)
            {
                let gradient = if decoupled {
                    *value *= kept;
                    gradient
                } else {
                    gradient + weight_decay * *value
                };
                *mean = beta1 * *mean + (1.0 - beta1) * gradient;
                *square = beta2 * *square + (1.0 - beta2) * gradient * gradient;
                *value -= size * *mean / (square.sqrt() * root + epsilon);
            }
        }
    }
}
