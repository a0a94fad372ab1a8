//! `std_msgs/String`.

use super::wire::{WireProblem, WireReader};

/// The text of a `std_msgs/String`.
pub(crate) fn text<'a>(reader: &mut WireReader<'a>) -> Result<&'a str, WireProblem> {
    reader.string("data")
}
