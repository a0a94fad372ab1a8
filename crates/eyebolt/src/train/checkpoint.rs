//! A run as bytes and back.

use super::error::TrainError;
use super::lesson::Plan;
use eyebolt_net::training::Trainer;
use eyebolt_net::{Graph, Parameters, weights};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Everything that the rest of a run depends on.
pub struct Checkpoint {
    /// The network and what its optimiser remembers.
    pub trainer: Trainer,
    /// The mean of the parameters of the last steps: what is validated and handed on.
    pub averaged: Parameters,
    /// The best of them by validation, once there was one.
    pub best: Option<Parameters>,
    /// The rest.
    pub progressed: Progressed,
}

/// How far a run is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Progressed {
    /// Steps in all.
    pub steps: u64,
    /// Seed of the run.
    pub seed: u64,
    /// What the best parameters reached, larger being better.
    pub best_value: Option<f64>,
    /// Their scores.
    pub best_scores: BTreeMap<String, f64>,
    /// Validations since.
    pub without_better: u64,
}

impl Progressed {
    /// Nothing yet.
    pub fn new(plan: &Plan) -> Self {
        Self {
            steps: plan.steps,
            seed: plan.seed,
            best_value: None,
            best_scores: BTreeMap::new(),
            without_better: 0,
        }
    }
}

const FILE: &str = "checkpoint";
/// Parts of a file: lengths of the parts as 64 bits each, little-endian, then the parts.
const PARTS: usize = 4;
/// Share of the mean that a step leaves as it was, at most: it goes over the last few hundred steps.
const KEPT: f32 = 0.995;

impl Checkpoint {
    /// A run that begins with these parameters.
    pub fn new(trainer: Trainer, plan: &Plan) -> Self {
        let averaged = trainer.parameters().clone();
        Self { trainer, averaged, best: None, progressed: Progressed::new(plan) }
    }

    /// Takes the parameters after a step into the mean (Polyak and Juditsky, *Acceleration of stochastic
    /// approximation by averaging*, 1992; with weights that fall, and over few steps at first).
    pub fn average(&mut self) {
        let steps = self.trainer.step_count() as f32;
        let kept = KEPT.min(steps / (steps + 10.0));
        self.averaged.approach(self.trainer.parameters(), 1.0 - kept);
    }

    /// Notes what a validation found; whether it is the best so far.
    pub fn note(&mut self, value: f64, scores: &BTreeMap<String, f64>) -> bool {
        let is_best = self.progressed.best_value.is_none_or(|best| value > best);
        if is_best {
            self.best = Some(self.averaged.clone());
            self.progressed.best_value = Some(value);
            self.progressed.best_scores = scores.clone();
            self.progressed.without_better = 0;
        } else {
            self.progressed.without_better += 1;
        }
        is_best
    }

    /// Everything as bytes: the same for the same state.
    ///
    /// # Errors
    ///
    /// A value is not finite.
    pub fn to_bytes(&self, graph: &Graph) -> Result<Vec<u8>, TrainError> {
        let text = serde_json::to_vec(&self.progressed).map_err(|error| bad("state", error))?;
        let best = match &self.best {
            Some(best) => weights::to_bytes(graph, best)?,
            None => Vec::new(),
        };
        let averaged = weights::to_bytes(graph, &self.averaged)?;
        let parts = [text, self.trainer.checkpoint(graph)?, averaged, best];
        let lengths = parts.iter().flat_map(|part| (part.len() as u64).to_le_bytes());
        Ok(lengths.chain(parts.iter().flatten().copied()).collect())
    }

    /// The state that [`Self::to_bytes`] wrote, if it is of a run by this plan.
    ///
    /// # Errors
    ///
    /// A cut file, another network's, another plan's.
    pub fn from_bytes(graph: &Graph, bytes: &[u8], plan: &Plan) -> Result<Self, TrainError> {
        let [text, trainer, averaged, best] = split(bytes)?;
        let progressed: Progressed =
            serde_json::from_slice(text).map_err(|error| bad("state", error))?;
        if (progressed.steps, progressed.seed) != (plan.steps, plan.seed) {
            let problem = format!(
                "of a run of {} steps with seed {}, not of {} with seed {}; go on with the same, or \
                 begin anew",
                progressed.steps, progressed.seed, plan.steps, plan.seed
            );
            return Err(bad("plan", problem));
        }
        let trainer = Trainer::resume(graph, trainer)?;
        let averaged = weights::from_bytes(graph, averaged)?;
        let best = (!best.is_empty()).then(|| weights::from_bytes(graph, best)).transpose()?;
        Ok(Self { trainer, averaged, best, progressed })
    }

    /// Steps and seed of the run whose bytes these are.
    ///
    /// # Errors
    ///
    /// A cut file.
    pub fn progressed(bytes: &[u8]) -> Result<Progressed, TrainError> {
        let [text, ..] = split(bytes)?;
        serde_json::from_slice(text).map_err(|error| bad("state", error))
    }
}

fn bad(field: &str, problem: impl std::fmt::Display) -> TrainError {
    TrainError::File {
        file: FILE.into(),
        field: field.into(),
        problem: format!("{problem}. Begin anew without it"),
    }
}

fn split(bytes: &[u8]) -> Result<[&[u8]; PARTS], TrainError> {
    let cut = || bad("length", "the file is cut");
    let (head, mut rest) = bytes.split_at_checked(8 * PARTS).ok_or_else(cut)?;
    let mut parts = [&[][..]; PARTS];
    for (part, length) in parts.iter_mut().zip(head.as_chunks::<8>().0) {
        let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| cut())?;
        (*part, rest) = rest.split_at_checked(length).ok_or_else(cut)?;
    }
    if rest.is_empty() { Ok(parts) } else { Err(bad("length", "there is something after its end")) }
}
