//! Something large that stands before the arm.

use super::body::ArmBody;
use super::configurations::Pose;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use super::solids::Solid;
use super::surroundings::in_place;
use eyebolt_geometry::Transform;
use eyebolt_render::{Random, RayScene};
use eyebolt_robot::{Body, Shape};
use nalgebra::{Point3, UnitQuaternion, Vector3};

/// Boxes tried: one that hides nearly what is wanted is among so many.
const TRIES: u64 = 60;
/// Nearer to the camera nothing stands, metres.
const CAMERA_CLEARANCE_M: f64 = 0.3;

/// The box that hides most nearly the wanted share of the arm in `poses` from `eye` (base frame), if
/// there is to be one. It stands clear of the arm.
pub(super) fn before(
    scenario: &Scenario<'_>,
    body: &ArmBody,
    poses: &[Pose],
    eye: &Point3<f64>,
) -> Option<Solid> {
    let wanted = Some(scenario.faults.occlusion).filter(|share| *share > 0.0)?;
    let points: Vec<Point3<f32>> =
        poses.iter().flat_map(|pose| body.surface(&pose.posture)).collect();
    let sum = points.iter().map(|point| point.coords.cast::<f64>()).sum::<Vector3<f64>>();
    let middle = Point3::from(sum / points.len().max(1) as f64);
    let random = RandomStream::Occlusion.of(scenario.seed);
    let boxes = (0..TRIES).map(|place| standing_between(&mut random.at(place), eye, &middle));
    let clear = boxes.filter(|solid| {
        poses.iter().all(|pose| body.is_clear_of(&pose.posture, solid))
            && solid.mesh.vertices.iter().all(|at| (at.cast() - eye).norm() > CAMERA_CLEARANCE_M)
    });
    let off = |solid: &Solid| {
        let sees = RayScene::new(&[in_place(solid)]).visible_from(*eye, &points);
        let hidden = sees.iter().filter(|sees| !**sees).count();
        (hidden as f64 / points.len().max(1) as f64 - wanted).abs()
    };
    clear
        .map(|solid| (off(&solid), solid))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, solid)| solid)
}

/// An upright box between `eye` and somewhere near `middle`, turned to the camera.
fn standing_between(random: &mut Random, eye: &Point3<f64>, middle: &Point3<f64>) -> Solid {
    let away = middle - eye;
    let aside = Vector3::new(-away.y, away.x, 0.0).try_normalize(1e-9).unwrap_or_else(Vector3::x);
    let breadth = away.norm() * random.between(0.08, 0.4);
    let height = away.norm() * random.between(0.1, 0.5);
    let at = eye
        + random.between(0.35, 0.75) * away
        + aside * random.between(-0.25, 0.25) * away.norm()
        + Vector3::z() * random.between(-0.25, 0.1) * away.norm();
    let turn = UnitQuaternion::from_axis_angle(
        &Vector3::z_axis(),
        away.y.atan2(away.x) + random.between(-0.3, 0.3),
    );
    let shape = Shape::Box { size: [0.06, breadth, height] };
    let body = Body { link_from_body: Transform::from_parts(at.coords, turn), shape };
    Solid::new("occluder", &[body])
}
