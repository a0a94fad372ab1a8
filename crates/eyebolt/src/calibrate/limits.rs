//! What an answer has to meet to be trusted.

use super::deviation::Deviation;

/// What an answer has to meet to be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Distinct arm configurations at least.
    pub configurations: usize,
    /// Expected error at most.
    pub expected: Deviation,
}

impl Default for Limits {
    fn default() -> Self {
        let expected = Deviation { translation_m: 0.010, rotation_rad: 0.6f64.to_radians() };
        Self { configurations: 3, expected }
    }
}
