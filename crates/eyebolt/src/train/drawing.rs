//! An arm before a camera, and what stands around it.

use super::actor::{Actor, Pose};
use super::look::spread_evenly;
use crate::segment::{ARM, BACKGROUND, END_EFFECTOR, Thinned, UNKNOWN};
use eyebolt_geometry::{Base, Camera, EndEffector, Link, PinholeCamera, RayTable, Transform};
use eyebolt_render::{Random, Raster, RayScene, SceneMesh};
use eyebolt_robot::{Body, Prefer, Shape, TriangleMesh, link_mesh};
use nalgebra::{Point3, UnitQuaternion, Vector3};

/// An arm as an ideal camera sees it, with nothing around yet.
pub struct Drawing<'a> {
    /// Where the arm is.
    pub pose: Pose,
    actor: &'a Actor,
    camera: PinholeCamera,
    base_from_camera: Transform<Base, Camera>,
    raster: Raster,
}

impl<'a> Drawing<'a> {
    /// Draws the arm.
    pub fn new(
        actor: &'a Actor,
        pose: Pose,
        camera: PinholeCamera,
        base_from_camera: Transform<Base, Camera>,
    ) -> Self {
        let mut raster = Raster::new(&camera);
        actor.draw(&mut raster, &camera, &pose, &base_from_camera.inverse());
        Self { pose, actor, camera, base_from_camera, raster }
    }

    /// Where the camera is, base frame, metres.
    pub fn eye(&self) -> Point3<f64> {
        Point3::from(self.base_from_camera.translation_m())
    }

    /// Pose of the end-effector.
    pub fn camera_from_end_effector(&self) -> Transform<Camera, EndEffector> {
        self.base_from_camera.inverse() * self.pose.base_from_end_effector
    }

    /// Share of the image where the arm is seen with a label that `counts`.
    pub fn share_of(&self, counts: impl Fn(u8) -> bool) -> f64 {
        let seen = self.raster.pixels().filter(|at| self.label(*at).is_some_and(&counts));
        seen.count() as f64 / self.camera.pixel_count() as f64
    }

    fn label(&self, at: usize) -> Option<u8> {
        let hand = self.actor.is_end_effector[usize::from(self.raster.link(at)?)];
        Some(if hand { END_EFFECTOR } else { ARM })
    }

    /// Ideal depth with `scene` around, or a plane behind, and parts that no description has; and whose each
    /// pixel is.
    pub fn finished(&self, scene: Option<&RayScene>, random: Random) -> (Thinned, Vec<u8>) {
        let table = RayTable::new(&self.camera);
        let mut depth_m = Vec::new();
        match scene {
            Some(scene) => scene.depth(&table, &self.base_from_camera, &mut depth_m),
            None => depth_m = backdrop(&table, &self.raster, &mut random.at(0)),
        }
        let mut label = vec![BACKGROUND; depth_m.len()];
        for at in self.raster.pixels() {
            let (Some(z), Some(of)) = (self.raster.depth_m(at), self.label(at)) else { continue };
            if depth_m[at] == 0.0 || z < depth_m[at] {
                (depth_m[at], label[at]) = (z, of);
            }
        }
        let parts = undescribed(self.actor, &self.pose, random.at(1));
        if !parts.is_empty() {
            let mut before = Vec::new();
            let meshes: Vec<SceneMesh<'_>> = parts
                .iter()
                .map(|(mesh, base_from_mesh)| SceneMesh { mesh, base_from_mesh: *base_from_mesh })
                .collect();
            RayScene::new(&meshes).depth(&table, &self.base_from_camera, &mut before);
            for (at, z) in before.into_iter().enumerate().filter(|(_, z)| *z > 0.0) {
                if depth_m[at] == 0.0 || z < depth_m[at] {
                    (depth_m[at], label[at]) = (z, UNKNOWN);
                }
            }
        }
        let (width, height) = (self.camera.width() as usize, self.camera.height() as usize);
        let rays = table.rays().to_vec();
        (Thinned { width, height, step: 1, corner: [0; 2], depth_m, rays }, label)
    }
}

/// A plane somewhere behind the middle of what is drawn: of the room, no more is seen beside an
/// end-effector from near. Or nothing, where that is out of range.
fn backdrop(rays: &RayTable, raster: &Raster, random: &mut Random) -> Vec<f32> {
    const NOTHING_BEHIND: f64 = 0.2;
    let none = vec![0.0; rays.rays().len()];
    let (columns, rows) = raster.drawn();
    let middle = (rows.start + rows.end) / 2 * raster.width() + (columns.start + columns.end) / 2;
    let (Some(z), true) = (raster.depth_m(middle), random.uniform() >= NOTHING_BEHIND) else {
        return none;
    };
    let [slope_x, slope_y] = [0, 1].map(|_| 0.7 * random.normal() as f32);
    let [x0, y0] = rays.rays()[middle];
    let behind = z + spread_evenly(random, 0.03, 2.0) as f32;
    // Through the point behind the middle, with normal (slope_x, slope_y, -1).
    let at = |[x, y]: &[f32; 2]| {
        let z = behind * (1.0 - slope_x * x0 - slope_y * y0) / (1.0 - slope_x * x - slope_y * y);
        if z.is_finite() && (0.0..20.0).contains(&z) { z } else { 0.0 }
    };
    rays.rays().iter().map(at).collect()
}

/// Tools, brackets and cables that a description lacks.
fn undescribed(
    actor: &Actor,
    pose: &Pose,
    random: Random,
) -> Vec<(TriangleMesh, Transform<Base, Link>)> {
    const SOME: f64 = 0.4;
    // Most of what is mounted on an arm is at its end.
    const ON_END_EFFECTOR: f64 = 0.4;
    let mut style = random.at(0);
    if style.uniform() >= SOME {
        return Vec::new();
    }
    let count = 1 + style.index(3);
    let at_the_end: Vec<usize> =
        (0..actor.meshes.len()).filter(|shape| actor.is_end_effector[*shape]).collect();
    let part = |index: u64| {
        let mut random = random.at(1).at(index);
        let any = random.index(actor.meshes.len());
        let on = match random.uniform() < ON_END_EFFECTOR && !at_the_end.is_empty() {
            true => at_the_end[random.index(at_the_end.len())],
            false => any,
        };
        let (low, high) = actor.meshes[on].bounds()?;
        let corner = |axis: usize, random: &mut Random| {
            random.between(f64::from(low[axis]), f64::from(high[axis]))
        };
        let at =
            Point3::new(corner(0, &mut random), corner(1, &mut random), corner(2, &mut random));
        let axis = Vector3::new(random.normal(), random.normal(), random.normal());
        let turn = UnitQuaternion::new(axis.normalize() * random.between(0.0, 3.1));
        let shape = match random.index(3) {
            0 => Shape::Box { size: [0, 1, 2].map(|_| random.between(0.02, 0.16)) },
            1 => Shape::Cylinder {
                radius: random.between(0.004, 0.03),
                length: random.between(0.05, 0.3),
            },
            _ => Shape::Capsule {
                radius: random.between(0.004, 0.02),
                length: random.between(0.1, 0.4),
            },
        };
        let link_from_body = Transform::from_parts(at.coords, turn);
        let link = eyebolt_robot::Link {
            name: String::new(),
            parent: None,
            visuals: vec![Body { link_from_body, shape }],
            collisions: Vec::new(),
        };
        Some((link_mesh(&link, Prefer::Visual).ok()??, pose.base_from_link[on]))
    };
    (0..count as u64).filter_map(part).collect()
}
