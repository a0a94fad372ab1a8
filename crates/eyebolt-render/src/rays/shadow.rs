//! Which points an eye sees: the shadow of a projector, or of a second lens.

use super::bvh::LANES;
use super::eye::axes_along;
use super::packet::{Packet, RAYS};
use super::scene::RayScene;
use super::traverse::{Todo, cast};
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

/// What is hit within this share of the distance before a point is the point's own surface: 1 mm at
/// 2 m, less than what a depth camera sees.
const OWN_SURFACE: f32 = 5e-4;

/// Rays of one packet stay within this of its middle: cosine of 78 degrees.
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
        let to_point = |p: &Point3<f32>| p.cast::<f64>() - eye_in_base;
        let directions = points.iter().filter_map(|p| to_point(p).try_normalize(0.0));
        let sum: Vector3<f64> = directions.filter(|d| d.iter().all(|v| v.is_finite())).sum();
        let axis = sum.try_normalize(1e-9);
        let axes = axis.map(|axis| axes_along(&axis));
        let narrow = axes.is_some_and(|axes| {
            let along = |p| {
                let ray: Vector3<f64> = axes * to_point(p);
                // What is not finite, or in the eye itself, fits anywhere.
                ray.z >= WIDEST * ray.norm() || !(ray.norm() > 0.0)
            };
            points.iter().all(along)
        });
        if !narrow && points.len() > 1 {
            let half = points.len() / 2;
            let (near, far) = visible.split_at_mut(half);
            self.visible_piece(eye_in_base, &points[..half], near, scratch);
            return self.visible_piece(eye_in_base, &points[half..], far, scratch);
        }
        let Some(axes) = axes else {
            // Only the eye itself has no direction.
            visible.iter_mut().zip(points).for_each(|(v, p)| *v = to_point(p) == Vector3::zeros());
            return;
        };
        let Scratch { packet, stack } = scratch;
        let units = (1.0 / self.metres()) as f32;
        for at in 0..RAYS {
            let ray = points.get(at).map(|p| (axes * to_point(p)).map(|v| v as f32));
            let [x, y, z] = ray.map_or([f32::NAN; 3], Into::into);
            let (row, lane) = (at / LANES, at % LANES);
            (packet.x[row][lane], packet.y[row][lane]) = (x / z, y / z);
            packet.nearest[row][lane] = z * units * (1.0 - OWN_SURFACE);
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
