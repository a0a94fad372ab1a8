//! How errors of triangulation grow with distance and angle.

use std::f64::consts::FRAC_PI_2;

/// Standard deviation of depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AxialNoise {
    /// That of disparity is the same everywhere.
    Disparity {
        /// Pixels.
        rms_px: f64,
    },
    /// `floor_m + growth_per_m (z - from_m)^2 + grazing z^-1/2 a^2 / (pi/2 - a)^2` at depth z and
    /// angle a between normal and ray; the rounding of disparity is part of it.
    Depth {
        /// Metres.
        floor_m: f64,
        /// 1/m.
        growth_per_m: f64,
        /// Metres.
        from_m: f64,
        /// m^3/2.
        grazing: f64,
    },
}

/// Standard deviation of where edges are: `base_px + grazing_px a / (pi/2 - a)` at an angle a
/// between normal and ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LateralNoise {
    /// Pixels.
    pub base_px: f64,
    /// Pixels.
    pub grazing_px: f64,
    /// Lag along an edge at which its displacement is half correlated, pixels.
    pub half_correlation_px: f64,
}

impl AxialNoise {
    /// Standard deviation of disparity before it is rounded to `step_px`, pixels.
    pub(super) fn disparity_px(
        &self,
        depth_m: f64,
        angle_rad: f64,
        product: f64,
        step_px: f64,
    ) -> f64 {
        match *self {
            Self::Disparity { rms_px } => rms_px,
            Self::Depth { floor_m, growth_per_m, from_m, grazing } => {
                let grown_m = growth_per_m * (depth_m - from_m).powi(2);
                let grazing_m = grazing * odds(angle_rad).powi(2) / depth_m.sqrt();
                let total_px = (floor_m + grown_m + grazing_m) * product / (depth_m * depth_m);
                // The variance of rounding adds to that of noise (Sheppard).
                (total_px.powi(2) - step_px.powi(2) / 12.0).max(0.0).sqrt()
            }
        }
    }
}

/// `angle / (pi/2 - angle)`; large but finite at a right angle.
pub(super) fn odds(angle_rad: f64) -> f64 {
    angle_rad / (FRAC_PI_2 - angle_rad).max(1e-3)
}
