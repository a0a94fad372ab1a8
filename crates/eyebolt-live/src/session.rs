//! A calibration session: messages in, events out.

mod event;
mod heard;

use crate::assessment::Assessment;
use crate::goal::Goal;
use crate::incoming::Incoming;
use crate::settle::{Settle, Stillness};
pub use event::{Event, Status};
use eyebolt::record::Places;
use eyebolt_recording::{Glimpse, JointNotes, glimpse};
use eyebolt_robot::{Arm, JointPositions};
use heard::Heard;

/// A calibration session. It knows no clock: time is when messages came.
#[derive(Clone, Debug)]
pub struct Session {
    goal: Goal,
    notes: JointNotes,
    arm: Option<Arm>,
    heard: Heard,
    settle: Settle,
    places: Places,
    /// Where the joints are, of all publishers.
    joints: JointPositions,
    rest: Rest,
    /// A calibration is under way.
    calibrating: bool,
    /// Configurations were taken since the last one began.
    outdated: bool,
    last: Option<Assessment>,
}

/// What became of the arm's present rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Rest {
    /// It does not rest.
    #[default]
    None,
    /// Nothing yet.
    Begun,
    /// Its configuration was taken, or is known.
    Over,
}

/// Images of a resting arm that make a configuration.
const IMAGES: u32 = 8;
/// Configurations without which a calibration makes no sense.
pub const FEWEST: usize = 3;

impl Session {
    /// Nothing heard yet, of no arm yet. `notes` say what messages do not tell of joints.
    pub fn new(goal: Goal, notes: JointNotes) -> Self {
        Self {
            goal,
            joints: notes.positions.iter().cloned().collect(),
            notes,
            arm: None,
            heard: Heard::default(),
            settle: Settle::default(),
            places: Places::default(),
            rest: Rest::None,
            calibrating: false,
            outdated: false,
            last: None,
        }
    }

    /// The arm, which a description or a caller told. Configurations are taken from now on.
    pub fn set_arm(&mut self, arm: Arm) {
        self.arm = Some(arm);
    }

    /// The arm, once it is known.
    pub fn arm(&self) -> Option<&Arm> {
        self.arm.as_ref()
    }

    /// Where the joints were told to be last, by the names that the arm has for them.
    pub fn joints(&self) -> &JointPositions {
        &self.joints
    }

    /// Whether the arm is known.
    pub fn has_arm(&self) -> bool {
        self.arm.is_some()
    }

    /// Takes in a message; what came of it, in order.
    pub fn hear(&mut self, message: &Incoming) -> Vec<Event> {
        let mut events = self.heard.note(message);
        match glimpse(&message.message_type, &message.data) {
            Err(problem) => events.extend(self.heard.unreadable(message, problem)),
            Ok(Glimpse::Joints { positions, .. }) => {
                self.hear_joints(message.received_ns, &positions)
            }
            Ok(Glimpse::Depth { samples, .. }) => {
                self.settle.depth(message.received_ns, samples);
            }
            Ok(Glimpse::Description(text)) => events.extend(self.heard.description(text)),
            Ok(Glimpse::Picture) => events.push(Event::NoDepth { topic: message.topic.clone() }),
            Ok(Glimpse::Transforms(_) | Glimpse::Other) => {}
        }
        self.judge(message.received_ns, &mut events);
        events
    }

    fn hear_joints(&mut self, at_ns: i64, positions: &JointPositions) {
        let named = positions.iter().filter_map(|(name, at)| Some((self.name_of(name)?, at)));
        let told: JointPositions = named.collect();
        self.settle.joints(at_ns, &told);
        let both = self.joints.iter().chain(told.iter());
        // The last one of a name counts.
        self.joints = both.map(|(name, at)| (name.to_owned(), at)).collect();
    }

    /// What the arm calls the joint that messages call `name`; `None` if it is not the arm's: wheels and
    /// grippers of other robots may move as they like.
    fn name_of(&self, name: &str) -> Option<String> {
        let Some(arm) = &self.arm else { return Some(name.to_owned()) };
        let known = |name: &str| arm.robot().joint_index(name).is_some();
        let prefix = self.notes.prefix.as_deref().unwrap_or_default();
        let bare = name.strip_prefix(prefix).unwrap_or(name);
        let names = [name.to_owned(), bare.to_owned(), format!("{prefix}{name}")];
        names.into_iter().find(|name| known(name))
    }

    fn judge(&mut self, at_ns: i64, events: &mut Vec<Event>) {
        match (self.settle.at(at_ns), self.rest) {
            (Stillness::AtRest(_), Rest::None) => {
                self.rest = Rest::Begun;
                events.push(Event::AtRest);
            }
            (Stillness::AtRest(_), Rest::Begun) if self.settle.images() >= IMAGES => {
                self.take(events);
            }
            (Stillness::AtRest(_), _) => {}
            (_, Rest::None) => {}
            (still, _) => {
                self.rest = Rest::None;
                events.push(match still {
                    Stillness::Unknown => Event::Silent,
                    _ => Event::Moves,
                });
            }
        }
    }

    /// Takes the arm's configuration, if it is known where that is.
    fn take(&mut self, events: &mut Vec<Event>) {
        let Some(arm) = &self.arm else { return };
        self.rest = Rest::Over;
        match self.places.add(arm, &self.joints) {
            Ok((place, true)) => {
                events.push(Event::Taken { configuration: place });
                self.outdated = true;
                self.ask(events);
            }
            Ok((place, false)) => events.push(Event::Known { configuration: place }),
            Err(error) => events.push(Event::NotPlaced { problem: error.to_string() }),
        }
    }

    /// Takes the arm's configuration now, whether or not it seems to rest: whoever asks sees it.
    pub fn capture(&mut self) -> Vec<Event> {
        let mut events = Vec::new();
        if self.arm.is_none() || self.joints.is_empty() {
            events.push(Event::NotPlaced { problem: self.missing().join(", ") });
            return events;
        }
        let before = self.rest;
        self.take(&mut events);
        if before == Rest::None {
            self.rest = Rest::None;
        }
        if self.places.len() >= FEWEST {
            // Asked for by a person, it is calibrated anew although the place is known.
            self.outdated = true;
            self.ask(&mut events);
        }
        events
    }

    fn ask(&mut self, events: &mut Vec<Event>) {
        if self.outdated && !self.calibrating && self.places.len() >= FEWEST {
            (self.calibrating, self.outdated) = (true, false);
            events.push(Event::Calibrate);
        }
    }

    /// Takes in what a calibration that was asked for came to; `None` if it came to nothing.
    pub fn calibrated(&mut self, assessment: Option<Assessment>) -> Vec<Event> {
        self.calibrating = false;
        let mut events = Vec::new();
        if let Some(assessment) = assessment {
            let expected = assessment.expected().filter(|_| assessment.trusted);
            let met = expected.is_some_and(|expected| self.goal.is_met(&expected));
            self.last = Some(assessment);
            if met {
                events.push(Event::GoalMet);
                return events;
            }
        }
        self.ask(&mut events);
        events
    }

    /// What is still missing before anything can be calibrated.
    pub fn missing(&self) -> Vec<&'static str> {
        self.heard.missing(self.arm.is_some())
    }

    /// How the session stands.
    pub fn status(&self) -> Status<'_> {
        Status {
            configurations: self.places.len(),
            at_rest: self.rest != Rest::None,
            calibrating: self.calibrating,
            missing: self.missing(),
            lost: self.heard.lost(),
            assessment: self.last.as_ref(),
        }
    }
}
