//! Light that reaches a time-of-flight camera by a detour.

use crate::view::IdealView;
use eyebolt_geometry::{PinholeCamera, RayTable};
use nalgebra::Vector3;
use rayon::prelude::*;
use std::f32::consts::TAU;

/// One patch of what is seen, seen from the camera.
struct Patch {
    point: Vector3<f32>,
    normal: Vector3<f32>,
    distance_m: f32,
    /// Solid angle as seen from the camera, steradians.
    solid_angle: f32,
}

/// How many patches there are along the longer side of the image. What is lit by a patch nearer
/// than its own size is not resolved: errors right in a corner come out too small.
const PATCHES: usize = 24;

/// The error is worked out at every so many pixels along u and v.
const STRIDE: usize = 4;

/// By how much depth is told too far because light also comes over one other surface, metres.
///
/// Surfaces are matt, reflect `reflectivity`, and light each other whether or not something stands
/// between them (Fuchs, *Multipath interference compensation in time-of-flight camera images*,
/// ICPR 2010). Waves of `wavelength_m`, in which the light is modulated, add as phasors: a short
/// detour moves the depth by its share of the signal times half of the detour, one of half a wave
/// not at all.
pub fn multipath_m(
    view: &IdealView,
    camera: &PinholeCamera,
    reflectivity: f64,
    wavelength_m: f64,
) -> Vec<f32> {
    let mut late_m = vec![0.0; view.depth_m.len()];
    if reflectivity == 0.0 {
        return late_m;
    }
    let rays = RayTable::new(camera);
    let patch = |u: usize, v: usize, side: usize| {
        let at = v * view.width + u;
        let (z, [x, y]) = (view.depth_m[at], rays.rays()[at]);
        let toward = Vector3::new(x, y, 1.0);
        let shrink = toward.norm_squared().powf(-1.5) / (camera.fx() * camera.fy()) as f32;
        (z > 0.0 && toward.norm().is_finite()).then(|| Patch {
            point: z * toward,
            normal: Vector3::from(view.normal_in_camera[at]),
            distance_m: z * toward.norm(),
            solid_angle: (side * side) as f32 * shrink,
        })
    };
    let side = view.width.max(view.height).div_ceil(PATCHES);
    let middles = |size: usize| (side / 2..size).step_by(side);
    let senders: Vec<Patch> = middles(view.height)
        .flat_map(|v| middles(view.width).filter_map(move |u| patch(u, v, side)))
        .collect();
    late_m.par_chunks_mut(STRIDE * view.width).enumerate().for_each(|(band, rows)| {
        let v = (band * STRIDE + STRIDE / 2).min(view.height - 1);
        for left in (0..view.width).step_by(STRIDE) {
            let u = (left + STRIDE / 2).min(view.width - 1);
            let Some(receiver) = patch(u, v, 1) else { continue };
            let late = late_at(&receiver, &senders, reflectivity as f32, wavelength_m as f32);
            for row in rows.chunks_mut(view.width) {
                row[left..(left + STRIDE).min(view.width)].fill(late);
            }
        }
    });
    late_m
}

fn late_at(receiver: &Patch, senders: &[Patch], reflectivity: f32, wavelength_m: f32) -> f32 {
    // The direct wave, and what comes later: along it and across.
    let (mut along, mut across) = (1.0, 0.0);
    for sender in senders {
        let to_sender = sender.point - receiver.point;
        let squared = to_sender.norm_squared();
        let area = sender.solid_angle * sender.distance_m * sender.distance_m;
        // Nearer than its size, a patch is no point.
        if squared < area {
            continue;
        }
        let length = squared.sqrt();
        let leaving = -sender.normal.dot(&to_sender) / length;
        let arriving = receiver.normal.dot(&to_sender) / length;
        let facing = -receiver.normal.dot(&receiver.point) / receiver.distance_m;
        if leaving <= 0.0 || arriving <= 0.0 || facing <= 0.05 {
            continue;
        }
        // The foreshortening of the sender as the camera sees it and as the camera lights it cancel.
        let form = sender.solid_angle * leaving * arriving / (std::f32::consts::PI * squared);
        let share = reflectivity * form * receiver.distance_m * receiver.distance_m / facing;
        let detour_m = sender.distance_m + length - receiver.distance_m;
        let (sine, cosine) = (TAU * detour_m / wavelength_m).sin_cos();
        along += share * cosine;
        across += share * sine;
    }
    // There and back; along the ray so far, while depth is along the axis.
    let late_m = 0.5 * wavelength_m / TAU * across.atan2(along);
    late_m * receiver.point.z / receiver.distance_m
}
