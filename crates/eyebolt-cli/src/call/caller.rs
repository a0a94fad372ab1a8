//! A program in place of a terminal.

use super::keywords::keywords;
use crate::front::Front;
use crate::progress::Waiting;
use anyhow::Result;
use eyebolt::progress::{Cancelled, Progress};
use std::sync::Mutex;

/// Who calls: hears how far the work is, and is handed the notes when it is done.
pub struct Caller<'a> {
    progress: &'a (dyn Progress + Sync),
    notes: Mutex<Vec<String>>,
}

impl<'a> Caller<'a> {
    /// Who hears by `progress` how far the work is.
    pub fn new(progress: &'a (dyn Progress + Sync)) -> Self {
        Self { progress, notes: Mutex::new(Vec::new()) }
    }

    /// What there was to know, each once, in the order that it was said in.
    pub fn into_notes(self) -> Vec<String> {
        // A thread that panicked while it held the lock left the notes whole.
        self.notes.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner)
    }
}

/// Hands on what it hears.
struct Heard<'a>(&'a dyn Progress);

impl Progress for Heard<'_> {
    fn begin(&self, stage: &'static str) -> Result<(), Cancelled> {
        self.0.begin(stage)
    }

    fn advance(&self, done: usize, total: usize) -> Result<(), Cancelled> {
        self.0.advance(done, total)
    }
}

impl Front for Caller<'_> {
    fn stages(&self) -> Result<Box<dyn Progress + '_>> {
        Ok(Box::new(Heard(self.progress)))
    }

    fn parts(&self) -> Result<Box<dyn Progress + '_>> {
        self.stages()
    }

    fn wait(&self, what: &'static str) -> Option<Waiting> {
        // Whether to go on is asked again by the work that follows.
        let _ = self.progress.begin(what);
        None
    }

    fn say(&self, _: &str) {}

    fn note(&self, text: &str) {
        let mut notes = self.notes.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let text = keywords(text);
        if !notes.contains(&text) {
            notes.push(text);
        }
    }
}
