//! `std_msgs/String`.

use super::wire::{WireProblem, WireReader};
use super::writer::WireWriter;

/// The text of a `std_msgs/String`.
pub(crate) fn text<'a>(reader: &mut WireReader<'a>) -> Result<&'a str, WireProblem> {
    reader.string("data")
}

/// `text` as a `std_msgs/String` in CDR.
pub fn text_message(text: &str) -> Vec<u8> {
    let mut message = WireWriter::new();
    message.string(text);
    message.finish()
}
