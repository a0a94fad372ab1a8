//! A straight part of a track.

/// A straight part of a track.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece<'a> {
    pub(super) start_ns: i64,
    pub(super) end_ns: i64,
    /// Longest time without a sample, nanoseconds.
    pub(crate) gap_ns: i64,
    pub(crate) start: &'a [f64],
    pub(crate) end: &'a [f64],
}

impl Piece<'_> {
    /// Positions at a time within the piece.
    pub(crate) fn at(&self, stamp_ns: i64) -> Vec<f64> {
        let since_start = |ns: i64| ns.saturating_sub(self.start_ns) as f64;
        let length = since_start(self.end_ns);
        let share = if length > 0.0 { since_start(stamp_ns) / length } else { 0.0 };
        self.start.iter().zip(self.end).map(|(a, b)| a + share * (b - a)).collect()
    }
}
