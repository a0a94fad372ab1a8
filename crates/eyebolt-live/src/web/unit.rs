//! In what a person reads where a joint is.

use eyebolt_robot::JointKind;

/// In what a person reads a joint's position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Degrees,
    Millimetres,
}

impl Unit {
    pub(super) fn of(kind: JointKind) -> Self {
        match kind {
            JointKind::Prismatic => Self::Millimetres,
            _ => Self::Degrees,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Degrees => "deg",
            Self::Millimetres => "mm",
        }
    }

    /// Of radians or metres, to a tenth: what encoders tremble by is not news.
    pub(super) fn shown(self, at: f64) -> f64 {
        let at = match self {
            Self::Degrees => at.to_degrees(),
            Self::Millimetres => 1e3 * at,
        };
        (10.0 * at).round() / 10.0
    }
}
