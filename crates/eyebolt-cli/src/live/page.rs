//! What the page is told, where there is one.

use super::keyboard::Key;
use super::scout::Scout;
use crate::output;
use anyhow::{Context, Result};
use eyebolt_live::{
    Account, Asked, Assessment, Board, Event, Goal, Incoming, Phase, Session, Web, WebAddress,
};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The page, or nothing: what is told to nobody costs nothing.
pub struct Page {
    web: Option<Web>,
}

/// The page as the session goes on.
pub struct Teller<'a> {
    page: &'a Page,
    told: Instant,
}

/// How often the page is told how the session stands: joints move meanwhile.
const OFTEN: Duration = Duration::from_millis(250);

impl Page {
    /// At `address`, of a session that is recorded in `session`; none without an address.
    pub fn open(address: Option<WebAddress>, goal: &Goal, session: &Path) -> Result<Self> {
        let account = || Account::new(goal, session.display().to_string());
        let web = address.map(|address| Web::serve(address, account()));
        Ok(Self { web: web.transpose().context("--web")? })
    }

    /// Where it is.
    pub fn line(&self) -> Option<String> {
        let address = self.web.as_ref()?.address();
        Some(match address.ip().is_unspecified() {
            false => format!("page: http://{address}/"),
            true => format!(
                "page: http://localhost:{0}/, and from elsewhere by this machine's address in numbers, port {0}",
                address.port()
            ),
        })
    }

    /// Works out what follows from each answer, for the page.
    pub fn scout(&self) -> Result<Option<Scout>> {
        self.board().map(|board| Scout::start(Arc::clone(board))).transpose()
    }

    fn board(&self) -> Option<&Arc<Board>> {
        self.web.as_ref().map(Web::board)
    }

    /// All of it is calibrated now.
    pub fn calibrates(&self) {
        self.enter(Phase::Calibrating);
    }

    /// There is no calibration.
    pub fn failed(&self, problem: String) {
        self.enter(Phase::Failed { problem });
    }

    /// A calibration is in one of the files `written_to`, and the report on it at `report`.
    pub fn done(&self, trusted: bool, written_to: &Path, report: Option<&Path>) {
        let Some(board) = self.board() else { return };
        let html = report.and_then(|path| std::fs::read(path).ok());
        let report = html.is_some();
        if let Some(html) = html {
            board.publish_report(html);
        }
        let expected_mm_deg = expected(written_to);
        let written_to = written_to.display().to_string();
        self.enter(Phase::Done { trusted, written_to, expected_mm_deg, report });
    }

    fn enter(&self, phase: Phase) {
        if let Some(board) = self.board() {
            board.update(|account| account.phase = phase);
        }
    }
}

/// The expected error of the calibration at `path`, millimetres and degrees.
fn expected(path: &Path) -> Option<[f64; 2]> {
    let answer: serde_json::Value = serde_json::from_slice(&std::fs::read(path).ok()?).ok()?;
    let error = answer.get("expected_error")?;
    Some([error.get("translation_mm")?.as_f64()?, error.get("rotation_deg")?.as_f64()?])
}

impl<'a> Teller<'a> {
    pub fn new(page: &'a Page) -> Self {
        Self { page, told: Instant::now() }
    }

    /// Says something on standard output, and on the page.
    pub fn say(&self, text: &str) {
        output::say(text);
        self.update(|account| account.say(text));
    }

    /// Says something on standard error, and on the page.
    pub fn complain(&self, text: &str) {
        output::complain(text);
        self.update(|account| account.say(text));
    }

    /// The base link of the arm that is known now.
    pub fn know_base(&self, base: &str) {
        self.update(|account| account.base = Some(base.to_owned()));
    }

    pub fn assess(&self, assessment: &Assessment) {
        self.update(|account| account.assess(assessment));
    }

    /// Hands on what the camera saw, if somebody looks, and `events` do not say that it is something else.
    pub fn show(&self, message: Incoming, events: &[Event], session: &Session) {
        let Some(board) = self.page.board() else { return };
        let is_picture = matches!(
            message.message_type.as_str(),
            "sensor_msgs/msg/Image" | "sensor_msgs/msg/CompressedImage"
        );
        let is_other =
            |event: &Event| matches!(event, Event::NoDepth { .. } | Event::Unreadable { .. });
        if is_picture && !events.iter().any(is_other) && board.wants_sight(message.received_ns) {
            board.show(message, session.joints().clone());
        }
    }

    /// Tells how the session stands, now or when it is time again.
    pub fn tell(&mut self, session: &Session, now: bool) {
        let Some(board) = self.page.board() else { return };
        if now || self.told.elapsed() >= OFTEN {
            self.told = Instant::now();
            board.tell(session);
        }
    }

    /// What somebody asked for.
    pub fn asked(&self) -> Option<Key> {
        self.page.web.as_ref()?.asked().map(|asked| match asked {
            Asked::Capture => Key::Capture,
            Asked::End => Key::End,
        })
    }

    fn update(&self, change: impl FnOnce(&mut Account)) {
        if let Some(board) = self.page.board() {
            board.update(change);
        }
    }
}
