//! Numbers by which an executor knows what it has seen before.

use std::sync::atomic::{AtomicU64, Ordering};

/// A number that was not given out before. No result depends on which.
pub(crate) fn fresh() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    NEXT.fetch_add(1, Ordering::Relaxed)
}
