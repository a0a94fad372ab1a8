//! Where cameras are in images to learn from.

use super::actor::{Actor, Pose};
use crate::segment::{window_half_m, window_step};
use eyebolt_geometry::{Base, Camera, Distortion, PinholeCamera, Transform};
use eyebolt_render::Random;
use nalgebra::{Point3, Rotation3, UnitQuaternion, Vector3};

/// A camera of usual shape and angle of view, somewhere around, with the arm in view.
pub fn look_at_arm(
    actor: &Actor,
    pose: &Pose,
    random: &mut Random,
    columns: usize,
) -> (PinholeCamera, Transform<Base, Camera>) {
    let rows = if random.uniform() < 0.4 { columns * 9 / 16 } else { columns * 3 / 4 };
    let half_view = random.between(24.0, 46.0).to_radians();
    let focal = 0.5 * columns as f64 / half_view.tan();
    let middle = [columns, rows]
        .map(|size| 0.5 * (size as f64 - 1.0) + size as f64 * 0.02 * random.normal());
    let camera = camera([columns, rows], focal, middle);
    let tip = pose.base_from_end_effector.translation_m();
    let stray = 0.15 * actor.reach_m;
    let at = tip * random.uniform() + Vector3::from_fn(|_, _| stray * random.normal());
    let distance = spread_evenly(random, 0.45, 3.6).max(0.5 * actor.reach_m);
    (camera, from_anywhere(random, at, distance))
}

/// The part of an image of some camera that shows `middle`, base frame, metres, as near as it would show the end-effector.
pub fn look_from_near(
    actor: &Actor,
    middle: Point3<f64>,
    random: &mut Random,
    columns: usize,
) -> (PinholeCamera, Transform<Base, Camera>) {
    let extent = actor.end_effector_extent_m();
    let distance = spread_evenly(random, 0.4, 2.2).max(2.0 * extent);
    // As many pixels as real cameras give it at that distance, binned as a window around it is.
    let focal = random.between(380.0, 750.0);
    let half_px = f64::from(window_half_m(extent)) * focal / distance;
    let focal = focal / window_step(half_px) as f64;
    let base_from_axis = from_anywhere(random, middle.coords, distance);
    // Beside the optical axis of the whole image.
    let aside = [0, 1].map(|_| 0.25 * random.normal());
    let turn = Rotation3::from_euler_angles(aside[0], aside[1], 0.0);
    let turn = Transform::<Camera, Camera>::from_parts(
        Vector3::zeros(),
        UnitQuaternion::from_rotation_matrix(&turn),
    );
    let toward = turn.inverse().direction(&Vector3::z());
    let half = 0.5 * (columns as f64 - 1.0);
    let at = [toward.x, toward.y].map(|slope| half - focal * slope / toward.z);
    (camera([columns, columns], focal, at), base_from_axis * turn)
}

fn camera([columns, rows]: [usize; 2], focal: f64, [cx, cy]: [f64; 2]) -> PinholeCamera {
    let (width, height) = (columns as u32, rows as u32);
    let camera = PinholeCamera::new(width, height, focal, focal, cx, cy, Distortion::None);
    camera.expect("a focal length above 0, and a few columns")
}

/// From `low` to `high`, each octave as often.
pub fn spread_evenly(random: &mut Random, low: f64, high: f64) -> f64 {
    (low / high).powf(random.uniform()) * high
}

/// A camera so far from `at` that looks at it from any side, mostly upright and from above.
fn from_anywhere(random: &mut Random, at: Vector3<f64>, distance: f64) -> Transform<Base, Camera> {
    let around = random.between(0.0, std::f64::consts::TAU);
    let toward = Vector3::new(around.cos(), around.sin(), random.between(-0.25, 1.0)).normalize();
    let roll = if random.uniform() < 0.2 { 3.0 * random.normal() } else { 0.12 * random.normal() };
    let looking = Rotation3::face_towards(&-toward, &-Vector3::z());
    let roll = Rotation3::from_axis_angle(&Vector3::z_axis(), roll);
    let rotation = UnitQuaternion::from_rotation_matrix(&(looking * roll));
    Transform::from_parts(at + distance * toward, rotation)
}
