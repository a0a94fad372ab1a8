//! A network while it is taught: steps, validations, checkpoints.

use super::checkpoint::Checkpoint;
use super::error::TrainError;
use super::feed::Feed;
use super::lesson::{Lesson, Plan};
use crate::progress::Progress;
use eyebolt_net::models::Model;
use eyebolt_net::training::Trainer;
use eyebolt_net::weights::{Layout, load_matching};
use eyebolt_net::{Cpu, Graph, Parameters};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What is told of a run, one at a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Steps taken.
    pub step: u64,
    /// Steps in all.
    pub steps: u64,
    /// Mean loss since the last report.
    pub loss: f64,
    /// Learning rate of the next step.
    pub rate: f64,
    /// By name, of images that it never learns from.
    pub scores: BTreeMap<String, f64>,
    /// Whether these are the best so far.
    pub is_best: bool,
    /// Share of the batches since the last report that the network had to wait for.
    pub waited_share: f64,
}

/// Where a run tells of itself and keeps what it has.
pub trait Keep {
    /// Takes a report.
    ///
    /// # Errors
    ///
    /// It cannot be written.
    fn report(&mut self, report: &Report) -> Result<(), TrainError>;

    /// Keeps a checkpoint in the place of the last one, whole or not at all.
    ///
    /// # Errors
    ///
    /// It cannot be written.
    fn checkpoint(&mut self, bytes: &[u8]) -> Result<(), TrainError>;
}

/// Where a run begins.
#[derive(Clone, Copy, Debug)]
pub enum Beginning<'a> {
    /// With weights that know nothing.
    Anew,
    /// With the weights of another network, safetensors, as far as they fit.
    Weights(&'a [u8]),
    /// Where it was when this checkpoint was written.
    Checkpoint(&'a [u8]),
}

impl Beginning<'_> {
    fn state(self, graph: &Graph, plan: &Plan) -> Result<Checkpoint, TrainError> {
        let mut parameters = Parameters::initial(graph, plan.seed);
        match self {
            Self::Checkpoint(bytes) => return Checkpoint::from_bytes(graph, bytes, plan),
            Self::Weights(bytes) => {
                let fit = load_matching(graph, &mut parameters, bytes, Layout::Eyebolt)?;
                if fit.loaded.is_empty() {
                    return Err(TrainError::File {
                        file: "weights.safetensors".into(),
                        field: "tensors".into(),
                        problem: "none fits the network. Begin with a model of the same kind"
                            .into(),
                    });
                }
            }
            Self::Anew => {}
        }
        let trainer = Trainer::from_parameters(parameters, plan.rule, plan.schedule(), plan.seed);
        Ok(Checkpoint::new(trainer, plan))
    }
}

/// Teaches `lesson` by `plan`. The best network by its validations.
///
/// # Errors
///
/// The lesson's and the network's; weights or a checkpoint of another network or run; what `keep` cannot
/// write; cancelled.
pub fn teach<L: Lesson>(
    lesson: &L,
    plan: &Plan,
    from: Beginning<'_>,
    keep: &mut dyn Keep,
    progress: &dyn Progress,
) -> Result<Model, TrainError> {
    let graph = lesson.graph();
    let mut state = from.state(graph, plan)?;
    std::thread::scope(|scope| {
        let span = (state.trainer.step_count(), plan.steps);
        let mut feed = Feed::start(scope, plan.threads, span, |step| lesson.batch(step));
        let mut cpu = Cpu::new();
        let (mut sum, mut count, mut waited) = (0.0, 0_u64, 0_u64);
        while let Some(batch) = feed.next() {
            let (batch, target) = batch?;
            sum += state
                .trainer
                .step(&mut cpu, graph, &batch, |outputs| lesson.loss(outputs, &target))?;
            state.average();
            count += 1;
            let step = state.trainer.step_count();
            progress.advance(step as usize, plan.steps as usize)?;
            if !step.is_multiple_of(plan.every) && step < plan.steps {
                continue;
            }
            let (scores, value) = lesson.validate(&state.averaged, &mut cpu)?;
            let is_best = state.note(value, &scores);
            keep.report(&Report {
                step,
                steps: plan.steps,
                loss: sum / count as f64,
                rate: plan.schedule().rate(step),
                scores,
                is_best,
                waited_share: (feed.waited_for - waited) as f64 / count as f64,
            })?;
            (sum, count, waited) = (0.0, 0, feed.waited_for);
            keep.checkpoint(&state.to_bytes(graph)?)?;
            if state.progressed.without_better >= plan.patience {
                break;
            }
        }
        Ok::<(), TrainError>(())
    })?;
    finished(lesson, state)
}

/// Seconds that a step takes, over a few steps of a network that is then forgotten; `clock` tells seconds.
///
/// # Errors
///
/// As [`teach`].
pub fn pace<L: Lesson>(
    lesson: &L,
    plan: &Plan,
    clock: &dyn Fn() -> f64,
) -> Result<f64, TrainError> {
    /// Steps before the clock runs, and those that it runs for.
    const STEPS: [u64; 2] = [4, 16];
    let graph = lesson.graph();
    let mut trainer = Trainer::new(graph, plan.rule, plan.schedule(), plan.seed);
    std::thread::scope(|scope| {
        let span = (0, STEPS[0] + STEPS[1]);
        let feed = Feed::start(scope, plan.threads, span, |step| lesson.batch(step));
        let mut cpu = Cpu::new();
        let mut begun = clock();
        for batch in feed {
            let (batch, target) = batch?;
            trainer.step(&mut cpu, graph, &batch, |outputs| lesson.loss(outputs, &target))?;
            if trainer.step_count() == STEPS[0] {
                begun = clock();
            }
        }
        Ok((clock() - begun) / STEPS[1] as f64)
    })
}

fn finished<L: Lesson>(lesson: &L, state: Checkpoint) -> Result<Model, TrainError> {
    let mut description = lesson.description();
    description.metrics = state.progressed.best_scores;
    let parameters: Parameters = match state.best {
        Some(best) => best,
        None => state.averaged,
    };
    Ok(Model::new(description, parameters)?)
}
