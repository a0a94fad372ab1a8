//! Bias and spread of depth against distance and angle, its steps, what neighbours and frames share,
//! and where depth ends.

use super::wall::{Wall, assert_near, crop, errors_m, exposure, mean, rms};
use eyebolt_geometry::DepthImage;
use eyebolt_render::{Family, Random, Sensor};
use std::f64::consts::FRAC_PI_2;

/// RMS over the pixels of a wall of what `published` gives for depth and angle.
fn published_m(
    sensor: &Sensor,
    wall: &Wall,
    size: [u32; 2],
    published: impl Fn(f64, f64) -> f64,
) -> f64 {
    let camera = crop(sensor, size[0], size[1]);
    let view = wall.view(&camera);
    let angles = wall.angles_rad(&camera);
    let pixels = view.depth_m.iter().zip(angles);
    rms(&pixels.map(|(z, angle)| published(f64::from(*z), angle)).collect::<Vec<_>>())
}

fn spread_m(sensor: &Sensor, wall: &Wall, size: [u32; 2], count: [u64; 2]) -> f64 {
    let errors = errors_m(sensor, &crop(sensor, size[0], size[1]), wall, count);
    assert!(!errors.is_empty(), "{sensor} tells nothing of {wall:?}");
    let bias_m = mean(&errors);
    let spread_m = rms(&errors);
    // Nobody found a bias of triangulation on average over cameras and places.
    assert!(bias_m.abs() < 0.25 * spread_m, "{sensor} {wall:?}: bias {bias_m}");
    spread_m
}

fn walls(distances_m: &[f64], tilts_deg: &[f64]) -> Vec<Wall> {
    let tilted =
        |z_m: f64| tilts_deg.iter().map(move |deg| Wall { z_m, tilt_rad: deg.to_radians() });
    distances_m.iter().flat_map(|z_m| tilted(*z_m)).collect()
}

#[test]
fn kinect_noise_grows_with_distance_and_angle_as_nguyen_measured() {
    let sigma_m = |z: f64, angle: f64| {
        0.0012
            + 0.0019 * (z - 0.4).powi(2)
            + 0.0001 / z.sqrt() * angle.powi(2) / (FRAC_PI_2 - angle).powi(2)
    };
    for wall in walls(&[0.8, 1.5, 2.5], &[0.0, 20.0, 40.0, 60.0, 70.0]) {
        let found = spread_m(&Sensor::KINECT_V1, &wall, [48, 40], [40, 2]);
        let published = published_m(&Sensor::KINECT_V1, &wall, [48, 40], sigma_m);
        assert_near(found, published, 0.1, &format!("{wall:?}"));
    }
}

#[test]
fn kinect_noise_of_walls_is_what_khoshelham_measured() {
    // Sensors 12(2), 2012: 1.42e-3 z^2, about 4 cm at the farthest.
    for z_m in [2.0, 3.0, 4.0] {
        let found = spread_m(&Sensor::KINECT_V1, &Wall::facing(z_m), [48, 40], [40, 2]);
        assert_near(found, 1.42e-3 * z_m * z_m, 0.2, &format!("{z_m} m"));
    }
}

#[test]
fn steps_of_the_kinect_are_those_of_khoshelham() {
    // The same article: 2.85e-3 z^2, about 7 cm at 5 m.
    let camera = crop(&Sensor::KINECT_V1, 60, 60);
    for z_m in [1.0, 2.0, 4.7] {
        let exposure = exposure(&Sensor::KINECT_V1, &camera, &Wall::facing(z_m), 3);
        let image = exposure.frame(Random::new(5));
        let mut depths: Vec<f32> = image.depth_m().iter().copied().filter(|z| *z > 0.0).collect();
        depths.sort_by(f32::total_cmp);
        depths.dedup();
        assert!(depths.len() > 2, "{depths:?}");
        for pair in depths.windows(2) {
            let [a, b] = [0, 1].map(|i| f64::from(pair[i]));
            // A step is a whole multiple of the smallest where a depth in between was not told.
            let steps = (b - a) / (2.85e-3 * a * b);
            assert!((steps - steps.round()).abs() < 0.03 * steps && steps > 0.9, "{steps}");
        }
    }
}

#[test]
fn realsense_noise_is_intels_formula() {
    // z^2 subpixel / (f baseline), with 848 pixels over 90 degrees and a subpixel of 0.08.
    for (sensor, baseline_m) in [(Sensor::D435, 0.050), (Sensor::D455, 0.095)] {
        let sigma_m = |z: f64, _: f64| z * z * 0.08 / (424.0 * baseline_m);
        for wall in walls(&[0.5, 1.0, 2.0, 4.0], &[0.0, 20.0, 40.0, 60.0]) {
            let found = spread_m(&sensor, &wall, [48, 40], [30, 2]);
            let published = published_m(&sensor, &wall, [48, 40], sigma_m);
            assert_near(found, published, 0.1, &format!("{sensor} {wall:?}"));
        }
    }
    let found = spread_m(&Sensor::D435, &Wall::facing(2.0), [48, 40], [30, 2]);
    assert!((found - 0.0151).abs() < 0.001, "{found}");
}

#[test]
fn zed_is_off_by_one_per_cent_at_3_m_and_five_at_15() {
    for (z_m, tilt_deg, share) in [(3.0, 0.0, 0.01), (3.0, 40.0, 0.01), (15.0, 0.0, 0.05)] {
        let wall = Wall { z_m, tilt_rad: f64::to_radians(tilt_deg) };
        // Errors of neighbours are the same: only other specimens are another draw.
        let found = spread_m(&Sensor::ZED_2I, &wall, [12, 12], [600, 1]);
        assert_near(found, share * z_m, 0.1, &format!("{wall:?}"));
    }
}

#[test]
fn azure_kinect_keeps_to_microsofts_limits() {
    let sensor = Sensor::AZURE_KINECT;
    let camera = crop(&sensor, 24, 20);
    for wall in walls(&[0.6, 1.5, 3.6], &[0.0, 20.0, 40.0, 60.0]) {
        let (mut biases, mut within) = (Vec::new(), 0);
        let mut noise = Vec::new();
        for seed in 0..150 {
            let exposure = exposure(&sensor, &camera, &wall, seed);
            let truth = wall.view(&camera).depth_m;
            let frames = [1, 2].map(|frame| exposure.frame(Random::new(900 + seed).at(frame)));
            let pairs = frames[0].depth_m().iter().zip(frames[1].depth_m()).zip(&truth);
            for ((a, b), z) in pairs.filter(|((a, b), _)| **a > 0.0 && **b > 0.0) {
                noise.push(f64::from(a - b) / 2.0_f64.sqrt());
                biases.push(f64::from(0.5 * (a + b) - z));
            }
            let bias_m = mean(&errors_of(&frames[0], &truth));
            within += usize::from(bias_m.abs() < 0.011 + 0.001 * wall.z_m);
        }
        // Random error: 17 mm for 15 % of reflectivity at the end of the range, by signal.
        let sigma_m = |z: f64, angle: f64| 0.017 * 0.3 * (z / 3.86).powi(2) / angle.cos();
        let published = published_m(&sensor, &wall, [24, 20], sigma_m);
        assert_near(rms(&noise), published, 0.05, &format!("{wall:?}"));
        assert!(rms(&noise) < 0.017);
        // Systematic error: the limit is three standard deviations.
        assert!(within >= 148, "{wall:?}: {within} of 150 within the limit");
        let limit_m = 0.011 + 0.001 * wall.z_m;
        let fixed_m = (rms(&biases).powi(2) - 0.5 * rms(&noise).powi(2)).sqrt();
        assert_near(fixed_m, limit_m / 3.0, 0.15, &format!("systematic, {wall:?}"));
    }
}

fn errors_of(image: &DepthImage, truth: &[f32]) -> Vec<f64> {
    let seen = image.depth_m().iter().zip(truth).filter(|(z, _)| **z > 0.0);
    seen.map(|(z, truth)| f64::from(z - truth)).collect()
}

#[test]
fn neighbours_share_noise_as_their_windows_overlap() {
    // Half of the window away, half of what is compared is the same.
    for (sensor, half_px, slack) in
        [(Sensor::KINECT_V1, 4.5_f64, 0.1_f64), (Sensor::D455, 3.5, 0.05)]
    {
        let camera = crop(&sensor, 80, 60);
        let wall = Wall::facing(1.2);
        let mut sums = [0.0_f64; 4];
        for seed in 0..30 {
            let truth = wall.view(&camera).depth_m;
            let image = exposure(&sensor, &camera, &wall, seed).frame(Random::new(seed));
            let error = |u: u32, v: u32| {
                f64::from(image.at(u, v)) - f64::from(truth[(v * 80 + u) as usize])
            };
            for (u, v) in (10..40).flat_map(|u| (10..40).map(move |v| (u, v))) {
                let lags = [0, half_px as u32, half_px.ceil() as u32, 4 * half_px as u32];
                for (sum, lag) in sums.iter_mut().zip(lags) {
                    *sum += error(u, v) * error(u + lag, v);
                }
            }
        }
        let [none, below, above, far] = sums;
        let half = 0.5 * (below + above) / none;
        assert!((half - 0.5).abs() < slack, "{sensor}: {half}");
        assert!((far / none).abs() < 0.1, "{sensor}: {}", far / none);
    }
}

#[test]
fn frames_of_a_scene_at_rest_share_their_part_of_the_noise() {
    for sensor in [Sensor::D435, Sensor::D455, Sensor::KINECT_V1] {
        let Family::Triangulation(figures) = sensor.family else { panic!() };
        let camera = crop(&sensor, 48, 40);
        let (mut both, mut alone) = (0.0, 0.0);
        for seed in 0..30 {
            let wall = Wall::facing(1.0 + 0.002 * seed as f64);
            let exposure = exposure(&sensor, &camera, &wall, seed);
            let truth = wall.view(&camera).depth_m;
            let [a, b] = [1, 2].map(|frame| exposure.frame(Random::new(seed).at(frame)));
            let pixels = a.depth_m().iter().zip(b.depth_m()).zip(&truth);
            for ((a, b), z) in pixels.filter(|((a, b), _)| **a > 0.0 && **b > 0.0) {
                both += f64::from((a - z) * (b - z));
                alone += f64::from((a - z) * (a - z));
            }
        }
        let share = both / alone;
        assert!((share - figures.fixed_share).abs() < 0.1, "{sensor}: {share}");
    }
}

#[test]
fn depth_ends_where_the_range_does() {
    for sensor in Sensor::ALL.iter().filter(|sensor| sensor.family != Family::Ideal) {
        let camera = crop(sensor, 200, 12);
        let valid = |z_m: f64| {
            exposure(sensor, &camera, &Wall::facing(z_m), 1).frame(Random::new(1)).share_valid()
        };
        let [nearest, farthest] = sensor.range_m;
        assert_eq!(valid(0.93 * nearest), 0.0, "{sensor} too near");
        assert_eq!(valid(1.3 * farthest), 0.0, "{sensor} too far");
        assert!(valid(2.5 * nearest) > 0.85, "{sensor}: {}", valid(2.5 * nearest));
        assert!(valid(0.8 * farthest) > 0.85, "{sensor}: {}", valid(0.8 * farthest));
    }
}

#[test]
fn walls_seen_at_a_grazing_angle_have_no_depth() {
    // Nguyen et al. have nothing of the Kinect beyond 80 degrees; stereo windows fit no better.
    for sensor in [Sensor::KINECT_V1, Sensor::D435, Sensor::D455] {
        let camera = crop(&sensor, 60, 40);
        let valid = |tilt_deg: f64| {
            let wall = Wall { z_m: 1.5, tilt_rad: tilt_deg.to_radians() };
            exposure(&sensor, &camera, &wall, 1).frame(Random::new(1)).share_valid()
        };
        assert!(valid(60.0) > 0.85, "{sensor}: {}", valid(60.0));
        assert!(valid(86.0) < 0.15, "{sensor}: {}", valid(86.0));
    }
    let camera = crop(&Sensor::AZURE_KINECT, 10, 40);
    let dim = Wall { z_m: 3.5, tilt_rad: 80.0_f64.to_radians() };
    let frame = exposure(&Sensor::AZURE_KINECT, &camera, &dim, 1).frame(Random::new(1));
    assert!(frame.share_valid() < 0.05, "{}", frame.share_valid());
}
