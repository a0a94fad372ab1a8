//! A post before a wall: shadows, fattened and ragged edges, pixels in mid air, corners.

use super::wall::{crop, mean, rms};
use eyebolt_geometry::{Base, Camera, DepthImage, Link, PinholeCamera, Transform};
use eyebolt_render::{Exposure, Random, RayScene, SceneMesh, Sensor, Specimen};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, UnitQuaternion, Vector3};

const POST_M: f64 = 1.0;
const WALL_M: f64 = 2.0;

/// A rectangle in the plane z = 0, its middle at the origin.
fn rectangle(width: f64, height: f64) -> TriangleMesh {
    let corner = |x: f64, y: f64| Point3::new((x * width) as f32, (y * height) as f32, 0.0);
    TriangleMesh {
        vertices: vec![corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)],
        triangles: vec![[0, 2, 1], [0, 3, 2]],
    }
}

fn at(x: f64, y: f64, z: f64) -> Transform<Base, Link> {
    Transform::from_parts(Vector3::new(x, y, z), UnitQuaternion::identity())
}

/// What a specimen makes of a post of `width_px` in the middle of its image, before a wall. The
/// pose of the camera is any: it must not matter.
fn post(sensor: &Sensor, camera: &PinholeCamera, width_px: f64, seed: u64) -> Exposure {
    let wall = rectangle(20.0, 20.0);
    let post = rectangle(width_px / camera.fx() * POST_M, 20.0);
    let base_from_camera = Transform::<Base, Camera>::from_parts(
        Vector3::new(0.3, -0.2, 0.5),
        UnitQuaternion::from_euler_angles(0.4, -1.1, 2.0),
    );
    let placed = |mesh, z: f64| SceneMesh {
        mesh,
        base_from_mesh: Transform::from_isometry(
            base_from_camera.isometry() * at(0.0, 0.0, z).isometry(),
        ),
    };
    let scene = RayScene::new(&[placed(&wall, WALL_M), placed(&post, POST_M)]);
    sensor.look(&scene, camera, &base_from_camera, &Specimen::new(Random::new(seed)))
}

fn is_post(z: f32) -> bool {
    z > 0.0 && (f64::from(z) - POST_M).abs() < 0.15
}

/// First and last column of the post in row `v`.
fn sides(image: &DepthImage, v: u32) -> Option<[f64; 2]> {
    let mut columns = (0..image.width()).filter(|u| is_post(image.at(*u, v)));
    Some([f64::from(columns.next()?), f64::from(columns.next_back()?)])
}

/// Pixels without depth in row `v` between the columns.
fn holes(image: &DepthImage, v: u32, columns: std::ops::Range<u32>) -> f64 {
    columns.filter(|u| image.at(*u, v) == 0.0).count() as f64
}

/// Over rows, frames and specimens: columns of the left and right side of a post, relative to those
/// of the ideal camera, and holes left and right of it.
struct Seen {
    left_px: Vec<f64>,
    right_px: Vec<f64>,
    holes_left: Vec<f64>,
    holes_right: Vec<f64>,
}

fn look_at_post(sensor: &Sensor) -> Seen {
    let camera = crop(sensor, 160, 40);
    let ideal = post(&Sensor::IDEAL, &camera, 40.0, 0).frame(Random::new(0));
    let [left, right] = sides(&ideal, 0).unwrap();
    let mut seen =
        Seen { left_px: vec![], right_px: vec![], holes_left: vec![], holes_right: vec![] };
    for seed in 0..12 {
        let exposure = post(sensor, &camera, 40.0, seed);
        for frame in 0..3 {
            let image = exposure.frame(Random::new(seed).at(frame));
            for v in 8..32 {
                let Some([first, last]) = sides(&image, v) else { continue };
                seen.left_px.push(first - left);
                seen.right_px.push(last - right);
                seen.holes_left.push(holes(&image, v, 25..80));
                seen.holes_right.push(holes(&image, v, 80..145));
            }
        }
    }
    assert!(seen.left_px.len() > 800, "{sensor}: the post is missing");
    seen
}

/// Width of the shadow that a post throws onto the wall, in the image.
fn shadow_px(sensor: &Sensor) -> f64 {
    sensor.camera().fx() * sensor.baseline_m().unwrap() * (1.0 / POST_M - 1.0 / WALL_M)
}

#[test]
fn shadows_lie_to_the_left_and_are_as_wide_as_geometry_says() {
    let kinect = look_at_post(&Sensor::KINECT_V1);
    let shadow = shadow_px(&Sensor::KINECT_V1);
    assert!((shadow - 21.75).abs() < 1e-9);
    assert!((mean(&kinect.holes_left) - shadow).abs() < 1.0, "{}", mean(&kinect.holes_left));
    assert!(mean(&kinect.holes_right) < 0.5, "{}", mean(&kinect.holes_right));
    // Of stereo, the fattened post covers three pixels of it.
    for sensor in [Sensor::D435, Sensor::D455] {
        let seen = look_at_post(&sensor);
        let expected = shadow_px(&sensor) - 3.0;
        assert!((mean(&seen.holes_left) - expected).abs() < 1.0, "{}", mean(&seen.holes_left));
        assert!(mean(&seen.holes_right) < 0.5, "{}", mean(&seen.holes_right));
    }
}

#[test]
fn stereo_fattens_by_half_its_window_and_structured_light_does_not() {
    for (sensor, fat_px) in [(Sensor::KINECT_V1, 0.0), (Sensor::D435, 3.0), (Sensor::D455, 3.0)] {
        let seen = look_at_post(&sensor);
        let (left, right) = (mean(&seen.left_px), mean(&seen.right_px));
        assert!((left + fat_px).abs() < 0.4, "{sensor}: {left}");
        assert!((right - fat_px).abs() < 0.4, "{sensor}: {right}");
    }
}

#[test]
fn zed_fills_shadows_and_outlines_things() {
    let seen = look_at_post(&Sensor::ZED_2I);
    assert!(shadow_px(&Sensor::ZED_2I) > 30.0);
    for holes in [&seen.holes_left, &seen.holes_right] {
        assert!((mean(holes) - 3.0).abs() < 0.7, "{}", mean(holes));
    }
    assert!((mean(&seen.right_px) - 2.0).abs() < 0.4, "{}", mean(&seen.right_px));
}

#[test]
fn edges_of_the_kinect_are_as_ragged_as_nguyen_measured() {
    // 0.8 pixels at angles up to 60 degrees: deviation of the edge from a line.
    let seen = look_at_post(&Sensor::KINECT_V1);
    for side in [&seen.left_px, &seen.right_px] {
        let middle = mean(side);
        let off: Vec<f64> = side.iter().map(|x| x - middle).collect();
        assert!((rms(&off) - 0.8).abs() < 0.12, "{}", rms(&off));
    }
}

#[test]
fn only_time_of_flight_sees_pixels_in_mid_air() {
    for sensor in Sensor::ALL {
        let camera = crop(&sensor, 160, 40);
        let image = post(&sensor, &camera, 40.0, 1).frame(Random::new(1));
        let between = |z: &&f32| (1.2..1.8).contains(&f64::from(**z));
        let count = image.depth_m().iter().filter(between).count();
        let flies = sensor == Sensor::AZURE_KINECT;
        // Two edges of 40 pixels.
        assert_eq!(count >= 40, flies, "{sensor}: {count}");
        assert!(flies || count == 0, "{sensor}: {count}");
    }
}

#[test]
fn rods_thinner_than_a_third_of_the_window_are_lost() {
    for (sensor, lost_px) in [(Sensor::KINECT_V1, 2.0), (Sensor::D435, 1.0)] {
        let camera = crop(&sensor, 160, 40);
        let seen = |width_px: f64| {
            let image = post(&sensor, &camera, width_px, 1).frame(Random::new(1));
            image.depth_m().iter().filter(|z| is_post(**z)).count()
        };
        assert!(seen(lost_px) < 10, "{sensor}: {}", seen(lost_px));
        assert!(seen(3.0 * lost_px) > 60, "{sensor}: {}", seen(3.0 * lost_px));
    }
}

#[test]
fn the_left_edge_of_stereo_is_blind_by_focal_length_times_baseline_over_depth() {
    // Intel RealSense D400 Series Datasheet, "Invalid Depth Band".
    for (sensor, baseline_m) in [(Sensor::D435, 0.050), (Sensor::D455, 0.095)] {
        let camera = crop(&sensor, 160, 30);
        let image = post(&sensor, &camera, 20.0, 2).frame(Random::new(0));
        let blind = mean(&(0..30).map(|v| holes(&image, v, 0..40)).collect::<Vec<_>>());
        let expected = 424.0 * baseline_m / WALL_M;
        assert!((blind - expected).abs() < 1.0, "{sensor}: {blind}, not {expected}");
    }
    // The last eight columns of the Kinect are (Konolige and Mihelich).
    let camera = crop(&Sensor::KINECT_V1, 160, 30);
    let image = post(&Sensor::KINECT_V1, &camera, 20.0, 2).frame(Random::new(0));
    let blind = mean(&(0..30).map(|v| holes(&image, v, 130..160)).collect::<Vec<_>>());
    assert!((blind - 8.0).abs() < 1.0, "{blind}");
}

/// Mean error of depth of specimens without systematic error before a corner of two walls at right
/// angles, its edge at 2 m, near the edge and far from it.
fn corner_m(concave: bool, wavelength_m: f64) -> [f64; 2] {
    let mut sensor = Sensor::AZURE_KINECT;
    if let eyebolt_render::Family::TimeOfFlight(figures) = &mut sensor.family {
        (figures.systematic_m, figures.systematic_growth) = (0.0, 0.0);
        figures.wavelength_m = wavelength_m;
    }
    let camera = crop(&sensor, 400, 120);
    // Walls of 1.4 m that meet at the axis: toward the camera if concave.
    let wall = rectangle(1.4, 2.0);
    let half = if concave { -0.7 } else { 0.7 } / 2.0_f64.sqrt();
    let turned = |side: f64| SceneMesh {
        mesh: &wall,
        base_from_mesh: Transform::from_parts(
            Vector3::new(side * half.abs(), 0.0, 2.0 + half),
            UnitQuaternion::from_euler_angles(
                0.0,
                -side * half.signum() * std::f64::consts::FRAC_PI_4,
                0.0,
            ),
        ),
    };
    let scene = RayScene::new(&[turned(-1.0), turned(1.0)]);
    let pose = Transform::<Base, Camera>::identity();
    let truth = scene.view(&camera, &pose);
    assert!((truth.depth_m[60 * 400 + 200] - 2.0).abs() < 0.02);
    let frame =
        sensor.look(&scene, &camera, &pose, &Specimen::new(Random::new(1))).frame(Random::new(1));
    let mean_of = |columns: std::ops::Range<u32>| {
        let pixels = columns.flat_map(|u| (40..80).map(move |v| (u, v)));
        let seen = pixels.filter(|(u, v)| frame.at(*u, *v) > 0.0);
        let error = |(u, v): (u32, u32)| frame.at(u, v) - truth.depth_m[(v * 400 + u) as usize];
        mean(&seen.map(|pixel| f64::from(error(pixel))).collect::<Vec<_>>())
    };
    [mean_of(150..190), mean_of(60..100)]
}

#[test]
fn light_over_the_other_wall_makes_concave_corners_deeper() {
    // All detours are short against the wave: the more there is of them, the deeper.
    let [near, far] = corner_m(true, 100.0);
    assert!(near > 0.005 && near < 0.1, "{near}");
    assert!(far > 0.0 && far < near, "{far}");
    // Of half a wave, they no longer count.
    let [near, far] = corner_m(true, 1.5);
    assert!(near > 0.003 && near < 0.05, "{near}");
    assert!(far.abs() < 0.2 * near, "{far}");
    let [near, far] = corner_m(false, 1.5);
    assert!(near.abs() < 0.001 && far.abs() < 0.001, "{near} {far}");
}
