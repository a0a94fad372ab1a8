//! What happens in a session.

use crate::assessment::Assessment;
use serde::Serialize;
use std::collections::BTreeMap;

/// What happens in a session.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// The first message of a topic came.
    Heard {
        /// The topic.
        topic: String,
        /// The type of its messages.
        message_type: String,
    },
    /// A robot description came, and is another than the one before, if there was one.
    Description(String),
    /// A topic has pictures that are not of depth: it is not needed.
    NoDepth {
        /// The topic.
        topic: String,
    },
    /// Messages of a topic got lost.
    Lost {
        /// The topic.
        topic: String,
        /// How many before the last message.
        count: u64,
        /// How many in all.
        total: u64,
    },
    /// The first message of a topic that is not of its type.
    Unreadable {
        /// The topic.
        topic: String,
        /// What is wrong with it.
        problem: String,
    },
    /// The arm rests.
    AtRest,
    /// It moves.
    Moves,
    /// Nobody tells any more where its joints are.
    Silent,
    /// A new configuration was taken: the arm may go on.
    Taken {
        /// Its number, from 0.
        configuration: usize,
    },
    /// The arm rests where it was before.
    Known {
        /// The number of that configuration, from 0.
        configuration: usize,
    },
    /// Nobody can say where the arm is.
    NotPlaced {
        /// Why.
        problem: String,
    },
    /// What was written should be calibrated, and the session told what it came to.
    Calibrate,
    /// The answer is good enough.
    GoalMet,
}

/// How a session stands.
#[derive(Clone, Debug, Serialize)]
pub struct Status<'a> {
    /// How many configurations were taken.
    pub configurations: usize,
    /// Whether the arm rests.
    pub at_rest: bool,
    /// Whether a calibration is under way.
    pub calibrating: bool,
    /// What was not heard yet.
    pub missing: Vec<&'static str>,
    /// How many messages got lost, by topic.
    pub lost: &'a BTreeMap<String, u64>,
    /// What the last calibration came to.
    pub assessment: Option<&'a Assessment>,
}
