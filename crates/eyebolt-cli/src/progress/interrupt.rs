//! Ctrl-C.

use anyhow::{Context, Result};
use eyebolt_recording::Cancelled;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// How many [`Interrupt`]s there are to end their work on Ctrl-C, and whether they were asked to.
static LISTENING: AtomicUsize = AtomicUsize::new(0);
static STOPPED: AtomicBool = AtomicBool::new(false);
/// What shells expect of a program that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

/// While it lives, Ctrl-C asks the work to end; a second one, or one after that, ends the program as
/// ever.
pub struct Interrupt(());

impl Interrupt {
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
        Ok(Self(()))
    }

    /// Whether to go on.
    pub fn check(&self) -> Result<(), Cancelled> {
        if STOPPED.load(Ordering::SeqCst) { Err(Cancelled) } else { Ok(()) }
    }
}

impl Drop for Interrupt {
    fn drop(&mut self) {
        LISTENING.fetch_sub(1, Ordering::SeqCst);
    }
}
