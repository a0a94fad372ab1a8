//! `calibrate` as a function.

use super::caller::Caller;
use super::error::CallError;
use super::keywords::keywords;
use super::options::{other, parsed};
use crate::arguments::Command;
use crate::{calibrate as command, names};
use eyebolt::answer::Answer;
use eyebolt::calibrate::Verdict;
use eyebolt::pipeline::Outcome;
use eyebolt::progress::Progress;
use eyebolt::report::{Context, Picture, html, overlays, remedies};
use eyebolt_recording::Recording;
use eyebolt_robot::Input;
use std::ffi::OsString;

/// A calibration with what it was made of.
pub struct Calibrated {
    arguments: Box<command::Arguments>,
    /// Whether the frames were in memory, where their colour pictures are not known.
    of_memory: bool,
    answer: Answer,
    outcome: Outcome,
}

/// Calibrates `frames`, or the recording that `words` name, as `eyebolt calibrate` does but for markers.
///
/// # Errors
///
/// Words that are none of its options; a recording or a robot that cannot be read, or do not fit; work that `progress`
/// ended. A refused calibration is none.
pub fn calibrate(
    words: Vec<OsString>,
    frames: Option<Recording<'_>>,
    progress: &dyn Progress,
) -> Result<Calibrated, CallError> {
    let Command::Calibrate(arguments) = parsed("calibrate", words)? else { return other() };
    let of_memory = frames.is_some();
    let (answer, outcome) = match frames {
        Some(frames) => command::of(&arguments, frames, progress)?,
        None => command::of_named(&arguments, progress)?,
    };
    Ok(Calibrated { arguments, of_memory, answer, outcome })
}

impl Calibrated {
    /// What `eyebolt calibrate` writes.
    pub fn json(&self) -> String {
        self.answer.to_json()
    }

    /// What to do about each reason of a refusal.
    pub fn remedies(&self) -> Vec<String> {
        match &self.outcome.calibration.verdict {
            Verdict::Trusted => Vec::new(),
            Verdict::Refused(reasons) => {
                let told = reasons.iter().flat_map(|reason| remedies(reason));
                told.map(|text| keywords(text)).collect()
            }
        }
    }

    /// Every configuration with the posed arm over it, by the name of its first frame.
    ///
    /// # Errors
    ///
    /// The recording, which is opened again for its colour pictures, cannot be read any more.
    pub fn overlays(&self, caller: &Caller<'_>) -> Result<Vec<(String, Picture)>, CallError> {
        let observed = self.outcome.observations.iter().flat_map(|it| &it.configurations);
        let names = observed.map(|it| it.frames.first().cloned().unwrap_or_default());
        Ok(names.zip(self.pictures(caller)?).collect())
    }

    /// A page for a browser, complete in one file: HTML, about the recording called `name`.
    ///
    /// # Errors
    ///
    /// As of [`Self::overlays`].
    pub fn report(&self, name: &str, caller: &Caller<'_>) -> Result<String, CallError> {
        let pictures = self.pictures(caller)?;
        let context = Context {
            recording: name,
            pictures: &pictures,
            call_input: keyword,
            ..Context::default()
        };
        Ok(html(&self.answer, &self.outcome, &context))
    }

    /// What Foxglove, Lichtblick and RViz show, as MCAP, and a layout for the first two; `None` without a pose.
    ///
    /// # Errors
    ///
    /// As of [`Self::overlays`].
    pub fn viewer(&self, caller: &Caller<'_>) -> Result<Option<(Vec<u8>, String)>, CallError> {
        let (answer, outcome) = (&self.answer, &self.outcome);
        Ok(match self.of_memory {
            true => command::viewer_bytes(answer, outcome, None, &self.pictures(caller)?)?,
            false => command::viewer_of_named(&self.arguments, answer, outcome, caller)?,
        })
    }

    fn pictures(&self, caller: &Caller<'_>) -> Result<Vec<Picture>, CallError> {
        Ok(match self.of_memory {
            true => overlays(&self.outcome, |_| None).collect(),
            false => command::pictures_of_named(&self.arguments, &self.outcome, caller)?,
        })
    }
}

fn keyword(input: Input) -> String {
    keywords(&names::flag(input))
}
