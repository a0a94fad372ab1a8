//! Ctrl-C.

use crate::output;
use anyhow::{Context, Result};
use eyebolt_recording::Cancelled;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// How many [`Interrupt`]s there are to end their work on Ctrl-C, and whether they were asked to.
static LISTENING: AtomicUsize = AtomicUsize::new(0);
static STOPPED: AtomicBool = AtomicBool::new(false);
/// What shells expect of a program that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

/// While it lives, Ctrl-C asks the work to end; a second one, or one after that, ends the program as
/// ever.
pub struct Interrupt(());

/// What a run that Ctrl-C ends leaves behind, for a person.
static LEFT: Mutex<Option<String>> = Mutex::new(None);

/// Says `left` of what was done so far, should Ctrl-C end the program at once.
pub fn leaves(left: String) -> Result<()> {
    // A thread that panicked while it held the lock left the text whole.
    *LEFT.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Some(left);
    install()
}

fn install() -> Result<()> {
    static INSTALLED: AtomicBool = AtomicBool::new(false);
    if !INSTALLED.swap(true, Ordering::SeqCst) {
        #[allow(clippy::disallowed_methods, reason = "what Ctrl-C does without a handler")]
        ctrlc::set_handler(|| {
            let again = STOPPED.swap(true, Ordering::SeqCst);
            if again || LISTENING.load(Ordering::SeqCst) == 0 {
                let left = LEFT.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
                if let Some(left) = left {
                    output::complain(&format!("\nstopped: {left}"));
                }
                std::process::exit(INTERRUPTED);
            }
        })
        .context("cannot listen for Ctrl-C")?;
    }
    Ok(())
}

impl Interrupt {
    /// Listens for Ctrl-C.
    pub fn new() -> Result<Self> {
        install()?;
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
