//! A trainer as bytes and back.

use super::optimiser::{Optimiser, Rule};
use super::schedule::Schedule;
use super::trainer::Trainer;
use crate::weights::{self, Entry, Tensors};
use crate::{Error, Graph};
use serde::{Deserialize, Serialize};

/// What is not a tensor.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct State {
    rule: Rule,
    schedule: Schedule,
    /// As text: TOML has no numbers beyond 63 bits.
    seed: String,
    step: u64,
    updates: u64,
}

const FILE: &str = "checkpoint";
const STATE: &str = "trainer";

impl Trainer {
    /// Everything, as safetensors: parameters by name, the optimiser's memory as `first.NAME` and
    /// `second.NAME`, the rest in the metadata. Write it beside the old one, then rename.
    ///
    /// # Errors
    /// If the graph is another one, or a value is not finite.
    pub fn checkpoint(&self, graph: &Graph) -> Result<Vec<u8>, Error> {
        let state = State {
            rule: self.optimiser.rule,
            schedule: self.schedule,
            seed: self.seed.to_string(),
            step: self.step,
            updates: self.optimiser.updates,
        };
        let text = toml::to_string(&state);
        let text = text.map_err(|error| Error::file(FILE, STATE, error.to_string()))?;
        let mut entries = weights::entries(FILE, graph, "", self.parameters.values())?;
        entries.extend(weights::entries(FILE, graph, "first.", &self.optimiser.first)?);
        if !self.optimiser.second.is_empty() {
            entries.extend(weights::entries(FILE, graph, "second.", &self.optimiser.second)?);
        }
        weights::serialise(FILE, entries, &[(STATE, text)])
    }

    /// The trainer that a checkpoint holds.
    ///
    /// # Errors
    /// If the bytes are not a checkpoint of this graph, complete and with nothing more.
    pub fn resume(graph: &Graph, bytes: &[u8]) -> Result<Self, Error> {
        let mut tensors = Tensors::read(FILE, bytes)?;
        let text = tensors.metadata(STATE)?;
        let state: State =
            toml::from_str(&text).map_err(|error| Error::file(FILE, STATE, error.to_string()))?;
        let seed = state.seed.parse();
        let seed = seed.map_err(|_| Error::file(FILE, "seed", "not a number of 64 bits"))?;
        let by_field = |error| Error::file(FILE, STATE, format!("{error}"));
        state.rule.check().map_err(by_field)?;
        state.schedule.check().map_err(by_field)?;
        let parameters = tensors.take_all(graph, "", Entry::plain)?;
        let first = tensors.take_all(graph, "first.", Entry::plain)?;
        let second = match state.rule {
            Rule::Adam { .. } => tensors.take_all(graph, "second.", Entry::plain)?,
            Rule::Sgd { .. } => Vec::new(),
        };
        tensors.finish()?;
        for (spec, values) in graph.parameters().iter().zip(&second) {
            if let Some(at) = values.iter().position(|&value| value < 0.0) {
                let problem = format!("value {at} is {}, and it is a mean of squares", values[at]);
                return Err(Error::file(FILE, format!("second.{}", spec.name), problem));
            }
        }
        Ok(Self {
            parameters: crate::Parameters::new(graph, parameters)?,
            optimiser: Optimiser { rule: state.rule, updates: state.updates, first, second },
            schedule: state.schedule,
            seed,
            step: state.step,
        })
    }
}
