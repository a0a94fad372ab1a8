//! Distances to plain shapes, by formulas: of the built-in robot and the empty room all shapes are
//! boxes and cylinders, so that neither triangles nor distance fields are needed to judge them.

use crate::stage::ARM;
use eyebolt::simulate::Plan;
use eyebolt_geometry::PinholeCamera;
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_robot::{JointPositions, Shape};
use nalgebra::{Isometry3, Point2, Point3, Translation3, Vector2, Vector3};

/// A shape in the base frame.
pub struct Placed {
    body_from_base: Isometry3<f64>,
    shape: Shape,
    /// The link that it belongs to; `None` for the room.
    pub link: Option<usize>,
}

impl Placed {
    /// Distance of a point in the base frame from the shape, metres; negative inside.
    pub fn distance_m(&self, point_in_base: &Point3<f64>) -> f64 {
        let p = self.body_from_base * point_in_base;
        match &self.shape {
            Shape::Box { size } => {
                let q = p.coords.abs() - 0.5 * Vector3::from(*size);
                q.sup(&Vector3::zeros()).norm() + q.max().min(0.0)
            }
            Shape::Cylinder { radius, length } => {
                let across = p.coords.xy().norm() - radius;
                let q = Vector2::new(across, p.z.abs() - 0.5 * length);
                q.sup(&Vector2::zeros()).norm() + q.max().min(0.0)
            }
            other => panic!("{other:?} is not expected here"),
        }
    }
}

/// The arm's shapes at `joints`.
pub fn arm(joints: &JointPositions) -> Vec<Placed> {
    let poses = ARM.link_poses(joints).unwrap();
    let links = ARM.robot().links.iter().enumerate();
    let shapes = links.flat_map(|(index, link)| {
        let base_from_link = poses[index].unwrap();
        link.visuals.iter().map(move |body| Placed {
            body_from_base: (base_from_link.isometry() * body.link_from_body.isometry()).inverse(),
            shape: body.shape.clone(),
            link: Some(index),
        })
    });
    shapes.collect()
}

/// Solids of the room, which come before the clutter: table, floor, four legs, four walls.
pub const ROOM: usize = 10;

/// The solids of a plan without clutter, all of which are upright boxes.
pub fn room(plan: &Plan<'_>) -> Vec<Placed> {
    assert_eq!(plan.solids().len(), ROOM);
    let boxes = plan.solids().iter().map(|solid| {
        let (low, high) = solid.bounds();
        let (low, high) = (low.cast::<f64>(), high.cast::<f64>());
        let middle = nalgebra::center(&low, &high);
        Placed {
            body_from_base: Translation3::from(middle.coords).inverse().into(),
            shape: Shape::Box { size: (high - low).into() },
            link: None,
        }
    });
    boxes.collect()
}

/// Distance from the nearest of `shapes`, and which that is.
fn nearest(shapes: &[Placed], point: &Point3<f64>) -> (f64, usize) {
    let distances = shapes.iter().map(|shape| shape.distance_m(point));
    distances.zip(0..).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
}

/// Depth along the optical axis at `pixel`, metres, and which of `shapes` is seen there: steps as
/// long as the nearest shape is far (J. C. Hart, "Sphere tracing", The Visual Computer 12, 1996).
pub fn seen(
    shapes: &[Placed],
    camera: &PinholeCamera,
    base_from_camera: &Transform<Base, Camera>,
    pixel: &Point2<f64>,
) -> Option<(f64, usize)> {
    const FARTHEST_M: f64 = 20.0;
    let ray = Vector3::new(
        (pixel.x - camera.cx()) / camera.fx(),
        (pixel.y - camera.cy()) / camera.fy(),
        1.0,
    );
    let mut z_m = 0.0;
    for _ in 0..4000 {
        let (distance_m, shape) =
            nearest(shapes, &base_from_camera.point(&Point3::from(z_m * ray)));
        if distance_m < 1e-6 {
            return Some((z_m, shape));
        }
        z_m += distance_m / ray.norm();
        if z_m > FARTHEST_M {
            return None;
        }
    }
    None
}
