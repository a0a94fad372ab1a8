//! The folder of a network, while it is taught and after.

use super::arguments::Kind;
use crate::front::Front;
use crate::output;
use anyhow::{Context, Result, anyhow};
use eyebolt::model_files::{DESCRIPTION, ModelFiles, WEIGHTS};
use eyebolt::train::{Keep, Report, TrainError, events};
use eyebolt_net::models::Model;
use std::path::{Path, PathBuf};

/// A folder with `model.toml` and `weights.safetensors`; until they are there, with a checkpoint; and with
/// what was reported, as JSON lines and for TensorBoard.
pub struct ModelFolder<'a> {
    front: &'a dyn Front,
    path: PathBuf,
    kind: Kind,
    force: bool,
    reports: Vec<Report>,
}

const CHECKPOINT: &str = "checkpoint";
const LOG: &str = "log.jsonl";
const EVENTS: &str = "events.out.tfevents.eyebolt";

impl<'a> ModelFolder<'a> {
    /// Of a network of `kind` in the folder of a `model`, which is made; with `force`, what is there is as if it were not.
    pub fn new(model: &Path, kind: Kind, force: bool, front: &'a dyn Front) -> Result<Self> {
        let path = model.join(kind.name());
        let failed =
            || format!("{}: cannot make the folder. Name another with --output", path.display());
        std::fs::create_dir_all(&path).with_context(failed)?;
        let mut folder = Self { front, path, kind, force, reports: Vec::new() };
        if !force && folder.checkpoint()?.is_some() {
            folder.reports = folder.read_log();
        }
        Ok(folder)
    }

    /// What the network tells.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the network is there already.
    pub fn is_ready(&self) -> bool {
        !self.force && self.path.join(DESCRIPTION).exists() && self.path.join(WEIGHTS).exists()
    }

    /// The checkpoint to go on from, if there is one.
    pub fn checkpoint(&self) -> Result<Option<Vec<u8>>> {
        let path = self.path.join(CHECKPOINT);
        if self.force || !path.exists() {
            return Ok(None);
        }
        let failed = || format!("{}: cannot read it", path.display());
        Ok(Some(std::fs::read(&path).with_context(failed)?))
    }

    /// Weights of the network of the same kind in the folder of another model; none if that model, as any-arm,
    /// has no such network.
    pub fn weights_of(&self, model: &ModelFiles) -> Result<Option<Vec<u8>>> {
        let own = self.kind.name();
        if model.has(Kind::Segmentation.name()) && !model.has(own) {
            self.front.say(&format!("  {} has none to begin with", model.place("").display()));
            return Ok(None);
        }
        let weights = model.weights(own).map_err(|(path, source)| {
            let remedy = "Name a model with --from";
            anyhow!(source).context(format!("{}: cannot read it. {remedy}", path.display()))
        })?;
        Ok(Some(weights.into_owned()))
    }

    /// Lines that were written before; what is not a line of ours is left out.
    fn read_log(&self) -> Vec<Report> {
        let text = std::fs::read_to_string(self.path.join(LOG)).unwrap_or_default();
        text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
    }

    /// Writes the network, and removes the checkpoint that led to it.
    pub fn write(&self, model: &Model) -> Result<()> {
        let mut model = model.clone();
        model.description.commit = concat!("eyebolt ", env!("CARGO_PKG_VERSION")).to_owned();
        let (text, bytes) = model.save_half()?;
        output::write_whole(&self.path.join(WEIGHTS), &bytes, true)?;
        output::write_whole(&self.path.join(DESCRIPTION), text.as_bytes(), true)?;
        let checkpoint = self.path.join(CHECKPOINT);
        match std::fs::remove_file(&checkpoint) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                let note = format!("{}: still there: {}", checkpoint.display(), error.kind());
                self.front.note(&note);
            }
            _ => {}
        }
        Ok(())
    }

    fn whole(&self, name: &str, bytes: &[u8]) -> Result<(), TrainError> {
        output::write_whole(&self.path.join(name), bytes, true).map_err(|error| TrainError::File {
            file: self.path.join(name).display().to_string(),
            field: "content".into(),
            problem: error.to_string(),
        })
    }
}

impl Keep for ModelFolder<'_> {
    fn report(&mut self, report: &Report) -> Result<(), TrainError> {
        // After a kill, what was reported beyond the checkpoint comes again.
        self.reports.retain(|before| before.step < report.step);
        self.reports.push(report.clone());
        let line = |report: &Report| serde_json::to_string(report).map(|line| line + "\n");
        let lines: Result<String, _> = self.reports.iter().map(line).collect();
        let failed = |error: serde_json::Error| TrainError::File {
            file: LOG.into(),
            field: "report".into(),
            problem: error.to_string(),
        };
        self.whole(LOG, lines.map_err(failed)?.as_bytes())?;
        self.whole(EVENTS, &events(&self.reports))?;
        let scores: Vec<String> =
            report.scores.iter().map(|(name, value)| format!("{name} {value:.3}")).collect();
        let best = if report.is_best { " (best)" } else { "" };
        self.front.say(&format!(
            "  step {} of {}, loss {:.4}, {}{best}",
            report.step,
            report.steps,
            report.loss,
            scores.join(", ")
        ));
        Ok(())
    }

    fn checkpoint(&mut self, bytes: &[u8]) -> Result<(), TrainError> {
        self.whole(CHECKPOINT, bytes)
    }
}
