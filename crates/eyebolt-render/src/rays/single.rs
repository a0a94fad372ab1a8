//! One ray.

use super::eye::axes_along;
use super::packet::Packet;
use super::scene::RayScene;
use super::traverse::cast;
use nalgebra::{Point3, Vector3};

/// What a ray hits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// How far from the origin, metres.
    pub distance_m: f64,
    /// Index of the mesh, in the order in which the scene was given them.
    pub surface: u16,
    /// Index of the triangle in its mesh.
    pub triangle: u32,
    /// Unit normal of the triangle, turned toward the origin of the ray.
    pub normal_in_base: Vector3<f64>,
}

impl RayScene {
    /// The nearest triangle that a ray from `origin_in_base` (metres) hits; `direction_in_base` has
    /// any length. `None` if there is none, or the direction is zero or not finite.
    pub fn nearest(
        &self,
        origin_in_base: &Point3<f64>,
        direction_in_base: &Vector3<f64>,
    ) -> Option<Hit> {
        let direction = direction_in_base.try_normalize(0.0)?;
        let eye = self.eye(origin_in_base, &axes_along(&direction));
        let mut packet = Packet::new();
        packet.nearest[0][0] = f32::INFINITY;
        packet.settle();
        cast::<false>(&self.bvh, &eye, &mut packet, &mut Vec::new());
        let place = packet.hit[0][0];
        if place == Packet::NOTHING {
            return None;
        }
        let normal = self.normal(place);
        let away = normal.dot(&direction) > 0.0;
        let (surface, triangle) = self.source(place);
        Some(Hit {
            distance_m: f64::from(packet.nearest[0][0]) * self.metres(),
            surface,
            triangle,
            normal_in_base: if away { -normal } else { normal },
        })
    }
}
