//! What an answer has to meet to be trusted.

use super::deviation::Deviation;
use super::reason::Reason;

/// What an answer has to meet to be trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Distinct arm configurations at least.
    pub configurations: usize,
    /// Expected error at most.
    pub expected: Deviation,
}

impl Limits {
    /// The reason to refuse an answer with this expected error, if it is too large.
    pub fn exceeded_by(&self, expected: &Deviation) -> Option<Reason> {
        let limit = self.expected;
        let accurate = expected.translation_m <= limit.translation_m
            && expected.rotation_rad <= limit.rotation_rad;
        (!accurate).then(|| Reason::Inaccurate {
            translation_mm: 1e3 * expected.translation_m,
            rotation_deg: expected.rotation_rad.to_degrees(),
            limit_mm: 1e3 * limit.translation_m,
            limit_deg: limit.rotation_rad.to_degrees(),
        })
    }
}

impl Default for Limits {
    fn default() -> Self {
        let expected = Deviation { translation_m: 0.010, rotation_rad: 0.6f64.to_radians() };
        Self { configurations: 3, expected }
    }
}
