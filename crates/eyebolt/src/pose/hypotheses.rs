//! Where an end-effector may be, before anything is refined.

use super::judge::Judge;
use super::observed::Observed;
use super::shape::EndEffectorShape;
use crate::segment::middle;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{Posture, spread_rotations};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Who says that an end-effector may be there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A rotation network, and the translation that follows from it (RPT).
    Rotation,
    /// Matched points (KPM).
    Keypoints,
    /// A half turn of one of these: grippers look alike from behind.
    Twin,
    /// Nobody: rotations spread all over, where no other hypothesis explains what is seen.
    Search,
}

/// A pose to begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseHypothesis {
    /// Pose of the end-effector, as of the base of the [`EndEffectorShape`].
    pub pose: Transform<Camera, Base>,
    /// Who says so.
    pub source: Source,
    /// How likely, by the network; that of its origin for a twin.
    pub probability: f64,
}

/// The pose with this rotation: the translation where what the camera would see of the shape has its middle in
/// the middle of what it saw.
///
/// The paper reads the translation off the bounding box of the points turned back, by a rule for the Panda's
/// hand. What is drawn hides its own far side, so that this needs no rule, and its middle is a median, which one
/// wrong point does not move.
pub fn with_translation(
    judge: &mut Judge<'_>,
    shape: &EndEffectorShape,
    posture: &Posture,
    observed: &Observed,
    rotation: UnitQuaternion<f64>,
) -> Transform<Camera, Base> {
    const ROUNDS: usize = 3;
    let centre = shape.centre();
    let target = observed.middle().coords;
    let mut translation = target - rotation * centre.coords;
    for _ in 0..ROUNDS {
        let pose = Transform::from_parts(translation, rotation);
        let Some(middle) = middle_drawn(judge, posture, observed, &pose) else { break };
        translation += target - middle;
    }
    Transform::from_parts(translation, rotation)
}

/// Median of the points that are seen of the shape at `pose`, each coordinate by itself.
fn middle_drawn(
    judge: &mut Judge<'_>,
    posture: &Posture,
    observed: &Observed,
    pose: &Transform<Camera, Base>,
) -> Option<Vector3<f64>> {
    let raster = judge.draw(posture, pose);
    let rays = &observed.image.rays;
    let point = |at: usize| {
        let z = raster.depth_m(at)?;
        let [x, y] = rays[at];
        Some([x * z, y * z, z])
    };
    let middle = middle(raster.pixels().filter_map(point))?;
    Some(Vector3::from(middle).cast())
}

/// Rotations that are tried where networks say nothing of use: no rotation is farther than some 30 degrees from the nearest.
const SPREAD: usize = 400;

/// The shape turned every way, each time where it has its middle in the middle of what was seen.
pub fn everywhere(
    shape: &EndEffectorShape,
    posture: &Posture,
    observed: &Observed,
) -> Vec<PoseHypothesis> {
    let rotations = spread_rotations(SPREAD, 1);
    let judge = || Judge::new(shape, observed);
    let hypothesis = |judge: &mut Judge<'_>, rotation| {
        let pose = with_translation(judge, shape, posture, observed, rotation);
        PoseHypothesis { pose, source: Source::Search, probability: 1.0 / SPREAD as f64 }
    };
    rotations.into_par_iter().map_init(judge, hypothesis).collect()
}

/// `of` turned by half about each axis of the end-effector frame, through the middle of the shape.
pub fn half_turns(shape: &EndEffectorShape, of: &PoseHypothesis) -> Vec<PoseHypothesis> {
    let centre = shape.centre();
    let axes = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
    let turned = axes.map(|axis| {
        let turn = about(&centre, UnitQuaternion::from_axis_angle(&axis, PI));
        let pose = Transform::from_isometry(of.pose.isometry() * turn);
        PoseHypothesis { pose, source: Source::Twin, ..*of }
    });
    turned.to_vec()
}

/// A turn about a point.
fn about(through: &Point3<f64>, turn: UnitQuaternion<f64>) -> Isometry3<f64> {
    let moved = through.coords - turn * through.coords;
    Isometry3::from_parts(Translation3::from(moved), turn)
}
