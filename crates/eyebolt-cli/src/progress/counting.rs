//! Work of many equal parts.

use super::interrupt::Interrupt;
use crate::logging;
use anyhow::Result;
use eyebolt::progress::{Cancelled, Progress};
use indicatif::{ProgressBar, ProgressStyle};

/// Shows how far the work is, and ends it on Ctrl-C.
pub struct Counting {
    bar: ProgressBar,
    interrupt: Interrupt,
}

impl Counting {
    /// Listens for Ctrl-C.
    pub fn new() -> Result<Self> {
        let bar = if logging::is_quiet() { ProgressBar::new(0) } else { ProgressBar::hidden() };
        let style = ProgressStyle::with_template("{bar:24} {percent}% {elapsed}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Ok(Self { bar, interrupt: Interrupt::new()? })
    }
}

impl Progress for Counting {
    fn begin(&self, _: &'static str) -> Result<(), Cancelled> {
        self.interrupt.check()
    }

    fn advance(&self, done: usize, total: usize) -> Result<(), Cancelled> {
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
        self.interrupt.check()
    }
}

impl Drop for Counting {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
