//! `diagnostic_msgs/DiagnosticArray`.

use super::header::Header;
use super::writer::WireWriter;

/// How something is, as `diagnostic_msgs/DiagnosticStatus` has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum DiagnosticLevel {
    /// As it should be.
    Ok = 0,
    /// Worth a look.
    Warn = 1,
    /// Not as it should be.
    Error = 2,
    /// Nobody knows any more.
    Stale = 3,
}

/// How something is.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic<'a> {
    /// How it is, in a word.
    pub level: DiagnosticLevel,
    /// What it is: `program: what of it`, by which aggregators group.
    pub name: &'a str,
    /// How it is, in a sentence.
    pub message: &'a str,
    /// Which piece of hardware it is about.
    pub hardware_id: &'a str,
    /// What else is known of it, by name.
    pub values: &'a [(&'a str, String)],
}

/// A message of one status in CDR, at a time in nanoseconds since 1970.
pub fn diagnostic_message(stamp_ns: i64, diagnostic: &Diagnostic<'_>) -> Vec<u8> {
    let mut writer = WireWriter::new();
    Header { stamp_ns, frame_id: "" }.write(&mut writer);
    writer.count(1);
    writer.u8(diagnostic.level as u8);
    writer.string(diagnostic.name);
    writer.string(diagnostic.message);
    writer.string(diagnostic.hardware_id);
    writer.count(diagnostic.values.len());
    for (key, value) in diagnostic.values {
        writer.string(key);
        writer.string(value);
    }
    writer.finish()
}
