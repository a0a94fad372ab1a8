//! Where a message of a bag lies.

use super::message::Location;

/// Where a message lies: which file, and where in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(test, derive(Default))]
pub(crate) struct Locator {
    file: u32,
    place: Location,
}

impl Locator {
    /// Of the file with this number.
    pub(super) fn new(file: u32, place: Location) -> Self {
        Self { file, place }
    }

    /// Number of the file among those of the bag.
    pub(crate) fn file(self) -> u32 {
        self.file
    }

    /// Where in its file.
    pub(super) fn place(self) -> Location {
        self.place
    }
}
