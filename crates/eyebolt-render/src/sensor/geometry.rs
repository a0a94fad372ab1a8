//! Disparities before anything is matched.

use super::figures::Triangulation;
use super::specimen::Specimen;
use crate::view::IdealView;
use eyebolt_geometry::PinholeCamera;
use nalgebra::{Point2, Vector3};
use rayon::prelude::*;

/// What each pixel would see if nothing but its own ray mattered.
pub struct Geometry {
    /// Disparity; 0 where nothing is seen.
    pub disparity_px: Vec<f32>,
    /// How fast the disparity of the plane at each pixel grows along u and v.
    pub slope: Vec<[f32; 2]>,
    /// Angle between normal and ray, radians.
    pub angle_rad: Vec<f32>,
}

impl Geometry {
    /// Of `view` of `camera`, whose focal length times baseline is `product`.
    pub fn new(
        view: &IdealView,
        camera: &PinholeCamera,
        product: f64,
        specimen: &Specimen,
    ) -> Self {
        let disparity = |depth_m: &f32| {
            let depth_m = specimen.depth_m(*depth_m);
            if depth_m > 0.0 { (product / f64::from(depth_m)) as f32 } else { 0.0 }
        };
        let disparity_px: Vec<f32> = view.depth_m.par_iter().map(disparity).collect();
        let facing = (0..disparity_px.len()).into_par_iter().map(|at| {
            let (u, v) = (at % view.width, at / view.width);
            let normal = Vector3::from(view.normal_in_camera[at]).cast::<f64>();
            let ray = camera.ray(&Point2::new(u as f64, v as f64)).unwrap_or_default();
            let cosine = (-normal.dot(&ray) / ray.norm()).clamp(0.0, 1.0);
            // A plane's inverse depth is `normal . ray / distance`: affine in the pixel.
            let scale = f64::from(disparity_px[at]) / normal.dot(&ray).min(-1e-6);
            let slope = [normal.x / camera.fx(), normal.y / camera.fy()];
            (slope.map(|by_px| (scale * by_px) as f32), cosine.acos() as f32)
        });
        let (slope, angle_rad) = facing.unzip();
        Self { disparity_px, slope, angle_rad }
    }

    /// The disparities of what can be matched at all.
    pub fn in_sight(
        &self,
        figures: &Triangulation,
        size: [usize; 2],
        second_sees: &[bool],
    ) -> Vec<f32> {
        let seeing = size[0].saturating_sub(figures.blind_columns as usize);
        let pixels = self.disparity_px.par_iter().zip(second_sees).enumerate();
        pixels
            .map(|(at, (px, seen))| {
                let u = at % size[0];
                let beside = figures.overlap_only && (u as f32) - px < -0.5;
                let hidden = figures.shadows && !seen;
                if hidden || beside || u >= seeing { 0.0 } else { *px }
            })
            .collect()
    }
}
