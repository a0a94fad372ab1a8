//! What is to be planned, and with what is known.

use super::camera::RoughCamera;
use super::movable::{MovableArm, Positions};
use super::speed::Speed;
use crate::calibrate::Deviation;
use crate::observations::Observations;
use eyebolt_registration::Start;
use nalgebra::{Matrix6, Point3};

/// What is to be planned.
#[derive(Clone)]
pub struct PlanRequest<'a> {
    /// The arm.
    pub arm: &'a MovableArm,
    /// Where the camera is, roughly; several where nobody knows, of which each may be the one.
    pub cameras: &'a [RoughCamera],
    /// What was recorded before.
    pub recorded: Option<Recorded<'a>>,
    /// How well the camera is known otherwise: a calibration's answer.
    pub calibrated: Option<Calibrated>,
    /// Where the arm is now, if that is known.
    pub start: Option<Positions>,
    /// How many configurations are wanted, [`MOST_PLANNED`] at most.
    pub count: usize,
    /// Whether the base stands on a table, which is where the base's lowest part is.
    pub table: bool,
    /// Whether the arm may only be where the camera saw.
    pub seen_only: bool,
    /// How fast the joints are moved.
    pub speed: Speed,
    /// How long the arm rests in each configuration, seconds.
    pub rest_s: f64,
    /// Of all random choices. The same seed gives the same plan on any number of threads.
    pub seed: u64,
}

/// More are not planned at a time: what is recorded of these tells better where the next should be.
pub const MOST_PLANNED: usize = 12;

/// What was recorded before.
#[derive(Clone, Copy)]
pub struct Recorded<'a> {
    /// What was seen.
    pub observations: &'a Observations,
    /// Where the camera is in it, with all that was found to be off.
    pub at: Start,
}

/// How far off a calibration is expected to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibrated {
    /// Error to expect at the middle of the workspace.
    pub expected: Deviation,
    /// Covariance of the pose, as of [`crate::calibrate::ErrorEstimate`].
    pub covariance: Matrix6<f64>,
    /// The middle of the workspace, base frame.
    pub workspace_in_base: Point3<f64>,
}
