//! What the libraries say of their decisions, on standard error.

use std::io;
use tracing_subscriber::EnvFilter;

/// Listens as `RUST_LOG` says, else to decisions from `verbose` = 1 on.
pub fn start(verbose: u8) {
    let level = match verbose {
        0 => "error",
        1 => "eyebolt=debug",
        _ => "eyebolt=trace",
    };
    let asked = std::env::var(EnvFilter::DEFAULT_ENV).ok().filter(|filter| !filter.is_empty());
    let filter = EnvFilter::builder().parse_lossy(asked.as_deref().unwrap_or(level));
    let listener = tracing_subscriber::fmt().with_env_filter(filter).without_time();
    // Only one is ever started; a second one would change nothing.
    let _ = listener.with_writer(io::stderr).with_ansi(false).try_init();
}

/// Whether a progress bar would come between the lines of a log.
pub fn is_quiet() -> bool {
    tracing_subscriber::filter::LevelFilter::current()
        <= tracing_subscriber::filter::LevelFilter::ERROR
}
