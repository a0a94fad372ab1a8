//! Whom a command tells what it does: a terminal, or a program that calls it.

use crate::output;
use crate::progress::{Bar, Counting, Waiting};
use anyhow::Result;
use eyebolt::progress::Progress;

/// Hears what a person sees while a command works.
pub trait Front: Sync {
    /// Hears the stages of a calibration, from now until it is dropped.
    fn stages(&self) -> Result<Box<dyn Progress + '_>>;

    /// Hears how many of many equal parts are done, from now until it is dropped.
    fn parts(&self) -> Result<Box<dyn Progress + '_>>;

    /// Work begins whose end nobody knows; it is over when what is returned is dropped.
    fn wait(&self, what: &'static str) -> Option<Waiting>;

    /// Something that came of the work.
    fn say(&self, text: &str);

    /// Something to know of the answer.
    fn note(&self, text: &str);
}

/// A person, at a terminal.
pub struct Terminal;

impl Front for Terminal {
    fn stages(&self) -> Result<Box<dyn Progress + '_>> {
        Ok(Box::new(Bar::new()))
    }

    fn parts(&self) -> Result<Box<dyn Progress + '_>> {
        Ok(Box::new(Counting::new()?))
    }

    fn wait(&self, what: &'static str) -> Option<Waiting> {
        Some(Waiting::new(what))
    }

    fn say(&self, text: &str) {
        output::say(text);
    }

    fn note(&self, text: &str) {
        output::complain(&format!("note: {text}"));
    }
}
