//! Threads to work on.

use eyebolt_cli::call::CallError;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::{Mutex, PoisonError};

/// Threads of this process that wait for work.
static IDLE: Mutex<Vec<Idle>> = Mutex::new(Vec::new());
/// How many of them are kept.
const MOST_IDLE: usize = 4;
/// As much as the main thread of a program has.
const STACK_BYTES: usize = 8 << 20;

struct Idle {
    /// After a fork the child has the list, but not the threads.
    process: u32,
    threads: usize,
    pool: ThreadPool,
}

/// What `work` returns, on `threads` threads of its own (one for each core, if not told): calls that wait within one
/// pool could be made to run each other's work, and wait for what they hold themselves.
pub fn with<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, CallError> + Send,
) -> Result<T, CallError> {
    let process = std::process::id();
    let threads = threads.unwrap_or(0);
    let known = {
        let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
        let fits = |it: &Idle| (it.process, it.threads) == (process, threads);
        idle.iter().position(fits).map(|at| idle.swap_remove(at).pool)
    };
    let pool = match known {
        Some(pool) => pool,
        None => started(threads)?,
    };
    let done = pool.install(work);
    let mut idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner);
    // Threads that are not there cannot be told to end.
    idle.extract_if(.., |it| it.process != process).for_each(std::mem::forget);
    if idle.len() < MOST_IDLE {
        idle.push(Idle { process, threads, pool });
    }
    done
}

fn started(threads: usize) -> Result<ThreadPool, CallError> {
    let builder = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK_BYTES);
    let built = builder.thread_name(|number| format!("eyebolt-{number}")).build();
    built.map_err(|error| {
        CallError::of_text(&format!("`threads`: cannot start the threads: {error}. Ask for fewer"))
    })
}
