//! What makes no target.

use super::layout::Layout;
use crate::dictionary::Dictionary;

/// Boards are not larger than this, tags in a row.
const MOST: u32 = 1000;

/// How a target is written.
const GRAMMAR: &str = "write aruco:DICTIONARY:SIZE_M[:ID], apriltag:DICTIONARY:SIZE_M[:ID], \
                       grid:DICTIONARY:COLUMNSxROWS:SIZE_M:GAP_M[:FIRST_ID] or \
                       charuco:DICTIONARY:COLUMNSxROWS:SQUARE_M:MARKER_M[:FIRST_ID], as in aruco:4x4_50:0.05";

/// Why text or numbers are no target.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TargetError {
    /// It begins with no kind of target, or has too few or too many parts.
    #[error("{text:?} is no marker: {GRAMMAR}")]
    Form {
        /// What was written.
        text: String,
    },
    /// No such dictionary.
    #[error("marker: {name:?} is no dictionary; there are {}", Dictionary::names().collect::<Vec<_>>().join(", "))]
    Dictionary {
        /// What was written.
        name: String,
    },
    /// A number that is none, or has no sense.
    #[error("marker: {part} is {text:?}; {remedy}")]
    Number {
        /// Which number.
        part: &'static str,
        /// What was written.
        text: String,
        /// What it has to be.
        remedy: &'static str,
    },
    /// Tags that are not in the dictionary.
    #[error(
        "marker: tags {first} to {last} are needed, and {dictionary} has 0 to {largest}: take a larger \
         dictionary or a smaller board"
    )]
    Ids {
        /// First number.
        first: u32,
        /// Last number.
        last: u32,
        /// Name of the dictionary.
        dictionary: &'static str,
        /// The last that is in it.
        largest: usize,
    },
}

/// A length in metres.
pub(super) const LENGTH: &str = "lengths are in metres, above 0 and below 100";

/// Refuses what is no target.
pub(super) fn check(
    dictionary: &Dictionary,
    marker_m: f64,
    layout: &Layout,
) -> Result<(), TargetError> {
    let number = |part, value: &dyn ToString, remedy| {
        Err(TargetError::Number { part, text: value.to_string(), remedy })
    };
    let long = |metres: f64| metres > 0.0 && metres < 100.0;
    if !long(marker_m) {
        return number("the tag's size", &marker_m, LENGTH);
    }
    let (columns, rows, first) = match *layout {
        Layout::Tag { id } => (1, 1, id.unwrap_or(0)),
        Layout::Grid { columns, rows, gap_m, first_id } => {
            if !long(gap_m) {
                return number("the gap", &gap_m, LENGTH);
            }
            (columns, rows, first_id)
        }
        Layout::Charuco { columns, rows, square_m, first_id } => {
            if !(long(square_m) && square_m > marker_m) {
                return number("the square", &square_m, "squares are larger than the tags in them");
            }
            if columns < 3 || rows < 3 {
                let remedy = "a ChArUco board has three columns and three rows at least";
                return number("the board", &format!("{columns}x{rows}"), remedy);
            }
            (columns, rows, first_id)
        }
    };
    if !((1..=MOST).contains(&columns) && (1..=MOST).contains(&rows)) {
        let remedy = "boards have 1 to 1000 columns and rows";
        return number("the board", &format!("{columns}x{rows}"), remedy);
    }
    let count =
        if matches!(layout, Layout::Charuco { .. }) { columns * rows / 2 } else { columns * rows };
    let last = u64::from(first) + u64::from(count) - 1;
    if last >= dictionary.len() as u64 {
        return Err(TargetError::Ids {
            first,
            last: u32::try_from(last).unwrap_or(u32::MAX),
            dictionary: dictionary.name(),
            largest: dictionary.len().saturating_sub(1),
        });
    }
    Ok(())
}
