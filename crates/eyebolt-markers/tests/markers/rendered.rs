//! Markers that are drawn are found, where they were drawn.

use crate::draw::{Look, picture};
use crate::noise::noise;
use crate::strategies::config;
use eyebolt_geometry::{Camera, Distortion, PinholeCamera, Transform, rotation_exp};
use eyebolt_markers::{Dictionary, Marker, Target, detect, planar_poses};
use nalgebra::{Point2, Vector3};
use proptest::prelude::*;

/// A picture of `320 * times` x `240 * times` pixels.
fn camera(times: u32) -> PinholeCamera {
    let lens = Distortion::plumb_bob([0.06, -0.12, 0.001, -0.0005, 0.02]);
    let by = f64::from(times);
    let (fx, fy, cx, cy) = (300.0 * by, 302.0 * by, 161.0 * by, 118.0 * by);
    PinholeCamera::new(320 * times, 240 * times, fx, fy, cx, cy, lens).unwrap()
}

/// A target in view, at most 50 degrees off square, turned in its plane by any angle.
fn pose(seed: u64, target: &Target, camera: &PinholeCamera, px: f64) -> Transform<Camera, Marker> {
    let n = |place: u64| noise(seed, place);
    let tilt = Vector3::new(n(0), n(1), 0.0) * 0.6;
    let turn = rotation_exp(&tilt) * rotation_exp(&(Vector3::z() * (3.1 * n(2))));
    let (wide, high) = target.size_m();
    let z = camera.fx() * target.marker_m() / px;
    let middle = Vector3::new(0.15 * n(3) * z, 0.1 * n(4) * z, z);
    let centred = if target.ids().len() > 1 {
        Vector3::new(0.5 * wide, 0.5 * high, 0.0)
    } else {
        Vector3::zeros()
    };
    Transform::from_parts(middle - turn * centred, turn)
}

/// Where a corner is in the picture.
fn at(
    camera: &PinholeCamera,
    pose: &Transform<Camera, Marker>,
    point: &nalgebra::Point3<f64>,
) -> Point2<f64> {
    camera.project(&pose.point(point)).unwrap()
}

proptest! {
    #![proptest_config(config(40))]

    #[test]
    fn a_tag_is_found_to_a_fraction_of_a_pixel(
        seed in 0_u64..1_000_000,
        dictionary in prop::sample::select(vec![
            "4x4_50", "5x5_100", "6x6_250", "7x7_1000", "original", "36h11", "25h9", "16h5",
        ]),
        px in 40.0..110.0,
        blur_px in 0.3..1.2,
        grain in 0.0..4.0,
    ) {
        let known = Dictionary::named(dictionary).unwrap();
        // The first of `original` are nearly all black.
        let id = 5 + (seed % (known.len() as u64 - 5)) as u32;
        let target: Target = format!("aruco:{dictionary}:0.05:{id}").parse().unwrap();
        let camera = camera(1);
        let pose = pose(seed, &target, &camera, px);
        let look = Look { black: 30.0, white: 210.0, around: 120.0, blur_px, noise: grain, seed };
        let image = picture(&target, &pose, &camera, &look);
        let found = detect(&image, target.dictionary());
        prop_assert_eq!(found.iter().map(|m| m.id).collect::<Vec<_>>(), vec![id]);
        let corners = target.corners(id).unwrap();
        for (corner, seen) in corners.iter().zip(&found[0].corners_px) {
            let off = (at(&camera, &pose, corner) - seen).norm();
            prop_assert!(off < 0.15 + 0.03 * grain, "off by {off} px");
        }
    }

}

proptest! {
    #![proptest_config(config(8))]

    #[test]
    fn a_board_tells_its_pose(
        seed in 0_u64..1_000_000,
        text in prop::sample::select(vec![
            "grid:4x4_250:4x3:0.03:0.008", "charuco:5x5_250:5x7:0.03:0.02", "charuco:4x4_50:6x4:0.03:0.022:7",
        ]),
    ) {
        let target: Target = text.parse().unwrap();
        let camera = camera(2);
        let pose = pose(seed, &target, &camera, 26.0);
        let look = Look { black: 20.0, white: 220.0, around: 90.0, blur_px: 0.6, noise: 2.0, seed };
        let image = picture(&target, &pose, &camera, &look);
        let found = target.detect(&image);
        prop_assert!(found.iter().all(|m| target.ids().contains(&m.id)));
        prop_assert!(found.len() >= target.ids().len() - 2, "{} found", found.len());
        let sighting = target.sighting(&image, &found).unwrap();
        for point in &sighting.points {
            let off = (at(&camera, &pose, &point.point_in_marker) - point.pixel).norm();
            prop_assert!(off < 0.45, "off by {off} px");
        }
        let best = planar_poses(&sighting.points, &camera)[0];
        let (metres, radians) = best.camera_from_marker.distance_to(&pose);
        prop_assert!(metres < 0.004 * pose.translation_m().z + 0.001, "{metres} m");
        prop_assert!(radians < 0.02, "{radians} rad");
    }
}

/// Seen flat, a marker's border is narrow across its long edges.
#[test]
fn a_slanted_tag_is_found_as_well() {
    let target: Target = "aruco:4x4_50:0.05:0".parse().unwrap();
    let camera = camera(1);
    for (step, turn) in [0.2, 0.9, 1.7, 2.5].into_iter().enumerate() {
        let rotation = rotation_exp(&(Vector3::x() * 1.15)) * rotation_exp(&(Vector3::z() * turn));
        let pose = Transform::from_parts(Vector3::new(0.01, 0.01, 0.27), rotation);
        let seed = step as u64;
        let look =
            Look { black: 30.0, white: 210.0, around: 120.0, blur_px: 0.4, noise: 1.0, seed };
        let found = detect(&picture(&target, &pose, &camera, &look), target.dictionary());
        let corners = target.corners(0).unwrap();
        for (corner, seen) in corners.iter().zip(&found[0].corners_px) {
            let off = (at(&camera, &pose, corner) - seen).norm();
            assert!(off < 0.4, "turned by {turn}: off by {off} px");
        }
    }
}

#[test]
fn noise_and_stripes_are_no_markers() {
    for name in Dictionary::names() {
        let dictionary = Dictionary::named(name).unwrap();
        for seed in 0..3 {
            let blocks = |at: usize| {
                let (u, v) = (at % 320 / 16, at / 320 / 16);
                127.0 + 110.0 * noise(seed, (v * 20 + u) as u64) + 15.0 * noise(seed + 9, at as u64)
            };
            let values = (0..320 * 240).map(|at| blocks(at) as u8).collect();
            let image = eyebolt_markers::GreyImage::new(320, 240, values).unwrap();
            assert_eq!(detect(&image, &dictionary), [], "{name}");
        }
    }
}

#[test]
fn tiny_and_plain_pictures_have_none() {
    let dictionary = Dictionary::named("4x4_50").unwrap();
    for (width, height) in [(1, 1), (2, 300), (300, 1), (7, 7)] {
        for value in [0, 255] {
            let values = vec![value; (width * height) as usize];
            let image = eyebolt_markers::GreyImage::new(width, height, values).unwrap();
            assert_eq!(detect(&image, &dictionary), []);
        }
    }
}
