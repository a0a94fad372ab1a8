//! What the page tells of a session.

use super::coverage::Coverage;
use super::next::Next;
use super::unit::Unit;
use crate::assessment::Assessment;
use crate::goal::Goal;
use crate::session::Session;
use serde::Serialize;
use std::collections::VecDeque;

/// What the page tells of a session. All of it is bounded.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Account {
    /// How far it is.
    pub phase: Phase,
    /// The file that has what came in.
    pub recorded_in: String,
    /// The expected error with which it ends, millimetres and degrees.
    pub goal_mm_deg: [f64; 2],
    /// The base link, once the arm is known.
    pub base: Option<String>,
    /// How the session stands.
    standing: Standing,
    /// What was said last, the newest at the end.
    said: VecDeque<String>,
    /// What the calibrations came to, one after the other.
    quality: VecDeque<Quality>,
    /// What the configurations of the last one have of the arm.
    pub(super) coverage: Option<Coverage>,
    /// What to record next.
    pub(super) next: Option<Next>,
}

/// How far a session is.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum Phase {
    /// Configurations are taken.
    #[default]
    Listening,
    /// It has ended, and all of it is calibrated.
    Calibrating,
    /// The calibration is written.
    Done {
        /// Whether it is trusted.
        trusted: bool,
        /// Where it is.
        written_to: String,
        /// Error to expect, millimetres and degrees.
        expected_mm_deg: Option<[f64; 2]>,
        /// Whether there is a report on it.
        report: bool,
    },
    /// There is none.
    Failed {
        /// Why.
        problem: String,
    },
}

/// What one calibration came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Quality {
    /// How many configurations it is of.
    pub configurations: usize,
    /// Whether it would be trusted.
    pub trusted: bool,
    /// Error to expect, millimetres and degrees; `None` if there is no answer.
    pub expected_mm_deg: Option<[f64; 2]>,
}

/// How a session stands.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Standing {
    configurations: usize,
    at_rest: bool,
    calibrating: bool,
    missing: Vec<&'static str>,
    /// Topics of which messages got lost, with how many.
    lost: Vec<(String, u64)>,
    joints: Vec<JointNow>,
    assessment: Option<Assessment>,
}

/// A joint of the arm's chain.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct JointNow {
    joint: String,
    /// `deg` or `mm`.
    unit: &'static str,
    now: Option<f64>,
    /// Its limits, if it has any.
    between: Option<[f64; 2]>,
}

const MOST_SAID: usize = 30;
const MOST_CHARACTERS: usize = 400;
const MOST_QUALITIES: usize = 200;
const MOST_TOPICS: usize = 10;

impl Account {
    /// Of a session that has just begun, with what it is recorded in.
    pub fn new(goal: &Goal, recorded_in: String) -> Self {
        let eyebolt::calibrate::Deviation { translation_m, rotation_rad } = goal.0;
        let goal_mm_deg = [1e3 * translation_m, rotation_rad.to_degrees()];
        Self { recorded_in, goal_mm_deg, ..Self::default() }
    }

    /// Adds what was said: one line, or several.
    pub fn say(&mut self, text: &str) {
        for line in text.lines() {
            push(&mut self.said, line.chars().take(MOST_CHARACTERS).collect(), MOST_SAID);
        }
    }

    /// Adds what a calibration came to.
    pub fn assess(&mut self, assessment: &Assessment) {
        let Assessment { configurations, trusted, expected_mm_deg, .. } = *assessment;
        push(
            &mut self.quality,
            Quality { configurations, trusted, expected_mm_deg },
            MOST_QUALITIES,
        );
    }

    /// Takes in how `session` stands; whether that changed.
    pub(super) fn hear(&mut self, session: &Session) -> bool {
        let standing = Standing::of(session);
        let changed = standing != self.standing;
        self.standing = standing;
        changed
    }
}

fn push<T>(list: &mut VecDeque<T>, item: T, most: usize) {
    if list.len() >= most {
        list.pop_front();
    }
    list.push_back(item);
}

impl Standing {
    fn of(session: &Session) -> Self {
        let status = session.status();
        let lost = status.lost.iter().take(MOST_TOPICS);
        let short = |topic: &str| topic.chars().take(MOST_CHARACTERS).collect();
        Self {
            configurations: status.configurations,
            at_rest: status.at_rest,
            calibrating: status.calibrating,
            missing: status.missing,
            lost: lost.map(|(topic, count)| (short(topic), *count)).collect(),
            joints: joints(session),
            assessment: status.assessment.cloned(),
        }
    }
}

fn joints(session: &Session) -> Vec<JointNow> {
    let Some(arm) = session.arm() else { return Vec::new() };
    let robot = arm.robot();
    let now = |name: &str| {
        let joint = robot.joints.get(robot.joint_index(name)?)?;
        let unit = Unit::of(joint.kind);
        Some(JointNow {
            joint: name.to_owned(),
            unit: unit.name(),
            now: session.joints().get(name).map(|at| unit.shown(at)),
            between: joint
                .limits
                .map(|limits| [limits.lower, limits.upper].map(|at| unit.shown(at))),
        })
    };
    arm.required_joints().into_iter().filter_map(now).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_does_not_grow() {
        let mut account = Account::new(&Goal::default(), "session.mcap".to_owned());
        for turn in 0..10_000_u32 {
            account.say(&format!("{turn} {}\nmore", "long ".repeat(500)));
        }
        let json = serde_json::to_string(&account).unwrap();
        assert!(json.len() < 20_000, "{}", json.len());
        assert!(json.contains("9999 long") && !json.contains("9000 long"));
    }
}
