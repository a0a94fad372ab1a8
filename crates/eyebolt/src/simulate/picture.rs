//! Colour pictures: grey surfaces in one light, and the marker on its plate. They are for markers, not for
//! the eye.

use super::plan::Plan;
use super::plate::Plate;
use super::random_stream::RandomStream;
use eyebolt_geometry::{Camera, Transform};
use eyebolt_markers::Marker;
use eyebolt_recording::ColorImage;
use eyebolt_render::Random;
use nalgebra::{Point2, Point3};

/// Brightness of paper and ink in full light, of 255.
const WHITE: f64 = 225.0;
const BLACK: f64 = 28.0;
/// Brightness of the darkest surface, and how many brighter steps there are.
const SURFACE: f64 = 60.0;
const STEPS: u16 = 7;
/// Light from everywhere, as a share; the rest comes from the camera's side.
const AMBIENT: f64 = 0.55;
/// Standard deviation of a pixel's noise.
const NOISE: f64 = 2.0;
/// Samples along each side of a pixel, where the marker is.
const SAMPLES: usize = 4;

/// A picture of one configuration without noise.
pub(super) struct Painted {
    width: u32,
    height: u32,
    values: Vec<f64>,
    random: Random,
}

impl Painted {
    /// Frame `number` of the recording.
    pub(super) fn frame(&self, number: u64) -> ColorImage {
        let random = self.random.at(number);
        let pixel = |(place, value): (usize, &f64)| {
            let noisy = value + NOISE * random.at(place as u64).normal();
            [noisy.round().clamp(0.0, 255.0) as u8; 3]
        };
        let rgb = self.values.iter().enumerate().map(pixel).collect();
        ColorImage { width: self.width, height: self.height, rgb }
    }
}

impl Plan<'_> {
    /// What a colour camera in the place of the depth camera sees of a configuration; `None` without a marker,
    /// when nobody needs it.
    pub(super) fn painted(&self, configuration: usize) -> Option<Painted> {
        let plate = self.plate.as_ref()?;
        let joints = &self.poses.get(configuration)?.joints;
        let hand = self.body.arm.base_from_end_effector(joints).ok()?;
        let base_from_camera = self.pose_at(configuration);
        let view = self.scene_with(joints, configuration).view(&self.camera, base_from_camera);
        let marker_from_camera =
            plate.end_effector_from_marker.inverse() * hand.inverse() * *base_from_camera;
        let plate_surface = self.body.links.len();
        let surfaces = view.surface.iter().zip(&view.normal_in_camera).enumerate();
        let values = surfaces.map(|(place, (surface, normal))| {
            let light = AMBIENT + (1.0 - AMBIENT) * f64::from(normal[2].abs());
            let tone = if usize::from(*surface) == plate_surface {
                self.paper(plate, &marker_from_camera, place)
            } else {
                SURFACE + 15.0 * f64::from(*surface % STEPS)
            };
            light * tone
        });
        Some(Painted {
            width: self.camera.width(),
            height: self.camera.height(),
            values: values.collect(),
            random: RandomStream::Pictures.of(self.scenario.seed),
        })
    }

    /// Mean brightness of the paper in a pixel.
    fn paper(
        &self,
        plate: &Plate,
        marker_from_camera: &Transform<Marker, Camera>,
        place: usize,
    ) -> f64 {
        let width = self.camera.width() as usize;
        let (u, v) = ((place % width) as f64, (place / width) as f64);
        let eye = marker_from_camera.point(&Point3::origin());
        let part = |i: usize| (i as f64 + 0.5) / SAMPLES as f64 - 0.5;
        let sample = |i: usize| {
            let pixel = Point2::new(u + part(i % SAMPLES), v + part(i / SAMPLES));
            let ray = marker_from_camera.direction(&self.camera.ray(&pixel)?);
            let at = eye + ray * (-eye.z / ray.z);
            plate.target.is_white_at(at.x, at.y)
        };
        let tones =
            (0..SAMPLES * SAMPLES).map(|i| if sample(i) == Some(false) { BLACK } else { WHITE });
        tones.sum::<f64>() / (SAMPLES * SAMPLES) as f64
    }
}
