//! How good an answer has to be.

use crate::inputs::positive;
use eyebolt::calibrate::{Deviation, Limits};

/// Up to which error an answer is trusted.
#[derive(Clone, Debug, clap::Args)]
pub struct LimitArguments {
    /// Expected error up to which an answer is trusted, millimetres [default: 10]
    #[arg(long, value_name = "MM", value_parser = positive)]
    max_error_mm: Option<f64>,
    /// Expected error up to which an answer is trusted, degrees [default: 0.6]
    #[arg(long, value_name = "DEG", value_parser = positive)]
    max_error_deg: Option<f64>,
}

impl LimitArguments {
    pub fn limits(&self) -> Limits {
        let default = Limits::default();
        let expected = Deviation {
            translation_m: self.max_error_mm.map_or(default.expected.translation_m, |mm| 1e-3 * mm),
            rotation_rad: self.max_error_deg.map_or(default.expected.rotation_rad, f64::to_radians),
        };
        Limits { expected, ..default }
    }
}
