//! A scan of a file that is still being written.

use super::scan::{Numbers, Scan};
use crate::bag::McapTail;
use crate::error::RecordingError;
use std::path::Path;

/// A scan that goes on where it ended.
#[derive(Debug)]
pub(super) struct GrowingScan {
    tail: McapTail,
    numbers: Numbers,
    /// Never finished: what is handed out is finished copies.
    scan: Scan,
}

impl GrowingScan {
    /// Of the MCAP at `path`, nothing of which was read yet.
    pub(super) fn new(path: &Path) -> Self {
        let (numbers, scan) = (Numbers::default(), Scan::default());
        Self { tail: McapTail::new(path), numbers, scan }
    }

    /// What a scan of the whole file as it is now would find.
    pub(super) fn now(&mut self) -> Result<Scan, RecordingError> {
        let Self { tail, numbers, scan } = self;
        tail.scan(&mut |locator, message| {
            let number = numbers.of(scan, locator, message);
            scan.add(number, locator, message);
        })?;
        let mut found = Scan {
            topics: scan.topics.clone(),
            static_transforms: scan.static_transforms.clone(),
            damage: Vec::new(),
        };
        found.finish();
        Ok(found)
    }
}
