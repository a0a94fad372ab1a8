//! How two clocks differ.

/// How the clocks behind two topics differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClockOffset {
    /// To be added to stamps of depth for the clock of the joints, seconds.
    pub seconds: f64,
    /// By how much `seconds` may be wrong.
    pub uncertainty_s: f64,
    /// Whether it was added: the motion tells it, or the clocks are so far apart that they are two.
    pub applied: bool,
    /// Whether the motion that depth and joints both saw tells it; otherwise, the times at which
    /// both were recorded do.
    pub seen: bool,
}
