//! Long work, without the interpreter's lock.

use crate::error::{raised, warn};
use crate::listener::{Listener, Next};
use crate::pools;
use eyebolt_cli::call::{CallError, Caller};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::thread;
use std::time::Duration;

/// How long Ctrl-C waits to be looked for.
const PATIENCE: Duration = Duration::from_millis(50);

/// How work is called.
#[derive(Debug, FromPyObject)]
pub struct Call<'py> {
    /// Called with parts done, parts in all (0 where nobody knows) and what they are parts of.
    progress: Option<Bound<'py, PyAny>>,
    /// How many threads to use; otherwise one for each core.
    threads: Option<usize>,
}

/// Whom work tells how far it is, and what to know of its answer.
pub struct Front<'a> {
    pub caller: &'a Caller<'a>,
    pub progress: &'a Listener,
}

/// What `work` returns. Meanwhile other threads of Python go on, `call.progress` hears of it on this one, and Ctrl-C ends it;
/// its notes become warnings.
pub fn run<T: Send>(
    py: Python<'_>,
    call: &Call<'_>,
    work: impl FnOnce(&Front<'_>) -> Result<T, CallError> + Send,
) -> PyResult<T> {
    let listener = Listener::new();
    let threads = call.threads;
    let told = |listener: &Listener| {
        let caller = Caller::new(listener);
        let done = work(&Front { caller: &caller, progress: listener });
        done.map(|done| (done, caller.into_notes()))
    };
    let (heard, done) = thread::scope(|scope| {
        let worker = scope.spawn(|| {
            let _over = Over(&listener);
            pools::with(threads, || told(&listener))
        });
        let heard = listen(py, call, &listener);
        (heard, worker.join())
    });
    heard?;
    let bug =
        |_| PyRuntimeError::new_err("a bug in eyebolt, told on standard error. Please report it");
    let (done, notes) = done.map_err(bug)?.map_err(|error| raised(py, &error))?;
    warn(py, &notes)?;
    Ok(done)
}

/// Work is over when it returns, and when it panics.
struct Over<'a>(&'a Listener);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.end();
    }
}

/// Hands on what work tells until it is over; what Python raised meanwhile.
fn listen(py: Python<'_>, call: &Call<'_>, listener: &Listener) -> PyResult<()> {
    let mut raised = Ok(());
    loop {
        let next = py.detach(|| listener.next(PATIENCE));
        if raised.is_ok() {
            raised = match &next {
                Next::Heard(heard) => call.progress.as_ref().map_or(Ok(()), |progress| {
                    progress.call1((heard.done, heard.total, heard.what)).map(drop)
                }),
                Next::Nothing | Next::Over => Ok(()),
            };
            raised = raised.and_then(|()| py.check_signals());
            if raised.is_err() {
                listener.stop();
            }
        }
        if matches!(next, Next::Over) {
            return raised;
        }
    }
}
