//! Batches made by other threads while a network learns.

use super::error::TrainError;
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread::Scope;

/// Batches made ahead by each thread.
const AHEAD: usize = 2;

/// Batches in their order, each made by one of a few threads from its number alone: the same ones
/// whatever their number is.
pub struct Feed<T> {
    workers: Vec<Receiver<Result<T, TrainError>>>,
    next: u64,
    /// Batches taken, and those that were not there yet when they were asked for.
    pub taken: u64,
    /// Of these, those that the network had to wait for.
    pub waited_for: u64,
}

impl<T: Send> Feed<T> {
    /// Batches `first` to before `end` by `make` on `threads` threads, which end with the scope or as
    /// soon as nobody listens.
    ///
    /// What `make` does in parallel stays on its thread: the network has the others.
    pub fn start<'scope, 'env, M>(
        scope: &'scope Scope<'scope, 'env>,
        threads: usize,
        (first, end): (u64, u64),
        make: M,
    ) -> Self
    where
        T: 'scope,
        M: Fn(u64) -> Result<T, TrainError> + Send + Sync + Copy + 'scope,
    {
        let threads = threads.max(1);
        let workers = (0..threads as u64).map(|worker| {
            let (sender, receiver) = sync_channel(AHEAD);
            scope.spawn(move || {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
                for index in (first..end).skip(worker as usize).step_by(threads) {
                    let made = match &pool {
                        Ok(pool) => pool.install(|| make(index)),
                        Err(_) => make(index),
                    };
                    let failed = made.is_err();
                    if sender.send(made).is_err() || failed {
                        return;
                    }
                }
            });
            receiver
        });
        Self { workers: workers.collect(), next: 0, taken: 0, waited_for: 0 }
    }

    fn next_batch(&mut self) -> Option<Result<T, TrainError>> {
        let worker = &self.workers[(self.next % self.workers.len() as u64) as usize];
        self.next += 1;
        let there = worker.try_recv().ok();
        let waited = there.is_none();
        let batch = there.or_else(|| worker.recv().ok())?;
        self.taken += 1;
        self.waited_for += u64::from(waited);
        Some(batch)
    }
}

impl<T: Send> Iterator for Feed<T> {
    type Item = Result<T, TrainError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.next_batch()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_come_in_order_from_any_number_of_threads() {
        for threads in [1, 2, 3] {
            let got: Vec<u64> = std::thread::scope(|scope| {
                Feed::start(scope, threads, (5, 22), |index| Ok(index * index))
                    .map(Result::unwrap)
                    .collect()
            });
            assert_eq!(got, (5..22).map(|index| index * index).collect::<Vec<u64>>());
        }
    }

    #[test]
    fn an_error_ends_the_stream_and_nobody_hangs() {
        std::thread::scope(|scope| {
            let make = |index| match index {
                3 => Err(TrainError::NothingToSee { tries: 1 }),
                _ => Ok(index),
            };
            let first: Vec<_> = Feed::start(scope, 2, (0, 1_000_000), make).take(4).collect();
            assert!(first[3].is_err() && first[..3].iter().all(Result::is_ok));
        });
    }
}
