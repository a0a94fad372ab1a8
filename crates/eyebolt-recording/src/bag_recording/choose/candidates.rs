//! One topic among those of a bag: the one that is named, else the only one that can be meant.

use crate::bag_recording::scan::TopicScan;
use crate::error::RecordingError;
use eyebolt_robot::Input;
use std::path::Path;

/// What is looked for.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    /// Who may name it.
    pub(super) by: By,
    /// What it is, for messages.
    pub(super) what: &'a str,
    /// Its name, if it is named.
    pub(super) name: Option<&'a str>,
}

/// Who names a topic.
#[derive(Clone, Copy)]
pub(super) enum By {
    /// The caller.
    Input(Input),
    /// The bag itself, in this field.
    Bag(&'static str),
}

/// The topics of the bag at `path`.
#[derive(Clone, Copy)]
pub(super) struct Candidates<'a> {
    pub(super) path: &'a Path,
    pub(super) topics: &'a [TopicScan],
}

impl Candidates<'_> {
    /// Says that what `by` tells does not fit the bag.
    pub(super) fn invalid(
        &self,
        by: By,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> RecordingError {
        match by {
            By::Input(input) => RecordingError::of_input(self.path, input, problem, remedy),
            By::Bag(field) => RecordingError::invalid(self.path, field, problem, remedy),
        }
    }

    /// The topic of the name wanted, else the only one that `fits`.
    pub(super) fn one(
        &self,
        Wanted { by, what, name }: Wanted<'_>,
        fits: &dyn Fn(&TopicScan) -> bool,
    ) -> Result<Option<usize>, RecordingError> {
        if let Some(name) = name {
            return self.named(by, what, name, fits).map(Some);
        }
        let topics = self.topics.iter().enumerate();
        let mut found = topics.filter(|(_, topic)| fits(topic)).map(|(number, _)| number);
        match (found.next(), found.next()) {
            (Some(_), Some(_)) => {
                let problem = format!("several topics have {what}");
                Err(self.invalid(by, problem, self.fitting(fits)))
            }
            (found, _) => Ok(found),
        }
    }

    fn named(
        &self,
        by: By,
        what: &str,
        name: &str,
        fits: &dyn Fn(&TopicScan) -> bool,
    ) -> Result<usize, RecordingError> {
        let problem = match self.topics.iter().position(|topic| topic.name == name) {
            Some(number) => match self.topics.get(number).filter(|topic| !fits(topic)) {
                None => return Ok(number),
                Some(topic) => {
                    let kind = &topic.message_type;
                    format!("{name} is of type {kind} and has no {what} that can be read")
                }
            },
            None => format!("there is no topic {name}"),
        };
        Err(self.invalid(by, problem, self.fitting(fits)))
    }

    /// As [`Self::one`], of what no recording is without.
    pub(super) fn needed(
        &self,
        wanted: Wanted<'_>,
        fits: &dyn Fn(&TopicScan) -> bool,
    ) -> Result<usize, RecordingError> {
        self.one(wanted, fits)?.ok_or_else(|| {
            let problem = format!("no topic has {}", wanted.what);
            let remedy = format!("Record it too; the bag has {}", self.all());
            self.invalid(wanted.by, problem, remedy)
        })
    }

    /// The only topic that `fits`, where among several none is better than the wrong one.
    pub(super) fn only(&self, fits: &dyn Fn(&TopicScan) -> bool) -> Option<usize> {
        let mut fitting = self.topics.iter().enumerate().filter(|(_, topic)| fits(topic));
        let found = fitting.next().map(|(number, _)| number);
        found.filter(|_| fitting.next().is_none())
    }

    /// Says which topics could be meant.
    pub(super) fn fitting(&self, fits: &dyn Fn(&TopicScan) -> bool) -> String {
        let fitting: Vec<_> =
            self.topics.iter().filter(|t| fits(t)).map(|t| t.name.as_str()).collect();
        match fitting.is_empty() {
            true => format!("There is none that would do; the bag has {}", self.all()),
            false => format!("Give one of {}", fitting.join(", ")),
        }
    }

    fn all(&self) -> String {
        let topics = self.topics.iter();
        let names: Vec<_> = topics.map(|t| format!("{} ({})", t.name, t.message_type)).collect();
        if names.is_empty() { "no messages at all".to_owned() } else { names.join(", ") }
    }
}
