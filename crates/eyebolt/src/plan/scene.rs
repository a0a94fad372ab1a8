//! What a recording's camera saw around the arm, as far as it tells where the arm has room.
//!
//! A thing that stands still leaves free whatever the camera saw through in some view. What is behind a surface in every
//! view that shows the place may be anything, and is taken; but behind the arm alone it is unknown, as what is beyond the
//! image or has no depth.

use crate::observations::Observations;
use eyebolt_geometry::{Base, Camera, DepthImage, PinholeCamera, RayTable, Transform};
use eyebolt_registration::{ArmModel, Posture, Start};
use eyebolt_render::Raster;
use nalgebra::Point3;
use rayon::prelude::*;

/// Whether there is room at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Room {
    /// The camera saw through it, or the arm was there.
    Free,
    /// Something is there, or hides it.
    Taken,
    /// Nobody has seen.
    Unknown,
}

/// What a camera saw of some configurations.
pub(super) struct SeenScene {
    camera: PinholeCamera,
    camera_from_base: Transform<Camera, Base>,
    model: ArmModel,
    views: Vec<SeenView>,
}

/// One view, coarse, each pixel with whatever is nearest within the clearance.
struct SeenView {
    /// Depth of the nearest thing about there, metres; 0 where there is none.
    nearest_m: Vec<f32>,
    /// Whether that is the arm.
    is_arm: Vec<bool>,
    /// Whether all of the pixel itself has depth.
    is_told: Vec<bool>,
    /// Where the arm was.
    posture: Posture,
}

/// Columns of the coarse images.
const COLUMNS: u32 = 160;
/// What is seen this near to the surface of the posed arm is the arm, metres.
const ARM_M: f32 = 0.04;
/// The arm has been this near to where it was, metres.
const WAS_THERE_M: f32 = 0.01;

impl SeenScene {
    /// What `observations` show where the camera is as `at` has it; nothing is to come nearer to it than `clearance_m`.
    pub(super) fn new(observations: &Observations, at: &Start, clearance_m: f64) -> Self {
        let factor = (observations.camera.width() / COLUMNS).max(1);
        let fine = &observations.camera;
        let camera = fine.scaled(factor).unwrap_or_else(|_| fine.clone());
        let factor = (fine.width() / camera.width()) as usize;
        let view = |configuration: &crate::observations::Configuration| {
            let posture = configuration.posture.moved(&observations.arm, &at.joint_offsets);
            let seen = Seen {
                depth: &configuration.depth,
                depth_factor: at.depth_factor(),
                camera: &camera,
                factor,
                clearance_m,
            };
            seen.view(&observations.arm, posture, &at.camera_from_base)
        };
        Self {
            views: observations.configurations.par_iter().map(view).collect(),
            model: observations.arm.clone(),
            camera_from_base: at.camera_from_base,
            camera,
        }
    }

    /// Whether there is room at a point, base frame.
    pub(super) fn room(&self, point_in_base: &Point3<f32>) -> Room {
        let point = self.camera_from_base.point(&point_in_base.cast());
        let pixel = self.camera.project(&point).filter(|pixel| self.camera.contains(pixel));
        let Some(pixel) = pixel else { return self.where_the_arm_was(point_in_base) };
        let (u, v) = ((pixel.x + 0.5) as usize, (pixel.y + 0.5) as usize);
        let at = v * self.camera.width() as usize + u;
        let mut hidden = Room::Unknown;
        for view in &self.views {
            let nearest_m = view.nearest_m[at];
            match (nearest_m > 0.0, point.z < f64::from(nearest_m)) {
                (true, true) if view.is_told[at] => return Room::Free,
                (true, false) if !view.is_arm[at] => hidden = Room::Taken,
                _ => {}
            }
        }
        match self.where_the_arm_was(point_in_base) {
            Room::Free => Room::Free,
            _ => hidden,
        }
    }

    fn where_the_arm_was(&self, point_in_base: &Point3<f32>) -> Room {
        let was_there = |view: &SeenView| {
            view.posture.nearest_within(&self.model, point_in_base, WAS_THERE_M, 0).is_some()
        };
        if self.views.iter().any(was_there) { Room::Free } else { Room::Unknown }
    }
}

/// What is made a [`SeenView`] of.
struct Seen<'a> {
    depth: &'a DepthImage,
    depth_factor: f32,
    /// The coarse camera, and how much coarser it is.
    camera: &'a PinholeCamera,
    factor: usize,
    clearance_m: f64,
}

impl Seen<'_> {
    fn view(
        &self,
        arm: &ArmModel,
        posture: Posture,
        camera_from_base: &Transform<Camera, Base>,
    ) -> SeenView {
        let (width, height) = (self.camera.width() as usize, self.camera.height() as usize);
        let base_from_camera = camera_from_base.inverse();
        let rays = RayTable::new(self.camera);
        let mut raster = Raster::new(self.camera);
        raster.draw(self.camera, &posture.meshes(arm, camera_from_base));
        let mut view = SeenView {
            nearest_m: vec![0.0; width * height],
            is_arm: vec![false; width * height],
            is_told: vec![false; width * height],
            posture,
        };
        for at in 0..width * height {
            let (nearest, told) = self.block(at % width, at / width);
            view.is_told[at] = told;
            if nearest <= 0.0 {
                continue;
            }
            let point = base_from_camera.point(&rays.point(at, nearest).cast()).cast();
            let is_arm = view.posture.nearest_within(arm, &point, ARM_M, 0).is_some();
            self.spread(at, nearest, is_arm, &mut view);
        }
        view
    }

    /// The least depth of the pixels of a coarse one, 0 if there is none, and whether most of them have any.
    fn block(&self, u: usize, v: usize) -> (f32, bool) {
        let width = self.depth.width() as usize;
        let (mut least, mut told) = (f32::INFINITY, 0);
        for row in v * self.factor..(v + 1) * self.factor {
            let row = &self.depth.depth_m()[row * width + u * self.factor..][..self.factor];
            for z in row.iter().filter(|z| **z > 0.0) {
                least = least.min(self.depth_factor * z);
                told += 1;
            }
        }
        let told = 2 * told > self.factor * self.factor;
        (if least.is_finite() { least } else { 0.0 }, told)
    }

    /// Nothing is to come within the clearance of what is seen at `at`: the pixels about it are not free beyond.
    fn spread(&self, at: usize, nearest: f32, is_arm: bool, view: &mut SeenView) {
        let (width, height) = (self.camera.width() as usize, self.camera.height() as usize);
        let clear_m = (nearest - self.clearance_m as f32).max(1e-3);
        let reach = (self.clearance_m * self.camera.fx() / f64::from(clear_m)).ceil();
        let reach = (reach as usize).min(width);
        let (u, v) = (at % width, at / width);
        for row in v.saturating_sub(reach)..(v + reach + 1).min(height) {
            for column in u.saturating_sub(reach)..(u + reach + 1).min(width) {
                let at = row * width + column;
                if view.nearest_m[at] == 0.0 || clear_m < view.nearest_m[at] {
                    view.nearest_m[at] = clear_m;
                    view.is_arm[at] = is_arm;
                }
            }
        }
    }
}
