//! The session as it goes on: messages to disk, what happens to whoever looks on.

use super::arguments::Arguments;
use super::calibrator::Calibrator;
use super::domain::now_ns;
use super::keyboard::{Key, Keyboard};
use super::lines;
use super::page::{Page, Teller};
use super::recorder::Recorder;
use crate::ending::causes;
use crate::output;
use crate::progress::Interrupt;
use anyhow::Result;
use eyebolt_live::{Assessment, Bus, Event, Goal, Incoming, Outgoing, Session, pose_markers};
use eyebolt_recording::text_message;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// Why a session ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// The goal was met.
    Met,
    /// Somebody asked for it.
    Asked,
}

/// The session as it goes on.
pub struct Listening<'a> {
    arguments: &'a Arguments,
    bus: &'a Bus,
    recorder: Recorder,
    calibrator: Calibrator,
    session: Session,
    goal: Goal,
    /// The base link, once the arm is known.
    base: Option<String>,
    /// Whether it was said that all is there.
    ready: bool,
    page: Teller<'a>,
    told: Instant,
    restarts: u64,
    /// How many lost messages were told, by topic.
    lost: BTreeMap<String, u64>,
}

/// How long a message is waited for.
const WAIT: Duration = Duration::from_millis(50);
/// How often the status is published, and what is missing is said again.
const STATUS: Duration = Duration::from_secs(1);
const REMINDER: u32 = 10;

impl<'a> Listening<'a> {
    pub fn new(
        arguments: &'a Arguments,
        bus: &'a Bus,
        recorder: Recorder,
        calibrator: Calibrator,
        page: &'a Page,
    ) -> Result<Self> {
        let session = Session::new(arguments.goal, arguments.robot.notes());
        let (goal, told) = (arguments.goal, Instant::now());
        let mut listening = Self {
            arguments,
            bus,
            recorder,
            calibrator,
            session,
            goal,
            base: None,
            ready: false,
            page: Teller::new(page),
            told,
            restarts: 0,
            lost: BTreeMap::new(),
        };
        listening.know_arm(None)?;
        Ok(listening)
    }

    /// Goes on until the goal is met or somebody ends it.
    pub fn run(&mut self, keyboard: &Keyboard, interrupt: &Interrupt) -> Result<Ended> {
        let ended = self.listen(keyboard, interrupt)?;
        // What came before the end is part of it; what comes meanwhile is not.
        let end_ns = now_ns();
        let before = |message: &Incoming| message.received_ns <= end_ns;
        while let Some(message) = self.bus.next(Duration::ZERO).filter(before) {
            let events = self.session.hear(&message);
            self.keep(&message, &events)?;
            events.iter().filter_map(lines::event).for_each(|line| self.page.say(&line));
        }
        self.tell_lost();
        self.page.tell(&self.session, true);
        Ok(ended)
    }

    fn listen(&mut self, keyboard: &Keyboard, interrupt: &Interrupt) -> Result<Ended> {
        let mut seconds = 0;
        loop {
            if interrupt.check().is_err() {
                return Ok(Ended::Asked);
            }
            let mut events = Vec::new();
            if let Some(message) = self.bus.next(WAIT) {
                events = self.session.hear(&message);
                self.keep(&message, &events)?;
                self.page.show(message, &events, &self.session);
            }
            match keyboard.typed().or_else(|| self.page.asked()) {
                Some(Key::End) => return Ok(Ended::Asked),
                Some(Key::Capture) => events.extend(self.session.capture()),
                None => {}
            }
            if let Some(answer) = self.calibrator.answer() {
                events.extend(self.hear_answer(answer));
            }
            for event in &events {
                if *event == Event::GoalMet {
                    return Ok(Ended::Met);
                }
                self.see(event)?;
            }
            self.page.tell(&self.session, !events.is_empty());
            if self.told.elapsed() >= STATUS {
                self.told = Instant::now();
                self.tell_status();
                if seconds % REMINDER == REMINDER - 1 && !self.ready {
                    self.page.say(&lines::waiting(&self.session.missing()));
                }
                seconds += 1;
            }
        }
    }

    /// Ends the recording; how many configurations are in it.
    pub fn finish(self) -> Result<usize> {
        self.recorder.finish()?;
        Ok(self.session.status().configurations)
    }

    /// Records a message, unless its topic turns out not to be needed.
    fn keep(&mut self, message: &Incoming, events: &[Event]) -> Result<()> {
        let of_no_use = events.iter().any(|event| matches!(event, Event::NoDepth { .. }));
        let named = self.arguments.bag.topics().pictures;
        let is_named = || {
            named
                .iter()
                .any(|name| name.trim_start_matches('/') == message.topic.trim_start_matches('/'))
        };
        if of_no_use && !is_named() {
            self.bus.close(&message.topic);
            return Ok(());
        }
        self.recorder.write(message)
    }

    fn hear_answer(&mut self, answer: Result<Assessment>) -> Vec<Event> {
        match answer {
            Ok(assessment) => {
                output::say(&lines::assessment(&assessment, &self.goal, self.base.as_deref()));
                self.page.assess(&assessment);
                if let Some(markers) =
                    self.base.as_deref().and_then(|base| pose_markers(base, &assessment))
                {
                    self.bus.publish(Outgoing::Markers, markers);
                }
                self.session.calibrated(Some(assessment))
            }
            Err(error) => {
                self.page.complain(&format!("cannot be calibrated yet: {}", causes(&error)));
                self.session.calibrated(None)
            }
        }
    }

    fn see(&mut self, event: &Event) -> Result<()> {
        if let Some(line) = lines::event(event) {
            self.page.say(&line);
        }
        match event {
            Event::Description(text) => self.know_arm(Some(text))?,
            Event::Taken { .. } => self.recorder.flush(now_ns())?,
            Event::Calibrate => {
                self.recorder.flush(now_ns())?;
                self.calibrator.ask(self.session.joints().clone());
            }
            _ => {}
        }
        if !self.ready && self.session.missing().is_empty() {
            self.ready = true;
            self.page.say(lines::READY);
        }
        Ok(())
    }

    /// Takes the arm of the flags, or the one that a description tells.
    fn know_arm(&mut self, text: Option<&str>) -> Result<()> {
        if let Some(arm) = self.arguments.robot.arm_of_text(text)? {
            self.page.know_base(arm.base_name());
            self.base = Some(arm.base_name().to_owned());
            self.session.set_arm(arm);
        }
        Ok(())
    }

    /// Says what got lost since it was said last.
    fn tell_lost(&mut self) {
        for (topic, total) in self.session.status().lost {
            let told = self.lost.entry(topic.clone()).or_default();
            if total > told {
                self.page.say(&lines::lost(topic, total - *told, *total));
                *told = *total;
            }
        }
    }

    fn tell_status(&mut self) {
        self.tell_lost();
        if self.bus.restarts() != self.restarts {
            self.restarts = self.bus.restarts();
            self.page.complain(
                "the transport broke, over a malformed packet or a fault of its own, and was started again",
            );
        }
        if let Ok(json) = serde_json::to_string(&self.session.status()) {
            self.bus.publish(Outgoing::Status, text_message(&json));
        }
    }
}
