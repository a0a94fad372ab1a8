//! Which points an eye sees: the shadow of a projector, or of a second lens.

use super::bvh::LANES;
use super::eye::axes_along;
use super::packet::{Packet, RAYS, ROWS};
use super::scene::RayScene;
use super::traverse::{Todo, cast};
use nalgebra::{Matrix3, Point3, Vector3};
use rayon::prelude::*;

/// What is hit within this share of the distance before a point is the point's own surface: 1 mm at
/// 2 m, less than what a depth camera sees.
const OWN_SURFACE: f32 = 5e-4;

/// Rays of one packet stay within this of its axis: cosine of 78 degrees.
const WIDEST: f64 = 0.2;

impl RayScene {
    /// Whether nothing lies between `eye_in_base` (metres) and each point. Points that are not
    /// finite are not seen.
    ///
    /// What is within 0.05 % of the distance from the point counts as its own surface. Fastest if
    /// neighbours in `points_in_base` are neighbours in space too, as the pixels of an image are.
    pub fn visible_from(
        &self,
        eye_in_base: Point3<f64>,
        points_in_base: &[Point3<f32>],
    ) -> Vec<bool> {
        let mut visible = vec![false; points_in_base.len()];
        let pieces = visible.par_chunks_mut(RAYS).zip(points_in_base.par_chunks(RAYS));
        pieces.for_each_init(Scratch::new, |scratch, (visible, points)| {
            self.visible_piece(&eye_in_base, points, visible, scratch);
        });
        visible
    }

    /// [`Self::visible_from`] for as many points as a packet has rays.
    fn visible_piece(
        &self,
        eye_in_base: &Point3<f64>,
        points: &[Point3<f32>],
        visible: &mut [bool],
        scratch: &mut Scratch,
    ) {
        let rays = points.iter().map(|p| p.cast::<f64>() - eye_in_base);
        let Some(axes) = axes_of(rays.clone()) else {
            // Nothing lies between an eye and itself.
            visible.iter_mut().zip(rays).for_each(|(v, ray)| *v = ray == Vector3::zeros());
            return;
        };
        // What is not finite, or in the eye itself, fits anywhere.
        let outside = |ray: Vector3<f64>| (axes * ray).z < WIDEST * ray.norm();
        if points.len() > 1 && rays.clone().any(outside) {
            let half = points.len() / 2;
            let (near, far) = visible.split_at_mut(half);
            self.visible_piece(eye_in_base, &points[..half], near, scratch);
            return self.visible_piece(eye_in_base, &points[half..], far, scratch);
        }
        let Scratch { packet, stack } = scratch;
        packet.x = [[f32::NAN; LANES]; ROWS];
        for (at, ray) in rays.enumerate() {
            let [x, y, z] = (axes * ray / self.metres()).map(|v| v as f32).into();
            let (row, lane) = (at / LANES, at % LANES);
            (packet.x[row][lane], packet.y[row][lane]) = (x / z, y / z);
            packet.nearest[row][lane] = z * (1.0 - OWN_SURFACE);
        }
        if packet.settle() {
            cast::<true>(&self.bvh, &self.eye(eye_in_base, &axes), packet, stack);
        }
        for (at, (visible, point)) in visible.iter_mut().zip(points).enumerate() {
            let finite = point.iter().all(|v| v.is_finite());
            *visible = finite && packet.hit[at / LANES][at % LANES] == Packet::NOTHING;
        }
    }
}

/// Axes whose z is along the first of the rays that has a direction; `None` if none has.
fn axes_of(mut rays: impl Iterator<Item = Vector3<f64>>) -> Option<Matrix3<f64>> {
    let along =
        |ray: Vector3<f64>| ray.try_normalize(0.0).filter(|z| z.iter().all(|v| v.is_finite()));
    rays.find_map(along).map(|z| axes_along(&z))
}

/// What a thread works with.
struct Scratch {
    packet: Packet,
    stack: Vec<Todo>,
}

impl Scratch {
    fn new() -> Self {
        Self { packet: Packet::new(), stack: Vec::new() }
    }
}
