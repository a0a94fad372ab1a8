//! Messages on their way from the wire to who writes them down.

use crate::incoming::Incoming;
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A queue that holds so many bytes and no more: what does not fit is counted, and told with the next message
/// of its topic that does.
#[derive(Debug)]
pub(crate) struct Queue {
    most_bytes: usize,
    state: Mutex<State>,
    filled: Condvar,
}

#[derive(Debug, Default)]
struct State {
    messages: VecDeque<Incoming>,
    bytes: usize,
    lost: BTreeMap<String, u64>,
}

/// Bytes of a message beside its data.
const BESIDE: usize = 256;

impl Queue {
    pub(crate) fn new(most_bytes: usize) -> Self {
        Self { most_bytes, state: Mutex::default(), filled: Condvar::new() }
    }

    /// Adds a message, if there is room.
    pub(crate) fn push(&self, mut message: Incoming) {
        let mut state = self.lock();
        let size = message.data.len() + BESIDE;
        let fits = state.messages.is_empty() || state.bytes + size <= self.most_bytes;
        let lost = state.lost.entry(message.topic.clone()).or_default();
        *lost += message.lost_before;
        if !fits {
            *lost += 1;
            return;
        }
        message.lost_before = std::mem::take(lost);
        state.bytes += size;
        state.messages.push_back(message);
        drop(state);
        self.filled.notify_one();
    }

    /// The oldest message, waiting for one at most so long.
    pub(crate) fn pop(&self, wait: Duration) -> Option<Incoming> {
        let state = self.lock();
        let waited = self.filled.wait_timeout_while(state, wait, |state| state.messages.is_empty());
        let mut state = waited.unwrap_or_else(PoisonError::into_inner).0;
        let message = state.messages.pop_front()?;
        state.bytes -= message.data.len() + BESIDE;
        Some(message)
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        // Nothing panics while it is held.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn message(topic: u8, length: usize, lost_before: u64) -> Incoming {
        Incoming {
            topic: format!("/{topic}"),
            message_type: String::new(),
            data: vec![topic; length],
            received_ns: 0,
            lost_before,
        }
    }

    proptest! {
        /// Every message comes out, in order, or is counted as lost; and there are never more bytes than allowed.
        #[test]
        fn nothing_is_lost_unsaid(steps in proptest::collection::vec((0..3_u8, 0..3000_usize, 0..3_u64, any::<bool>()), 1..80)) {
            let queue = Queue::new(8000);
            let (mut sent, mut told) = (BTreeMap::<String, u64>::new(), BTreeMap::<String, u64>::new());
            let mut count = |message: Incoming| *told.entry(message.topic).or_default() += 1 + message.lost_before;
            for (topic, length, lost, take) in steps {
                *sent.entry(format!("/{topic}")).or_default() += 1 + lost;
                queue.push(message(topic, length, lost));
                let state = queue.lock();
                prop_assert!(state.bytes <= 8000 || state.messages.len() == 1);
                drop(state);
                if take {
                    queue.pop(Duration::ZERO).into_iter().for_each(&mut count);
                }
            }
            while let Some(message) = queue.pop(Duration::ZERO) {
                count(message);
            }
            // What is lost at the end is told with what comes then.
            (0..3).for_each(|topic| queue.push(message(topic, 0, 0)));
            (0..3).for_each(|_| count(queue.pop(Duration::ZERO).unwrap()));
            for topic in 0..3 {
                *sent.entry(format!("/{topic}")).or_default() += 1;
            }
            prop_assert_eq!(sent, told);
        }
    }
}
