//! What is new, of everything the latest only.

use super::account::Account;
use super::drawing::Drawing;
use super::picture::picture;
use crate::incoming::Incoming;
use crate::session::Session;
use eyebolt_recording::message_depth;
use eyebolt_robot::JointPositions;
use hyper::body::Bytes;
use serde::Serialize;
use std::sync::atomic::{AtomicI64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::{Notify, watch};

/// What is new, of everything the latest only: a session puts it there, pages ask for it. Neither waits for the other.
pub struct Board {
    /// Another for each session, so that a page knows a new one.
    session: String,
    account: Mutex<Account>,
    /// Of the account: it grows with each change.
    number: watch::Sender<u64>,
    drawing: Mutex<Option<Arc<Drawing>>>,
    sight: Mutex<Option<Sight>>,
    seen: Notify,
    seen_ns: AtomicI64,
    picture: watch::Sender<Shown>,
    /// How many wait for the next picture.
    waiting: AtomicUsize,
    report: Mutex<Option<Bytes>>,
}

/// What the camera saw, as it came.
struct Sight {
    message: Incoming,
    joints: JointPositions,
}

/// A picture with its number, which grows.
#[derive(Clone, Debug, Default)]
pub(super) struct Shown {
    pub(super) number: u64,
    /// PNG; empty before the first.
    pub(super) png: Bytes,
}

/// Pictures are that far apart at least, nanoseconds: five a second are enough to see an arm move.
const APART_NS: i64 = 180_000_000;

impl Board {
    /// Of a session that `session` names like no other.
    pub(super) fn new(session: String, account: Account) -> Self {
        Self {
            session,
            account: Mutex::new(account),
            number: watch::Sender::new(1),
            drawing: Mutex::default(),
            sight: Mutex::default(),
            seen: Notify::new(),
            seen_ns: AtomicI64::new(i64::MIN),
            picture: watch::Sender::default(),
            waiting: AtomicUsize::new(0),
            report: Mutex::default(),
        }
    }

    /// Changes what is told.
    pub fn update(&self, change: impl FnOnce(&mut Account)) {
        change(&mut lock(&self.account));
        self.number.send_modify(|number| *number += 1);
    }

    /// Tells how `session` stands, if that is news.
    pub fn tell(&self, session: &Session) {
        if lock(&self.account).hear(session) {
            self.number.send_modify(|number| *number += 1);
        }
    }

    /// Whether somebody would see what the camera sees at a time of [`Incoming::received_ns`].
    pub fn wants_sight(&self, at_ns: i64) -> bool {
        let apart_ns = at_ns.saturating_sub(self.seen_ns.load(Ordering::Relaxed));
        // Clocks may be set back.
        self.waiting.load(Ordering::Relaxed) > 0 && !(0..APART_NS).contains(&apart_ns)
    }

    /// Takes what the camera saw with the arm's joints at `joints`; messages that are not of depth change nothing.
    pub fn show(&self, message: Incoming, joints: JointPositions) {
        self.seen_ns.store(message.received_ns, Ordering::Relaxed);
        *lock(&self.sight) = Some(Sight { message, joints });
        self.seen.notify_one();
    }

    /// Has the arm drawn on what the camera sees.
    pub(super) fn draw(&self, drawing: Option<Drawing>) {
        *lock(&self.drawing) = drawing.map(Arc::new);
    }

    /// The report on the calibration, HTML.
    pub fn publish_report(&self, html: Vec<u8>) {
        *lock(&self.report) = Some(html.into());
    }

    pub(super) fn report(&self) -> Option<Bytes> {
        lock(&self.report).clone()
    }

    /// Makes pictures of what the camera saw, one after the other, for good.
    pub(super) async fn make_pictures(&self) {
        loop {
            self.seen.notified().await;
            let Some(Sight { message, joints }) = lock(&self.sight).take() else { continue };
            match message_depth(&message.message_type, &message.data) {
                Ok(Some(depth)) => {
                    let drawing = lock(&self.drawing).clone();
                    let png = picture(&depth, drawing.as_deref(), &joints).into();
                    self.picture
                        .send_modify(|shown| *shown = Shown { number: shown.number + 1, png });
                }
                Ok(None) => {}
                Err(problem) => tracing::debug!(topic = message.topic, problem, "no picture"),
            }
        }
    }

    /// What is told now, as soon as it is other than what `tag` is the name of: JSON.
    pub(super) async fn account_after(&self, tag: Option<&str>) -> Vec<u8> {
        let mut numbers = self.number.subscribe();
        // Its sender is here.
        let _ = numbers.wait_for(|number| tag != Some(self.tag(*number).as_str())).await;
        self.account_json()
    }

    fn account_json(&self) -> Vec<u8> {
        #[derive(Serialize)]
        struct Told<'a> {
            tag: String,
            session: &'a str,
            version: &'static str,
            #[serde(flatten)]
            account: &'a Account,
        }
        // The number first: what changes meanwhile is told once more, and not left out.
        let tag = self.tag(*self.number.borrow());
        let account = lock(&self.account);
        let (session, version) = (self.session.as_str(), env!("CARGO_PKG_VERSION"));
        let told = Told { tag, session, version, account: &account };
        serde_json::to_vec(&told).expect("plain data with string keys")
    }

    /// The last picture, as soon as it is another than the one that `tag` is the name of.
    pub(super) async fn picture_after(&self, tag: Option<&str>) -> (String, Bytes) {
        let _one = Waiting::new(&self.waiting);
        let mut pictures = self.picture.subscribe();
        let is_new =
            |shown: &Shown| shown.number > 0 && tag != Some(self.tag(shown.number).as_str());
        let _ = pictures.wait_for(is_new).await;
        let Shown { number, png } = pictures.borrow().clone();
        (self.tag(number), png)
    }

    /// Lets go whoever waits.
    pub(super) fn close(&self) {
        self.number.send_modify(|number| *number += 1);
        self.picture.send_modify(|shown| shown.number += 1);
    }

    /// What the state of this number is called, in this session alone.
    fn tag(&self, number: u64) -> String {
        format!("{}-{number}", self.session)
    }
}

/// Counts who waits for as long as they do.
struct Waiting<'a>(&'a AtomicUsize);

impl<'a> Waiting<'a> {
    fn new(count: &'a AtomicUsize) -> Self {
        count.fetch_add(1, Ordering::Relaxed);
        Self(count)
    }
}

impl Drop for Waiting<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

fn lock<T>(held: &Mutex<T>) -> MutexGuard<'_, T> {
    // Nothing panics while it is held.
    held.lock().unwrap_or_else(PoisonError::into_inner)
}
