//! Many recordings: what is said of each, and of all of them.
//!
//! A folder of a batch has, for each recording of name NAME:
//!
//! ```text
//! batch.json                         the options that all recordings are calibrated with
//! lists/HASH.txt                     the recordings, one a line
//! NAME.json | NAME.rejected.json     a calibration, if there is one
//! NAME.html                          its report, if asked for
//! lines/NAME.json                    a [`Line`], written last: what has a line is done
//! batch.jsonl, index.html            the lines of all recordings, and a page, once all have theirs
//! ```
//!
//! Every file appears whole or not at all and depends on recording and options alone, so that whoever shares the folder
//! writes the same bytes.

mod line;
mod name;
mod summary;

pub use line::{Ending, ExpectedError, Line, PoseInBase, Why};
pub use name::{Listed, listed, name_of};
pub use summary::{Summary, Tally};

/// Name and version of the form of a batch's folder.
pub const SCHEMA: &str = "eyebolt.batch/1";
