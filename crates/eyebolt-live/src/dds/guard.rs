//! Threads of RustDDS that ended by a panic.

use std::panic;
use std::sync::Once;
use std::sync::atomic::{AtomicU64, Ordering};

/// How many there were in this process.
static BROKEN: AtomicU64 = AtomicU64::new(0);

/// What RustDDS calls its threads.
const NAME: &str = "RustDDS";

/// Counts threads of RustDDS that panic from now on, and keeps their last words from standard error: a packet that is
/// malformed in a way that nobody thought of is no reason for a person to read them.
pub(super) fn install() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let thread = std::thread::current();
            if thread.name().is_some_and(|name| name.starts_with(NAME)) {
                BROKEN.fetch_add(1, Ordering::SeqCst);
                tracing::debug!(%info, "a thread of the transport broke");
            } else {
                before(info);
            }
        }));
    });
}

/// How many threads broke so far.
pub(super) fn broken() -> u64 {
    BROKEN.load(Ordering::SeqCst)
}
