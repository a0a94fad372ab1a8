//! What a camera sees: one ray per pixel centre.

use super::bvh::LANES;
use super::packet::{Packet, ROWS};
use super::scene::RayScene;
use super::traverse::cast;
use crate::view::IdealView;
use eyebolt_geometry::{Base, Camera, PinholeCamera, RayTable, Transform};
use nalgebra::Point3;
use rayon::prelude::*;
use std::ops::Range;

/// A packet is a tile of 8 x 8 pixels; its rows are blocks of 4 x 2, which fewer triangles touch
/// than 8 x 1.
const SIDE: usize = 8;
const BLOCK: usize = 4;

/// Row and lane in its packet of the ray of a pixel of the tile.
#[inline(always)]
fn ray(u: usize, v: usize) -> (usize, usize) {
    (v / 2 * 2 + u / BLOCK, v % 2 * BLOCK + u % BLOCK)
}

impl RayScene {
    /// What `camera` sees from a pose. Pixels for which the lens has no ray see nothing.
    pub fn view(
        &self,
        camera: &PinholeCamera,
        base_from_camera: &Transform<Base, Camera>,
    ) -> IdealView {
        self.view_along(&RayTable::new(camera), base_from_camera)
    }

    /// [`Self::view`] along the rays of a camera, which are the same in every frame.
    pub fn view_along(
        &self,
        rays: &RayTable,
        base_from_camera: &Transform<Base, Camera>,
    ) -> IdealView {
        let (width, height) = (rays.width() as usize, rays.height() as usize);
        let metres = self.metres();
        let mut seen = vec![(0.0, Packet::NOTHING); width * height];
        self.trace(rays, base_from_camera, &mut seen, |z, place| {
            ((f64::from(z) * metres) as f32, place)
        });
        let facing = |(at, (_, place)): (usize, &(f32, u32))| {
            if *place == Packet::NOTHING {
                return (IdealView::NOTHING, [0.0; 3]);
            }
            let normal = base_from_camera.rotation().inverse() * self.normal(*place);
            let [x, y] = rays.rays()[at].map(f64::from);
            let away = normal.x * x + normal.y * y + normal.z > 0.0;
            let toward = if away { -normal } else { normal };
            (self.source(*place).0, toward.map(|v| v as f32).into())
        };
        let (surface, normal_in_camera) = seen.par_iter().enumerate().map(facing).unzip();
        let depth_m = seen.into_par_iter().map(|(z_m, _)| z_m).collect();
        IdealView { width, height, depth_m, surface, normal_in_camera }
    }

    /// The depth of [`Self::view_along`] alone, row by row, metres, into `depth_m`, whose memory
    /// is used again.
    pub fn depth(
        &self,
        rays: &RayTable,
        base_from_camera: &Transform<Base, Camera>,
        depth_m: &mut Vec<f32>,
    ) {
        depth_m.resize(rays.rays().len(), 0.0);
        let metres = self.metres();
        self.trace(rays, base_from_camera, depth_m, |z, _| (f64::from(z) * metres) as f32);
    }

    /// Casts the ray of every pixel and writes what `found` makes of its z, units of the scene and 0
    /// for nothing, and the place of the triangle.
    fn trace<T: Send>(
        &self,
        rays: &RayTable,
        base_from_camera: &Transform<Base, Camera>,
        image: &mut [T],
        found: impl Fn(f32, u32) -> T + Sync,
    ) {
        let eye_from_base = base_from_camera.rotation().inverse().to_rotation_matrix().into_inner();
        let eye = self.eye(&Point3::from(base_from_camera.translation_m()), &eye_from_base);
        let width = rays.width() as usize;
        let bands = image.par_chunks_mut(SIDE * width).zip(rays.rays().par_chunks(SIDE * width));
        bands.for_each_init(
            || (Packet::new(), Vec::new()),
            |(packet, stack), (image, rays)| {
                for left in (0..width).step_by(SIDE) {
                    let tile = Tile { width, left };
                    if tile.gather(rays, packet) {
                        cast::<false>(&self.bvh, &eye, packet, stack);
                    }
                    tile.scatter(packet, image, &found);
                }
            },
        );
    }
}

/// Eight columns of a band of up to eight rows.
struct Tile {
    width: usize,
    left: usize,
}

impl Tile {
    /// The pixels of row `v` of the tile, as far as there are any, in a band of `count`.
    fn row(&self, count: usize, v: usize) -> Range<usize> {
        let first = (v * self.width + self.left).min(count);
        first..(first + SIDE.min(self.width - self.left)).min(count)
    }

    fn gather(&self, rays: &[[f32; 2]], packet: &mut Packet) -> bool {
        packet.nearest = [[f32::INFINITY; LANES]; ROWS];
        for v in 0..SIDE {
            let here = &rays[self.row(rays.len(), v)];
            let mut pixels = [[f32::NAN; 2]; SIDE];
            match here.try_into() {
                Ok(whole) => pixels = whole,
                Err(_) => pixels[..here.len()].copy_from_slice(here),
            }
            for u in 0..SIDE {
                let (row, lane) = ray(u, v);
                [packet.x[row][lane], packet.y[row][lane]] = pixels[u];
            }
        }
        packet.settle()
    }

    fn scatter<T>(&self, packet: &Packet, image: &mut [T], found: &impl Fn(f32, u32) -> T) {
        for v in 0..SIDE {
            let here = self.row(image.len(), v);
            for (u, pixel) in image[here].iter_mut().enumerate() {
                let (row, lane) = ray(u, v);
                let place = packet.hit[row][lane];
                let z = if place == Packet::NOTHING { 0.0 } else { packet.nearest[row][lane] };
                *pixel = found(z, place);
            }
        }
    }
}
