//! Works out what follows from each answer, while the session goes on.

use anyhow::{Context, Result};
use eyebolt_live::{Board, Finding, study};
use std::sync::mpsc::{self, SyncSender};
use std::sync::{Arc, Mutex, PoisonError};

/// A thread that works out what follows from the last answer. Answers that come while it is at another wait, the newest only.
pub struct Scout {
    last: Arc<Mutex<Option<Finding>>>,
    wake: SyncSender<()>,
}

impl Scout {
    /// For `board`; it ends with this, or with the program.
    pub fn start(board: Arc<Board>) -> Result<Self> {
        let last = Arc::<Mutex<Option<Finding>>>::default();
        let (wake, woken) = mpsc::sync_channel(1);
        // One core: the others calibrate, and keep up with what comes in.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let pool = pool.context("cannot start the threads")?;
        let waiting = Arc::clone(&last);
        std::thread::Builder::new()
            .name("eyebolt-scout".to_owned())
            .spawn(move || {
                while woken.recv().is_ok() {
                    let finding = waiting.lock().unwrap_or_else(PoisonError::into_inner).take();
                    if let Some(finding) = finding {
                        pool.install(|| study(&board, &finding));
                    }
                }
            })
            .context("cannot start a thread to plan")?;
        Ok(Self { last, wake })
    }

    /// Hands it an answer.
    pub fn hand(&self, finding: Finding) {
        *self.last.lock().unwrap_or_else(PoisonError::into_inner) = Some(finding);
        // Full means that it is woken already.
        let _ = self.wake.try_send(());
    }
}
