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
    /// Types of the messages that it may be on.
    pub(super) types: &'a [&'a str],
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

/// Topics that a message lists.
const MOST_TOLD: usize = 20;

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
        wanted: Wanted<'_>,
        fits: &dyn Fn(&TopicScan) -> bool,
    ) -> Result<Option<usize>, RecordingError> {
        let Wanted { by, what, name, .. } = wanted;
        if let Some(name) = name {
            return self.named(wanted, name, fits).map(Some);
        }
        let topics = self.topics.iter().enumerate();
        let mut found = topics.filter(|(_, topic)| fits(topic)).map(|(number, _)| number);
        match (found.next(), found.next()) {
            (Some(_), Some(_)) => {
                let problem = format!("several topics have {what}");
                Err(self.invalid(by, problem, self.fitting(wanted, fits)))
            }
            (found, _) => Ok(found),
        }
    }

    fn named(
        &self,
        wanted: Wanted<'_>,
        name: &str,
        fits: &dyn Fn(&TopicScan) -> bool,
    ) -> Result<usize, RecordingError> {
        let Wanted { by, what, .. } = wanted;
        let problem = match self.topics.iter().position(|topic| topic.name == name) {
            Some(number) => match self.topics.get(number).filter(|topic| !fits(topic)) {
                None => return Ok(number),
                Some(topic) => {
                    let kind = &topic.message_type;
                    let why = topic.flaw().map(|why| format!(": {why}")).unwrap_or_default();
                    format!("{name} is of type {kind} and has no {what} that can be read{why}")
                }
            },
            None => format!("there is no topic {name}"),
        };
        Err(self.invalid(by, problem, self.fitting(wanted, fits)))
    }

    /// As [`Self::one`], of what no recording is without.
    pub(super) fn needed(
        &self,
        wanted: Wanted<'_>,
        fits: &dyn Fn(&TopicScan) -> bool,
    ) -> Result<usize, RecordingError> {
        self.one(wanted, fits)?.ok_or_else(|| {
            let of_type = self.of_type(wanted);
            if of_type.is_empty() {
                let problem = format!("no topic has {}", wanted.what);
                let remedy = format!("Record it too; the bag has {}", self.all());
                return self.invalid(wanted.by, problem, remedy);
            }
            let problem = format!("no topic has {} that can be used", wanted.what);
            let remedy = format!("Record one that can: {}", of_type.join("; "));
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
    pub(super) fn fitting(&self, wanted: Wanted<'_>, fits: &dyn Fn(&TopicScan) -> bool) -> String {
        let fitting: Vec<_> =
            self.topics.iter().filter(|t| fits(t)).map(|t| t.name.as_str()).collect();
        let of_type = self.of_type(wanted);
        match (fitting.is_empty(), of_type.is_empty()) {
            (false, _) => format!("Give one of {}", fitting.join(", ")),
            (true, false) => format!("There is none that would do: {}", of_type.join("; ")),
            (true, true) => format!("There is none that would do; the bag has {}", self.all()),
        }
    }

    /// The topics of the type that is looked for, with what is wrong with each.
    fn of_type(&self, wanted: Wanted<'_>) -> Vec<String> {
        let is = |topic: &&TopicScan| wanted.types.contains(&topic.message_type.as_str());
        let told = |topic: &TopicScan| match topic.flaw() {
            Some(why) => format!("{}: {why}", topic.name),
            None => topic.name.clone(),
        };
        self.topics.iter().filter(is).map(told).collect()
    }

    /// All topics, as far as anybody reads on.
    fn all(&self) -> String {
        let topics = self.topics.iter().take(MOST_TOLD);
        let names: Vec<_> = topics.map(|t| format!("{} ({})", t.name, t.message_type)).collect();
        let more = self.topics.len().saturating_sub(MOST_TOLD);
        match (names.is_empty(), more) {
            (true, _) => "no messages at all".to_owned(),
            (_, 0) => names.join(", "),
            (_, more) => format!("{} and {more} more", names.join(", ")),
        }
    }
}
