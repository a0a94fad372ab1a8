//! What work tells of itself, and how it is told to end.

use eyebolt_cli::call::Cancelled;
use eyebolt_cli::call::Progress;
use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// So many of `total` parts of `what` are done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Heard {
    pub done: usize,
    pub total: usize,
    pub what: &'static str,
}

/// What came next.
pub enum Next {
    Heard(Heard),
    /// Nothing for a while.
    Nothing,
    /// The work is over.
    Over,
}

#[derive(Debug)]
struct State {
    what: &'static str,
    told: VecDeque<Heard>,
    over: bool,
    stopped: bool,
}

/// Between the thread that works and the one that Python called from.
#[derive(Debug)]
pub struct Listener {
    state: Mutex<State>,
    changed: Condvar,
}

impl Listener {
    pub fn new() -> Self {
        let state = State { what: "", told: VecDeque::new(), over: false, stopped: false };
        Self { state: Mutex::new(state), changed: Condvar::new() }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // A thread that panicked while it held the lock left the state whole.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Asks the work to end at its next part.
    pub fn stop(&self) {
        self.state().stopped = true;
    }

    /// The work is over, whatever came of it.
    pub fn end(&self) {
        self.state().over = true;
        self.changed.notify_all();
    }

    /// Waits for what is told next, no longer than `patience`.
    pub fn next(&self, patience: Duration) -> Next {
        let idle = |state: &mut State| state.told.is_empty() && !state.over;
        let waited = self.changed.wait_timeout_while(self.state(), patience, idle);
        let (mut state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        match state.told.pop_front() {
            Some(heard) => Next::Heard(heard),
            None if state.over => Next::Over,
            None => Next::Nothing,
        }
    }

    fn tell(&self, what: Option<&'static str>, done: usize, total: usize) -> Result<(), Cancelled> {
        let mut state = self.state();
        state.what = what.unwrap_or(state.what);
        let heard = Heard { done, total, what: state.what };
        // Nobody is told of what is past, but for the beginning of each stage.
        match state.told.back_mut() {
            Some(last) if what.is_none() && last.done > 0 => *last = heard,
            _ => state.told.push_back(heard),
        }
        self.changed.notify_all();
        if state.stopped { Err(Cancelled) } else { Ok(()) }
    }
}

impl Progress for Listener {
    fn begin(&self, stage: &'static str) -> Result<(), Cancelled> {
        self.tell(Some(stage), 0, 0)
    }

    fn advance(&self, done: usize, total: usize) -> Result<(), Cancelled> {
        self.tell(None, done, total)
    }
}
