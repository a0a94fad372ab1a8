//! All sessions of a study, side by side.

use super::kind::Kind;
use super::session::Session;
use super::summary::Summary;
use super::trial::{SessionResult, try_session};
use crate::progress::{Cancelled, Progress};
use eyebolt_registration::LinkCache;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc;

/// Which sessions to run.
#[derive(Clone, Debug)]
pub struct Study {
    /// Number of the first: what a session is follows from its number.
    pub first: u64,
    /// How many.
    pub sessions: u64,
    /// Of all random choices.
    pub seed: u64,
    /// Of this kind only, if one is given.
    pub only: Option<Kind>,
    /// How many sessions are run at a time, each on one thread.
    pub threads: usize,
}

/// Why a study comes to no end.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// Whoever hears of the progress ended it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The system has no more threads.
    #[error("cannot start a thread: {0}; ask for fewer")]
    Threads(String),
}

/// Runs `study`, hands each session to `tell`, in order of their numbers, and sums up.
///
/// Sessions are run side by side, and each on one thread: so none waits for another, and times are
/// those of one core. But for the times all is the same on any number of threads. `clock` tells
/// seconds, since any moment; `cache` keeps shapes of links.
///
/// # Errors
///
/// A `progress` that wants an end, or no threads.
pub fn run(
    study: &Study,
    cache: &LinkCache,
    clock: &(dyn Fn() -> f64 + Sync),
    progress: &dyn Progress,
    mut tell: impl FnMut(&SessionResult),
) -> Result<Summary, StudyError> {
    let next = AtomicU64::new(0);
    let mut summary = Summary::default();
    let total = study.sessions as usize;
    std::thread::scope(|scope| {
        let (sender, results) = mpsc::channel();
        for _ in 0..study.threads.max(1) {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
            let pool = pool.map_err(|error| StudyError::Threads(error.to_string()))?;
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                // Nobody listens any more once the study is ended.
                while let Some(place) = take(next, study.sessions)
                    && sender.send(pool.install(|| session(study, place, cache, clock))).is_ok()
                {
                }
            });
        }
        drop(sender);
        let mut early = BTreeMap::new();
        for (done, result) in results.iter().enumerate() {
            early.insert(result.session.number - study.first, result);
            while let Some(result) = early.remove(&summary.told()) {
                tell(&result);
                summary.add(&result);
            }
            if let Err(cancelled) = progress.advance(done + 1, total) {
                next.store(study.sessions, Ordering::Relaxed);
                return Err(cancelled.into());
            }
        }
        Ok(summary)
    })
}

/// The place of a session that nobody has taken.
fn take(next: &AtomicU64, sessions: u64) -> Option<u64> {
    let place = next.fetch_add(1, Ordering::Relaxed);
    (place < sessions).then_some(place)
}

fn session(study: &Study, place: u64, cache: &LinkCache, clock: &dyn Fn() -> f64) -> SessionResult {
    let number = study.first.saturating_add(place);
    try_session(Session::draw(study.seed, number, study.only), cache, clock)
}
