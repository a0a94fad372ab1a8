//! Work whose end nobody knows.

use crate::logging;
use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// Shows that work is going on, on standard error if that is a terminal, until it is dropped.
pub struct Waiting(ProgressBar);

impl Waiting {
    /// Says `what` is going on.
    pub fn new(what: &'static str) -> Self {
        let spinner = match logging::is_quiet() {
            true => ProgressBar::new_spinner(),
            false => ProgressBar::hidden(),
        };
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
