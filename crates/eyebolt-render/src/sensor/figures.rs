//! What a depth camera of either family is described by.

use super::laws::{AxialNoise, LateralNoise};

/// The figures of a camera that finds a pattern, or the image of a second lens, in its own image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangulation {
    /// Where the second lens or the projector is along x of the camera's frame, metres. To the
    /// right: its shadows lie to the left of things.
    pub baseline_m: f64,
    /// Whether what the second lens does not see, or the projector does not light, has no depth;
    /// else the depth of what is seen is guessed rightly.
    pub shadows: bool,
    /// Whether the image of the second lens ends where the camera's does, so that a band along the
    /// left edge has no depth.
    pub overlap_only: bool,
    /// Columns along the right edge that never have depth.
    pub blind_columns: u32,
    /// Disparity is told in multiples of this, pixels; 0 if it is continuous.
    pub step_px: f64,
    /// Error of depth.
    pub axial: AxialNoise,
    /// Lag at which the error of pixels is half correlated, pixels.
    pub half_correlation_px: f64,
    /// Share of the variance of all errors that is the same in every frame of a scene at rest.
    pub fixed_share: f64,
    /// Change of the disparity at which that part of the error is half correlated, pixels.
    pub half_correlation_disparity_px: f64,
    /// Error of where edges are.
    pub lateral: LateralNoise,
    /// What is compared.
    pub window: Window,
    /// How far things grow in the image over what lies behind them, pixels.
    pub fattening_px: f64,
    /// How wide a rim without depth lies around that, pixels.
    pub rim_px: f64,
    /// Angle between surface normal and ray, mean over the window, beyond which there is no depth,
    /// radians.
    pub largest_angle_rad: f64,
}

/// The window that is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// It is `2 half_px + 1` pixels wide and high.
    pub half_px: usize,
    /// Share of the window that must have the disparity of its middle for a match.
    pub least_share: f64,
}

/// The figures of a time-of-flight camera.
///
/// Signal is what comes back of the light that the camera sends out: it falls with the square of
/// the distance and with the cosine of the angle of incidence, and random error grows as it falls
/// (Lange and Seitz, *Solid-state time-of-flight range camera*, IEEE Journal of Quantum
/// Electronics 37(3), 2001). It is measured here in that of a surface at 1 m that
/// faces the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeOfFlight {
    /// Standard deviation of depth from frame to frame at a signal of 1, metres.
    pub random_m: f64,
    /// Signal below which there is no depth.
    pub least_signal: f64,
    /// Standard deviation over specimens and places of the error that all frames share, at depth
    /// 0, metres.
    pub systematic_m: f64,
    /// By how much that grows with depth, metres per metre.
    pub systematic_growth: f64,
    /// Standard deviation of the image of a point, pixels: what a pixel mixes of two surfaces at an
    /// edge is a depth between them.
    pub blur_px: f64,
    /// Share of the signal of a pixel that must come from one surface.
    pub least_share: f64,
    /// Share of the light that surfaces send on to each other; 0 for no multipath.
    pub reflectivity: f64,
    /// Wavelength of the modulation of the light that depth is told by, metres.
    pub wavelength_m: f64,
}
