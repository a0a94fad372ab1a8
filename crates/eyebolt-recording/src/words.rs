//! Numbers of things, for people.

/// `1 frame`, `2 frames`: for nouns whose plural ends in `s`.
///
/// ```
/// assert_eq!(eyebolt_recording::counted(1_u64, "frame"), "1 frame");
/// assert_eq!(eyebolt_recording::counted(0_usize, "frame"), "0 frames");
/// ```
pub fn counted(count: impl TryInto<u64>, noun: &str) -> String {
    let count = count.try_into().unwrap_or(u64::MAX);
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}
