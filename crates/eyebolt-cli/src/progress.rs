//! What a person sees while a command works, and how long each stage took.

use anyhow::{Context, Result};
use eyebolt::progress::{Progress, Step};
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// A progress bar on standard error (nothing if that is not a terminal) that keeps time.
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
        let bar = ProgressBar::new(Step::ALL.len() as u64);
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

impl Progress for Bar {
    fn begin(&self, step: Step) {
        self.clock.borrow_mut().turn(step.name());
        self.bar.inc(1);
        self.bar.set_message(step.name());
    }
}

/// Shows that work is going on whose end nobody knows, on standard error if that is a terminal,
/// until it is dropped.
pub struct Waiting(ProgressBar);

impl Waiting {
    /// Says `what` is going on.
    pub fn new(what: &'static str) -> Self {
        let spinner = ProgressBar::new_spinner();
        let style = ProgressStyle::with_template("{spinner} {msg} {elapsed}");
        spinner.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
        spinner.set_message(what);
        spinner.enable_steady_tick(Duration::from_millis(100));
        Self(spinner)
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// How many [`Counting`] are there to end their work on Ctrl-C, and whether they were asked to.
static LISTENING: AtomicUsize = AtomicUsize::new(0);
static STOPPED: AtomicBool = AtomicBool::new(false);
/// What shells expect of a program that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

/// Shows how far the work is, and ends it on Ctrl-C; a second one, or one after that, ends the
/// program as ever.
pub struct Counting {
    bar: ProgressBar,
}

impl Counting {
    /// Listens for Ctrl-C.
    pub fn new() -> Result<Self> {
        static INSTALLED: AtomicBool = AtomicBool::new(false);
        if !INSTALLED.swap(true, Ordering::SeqCst) {
            #[allow(clippy::disallowed_methods, reason = "what Ctrl-C does without a handler")]
            ctrlc::set_handler(|| {
                let again = STOPPED.swap(true, Ordering::SeqCst);
                if again || LISTENING.load(Ordering::SeqCst) == 0 {
                    std::process::exit(INTERRUPTED);
                }
            })
            .context("cannot listen for Ctrl-C")?;
        }
        LISTENING.fetch_add(1, Ordering::SeqCst);
        let bar = ProgressBar::new(0);
        let style = ProgressStyle::with_template("{bar:24} {percent}% {elapsed}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Ok(Self { bar })
    }

    /// How much of how much is done; whether to go on.
    pub fn tell(&self, done: usize, total: usize) -> ControlFlow<()> {
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
        match STOPPED.load(Ordering::SeqCst) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}

impl Drop for Counting {
    fn drop(&mut self) {
        LISTENING.fetch_sub(1, Ordering::SeqCst);
        self.bar.finish_and_clear();
    }
}
