//! The stages of a calibration.

use crate::logging;
use eyebolt::progress::{Cancelled, Progress, Step};
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// A progress bar on standard error (nothing if that is not a terminal, or has a log on it) that
/// keeps time. Ctrl-C ends the program at once: nothing is written before the answer is there.
pub struct Bar {
    bar: ProgressBar,
    clock: RefCell<Clock>,
}

struct Clock {
    step: &'static str,
    since: Instant,
    spent: BTreeMap<String, f64>,
}

impl Bar {
    /// Starts the clock; the time up to the first step is called `open`.
    pub fn new() -> Self {
        let bar = match logging::is_quiet() {
            true => ProgressBar::new(Step::ALL.len() as u64),
            false => ProgressBar::hidden(),
        };
        let style = ProgressStyle::with_template("{bar:24} {msg} {elapsed}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(100));
        let clock = Clock { step: "open", since: Instant::now(), spent: BTreeMap::new() };
        Self { bar, clock: RefCell::new(clock) }
    }

    /// Clears the bar; milliseconds spent on each step and in `total`.
    pub fn finish(&self) -> BTreeMap<String, f64> {
        self.bar.finish_and_clear();
        let mut clock = self.clock.borrow_mut();
        clock.turn("total");
        let mut spent = std::mem::take(&mut clock.spent);
        spent.insert("total".to_owned(), spent.values().sum());
        spent
    }
}

impl Clock {
    fn turn(&mut self, step: &'static str) {
        let now = Instant::now();
        let spent = self.spent.entry(self.step.to_owned()).or_default();
        *spent += 1e3 * (now - self.since).as_secs_f64();
        (self.step, self.since) = (step, now);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Bar {
    fn begin(&self, stage: &'static str) -> Result<(), Cancelled> {
        self.clock.borrow_mut().turn(stage);
        self.bar.inc(1);
        self.bar.set_message(stage);
        Ok(())
    }

    fn advance(&self, _: usize, _: usize) -> Result<(), Cancelled> {
        Ok(())
    }
}
