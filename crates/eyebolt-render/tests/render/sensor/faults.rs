//! Names, seeds, threads, and cameras that are out of calibration.

use super::wall::{Wall, assert_near, crop, errors_m, mean};
use eyebolt_render::{IntrinsicsError, Random, Sensor, Specimen};

#[test]
fn each_model_is_found_by_its_name() {
    for sensor in Sensor::ALL {
        assert_eq!(sensor.to_string().parse(), Ok(sensor));
        assert!(!sensor.about.is_empty());
    }
    let message = "kinect".parse::<Sensor>().unwrap_err().to_string();
    for name in Sensor::names() {
        assert!(message.contains(name), "{message}");
    }
}

#[test]
fn fields_of_view_are_the_makers() {
    let across_deg = |sensor: Sensor| {
        2.0 * (0.5 * f64::from(sensor.mode.width) / sensor.mode.focal_px).atan().to_degrees()
    };
    assert!((across_deg(Sensor::KINECT_V1) - 57.0).abs() < 1.0);
    assert!((across_deg(Sensor::D435) - 90.0).abs() < 0.1);
    for sensor in Sensor::ALL {
        let camera = sensor.camera();
        assert_eq!((camera.width(), camera.height()), (sensor.mode.width, sensor.mode.height));
    }
}

#[test]
fn the_ideal_sensor_tells_the_view() {
    let camera = crop(&Sensor::IDEAL, 30, 20);
    let view = Wall { z_m: 1.3, tilt_rad: 0.7 }.view(&camera);
    let specimen = Specimen::new(Random::new(3));
    let frame = Sensor::IDEAL.expose(&view, &camera, &[], &specimen).frame(Random::new(9));
    assert_eq!(frame.depth_m(), view.depth_m);
}

/// Bits of a frame, on as many threads.
fn frame(sensor: &Sensor, seed: u64, frame: u64, threads: usize) -> Vec<u32> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let camera = crop(sensor, 120, 90);
        // Half of the image a wall, half a nearer one, a corner of it in the shadow.
        let mut view = Wall { z_m: 1.4, tilt_rad: 0.3 }.view(&camera);
        let near = Wall::facing(0.9).view(&camera).depth_m;
        let mut second_sees = vec![true; view.depth_m.len()];
        for at in 0..view.depth_m.len() {
            if at % 120 > 60 {
                view.depth_m[at] = near[at];
            }
            second_sees[at] = at > 2000 || at % 120 < 40;
        }
        let specimen = Specimen::new(Random::new(seed));
        let exposure = sensor.expose(&view, &camera, &second_sees, &specimen);
        let image = exposure.frame(Random::new(77).at(frame));
        image.depth_m().iter().map(|z| z.to_bits()).collect()
    })
}

#[test]
fn a_frame_depends_on_its_seeds_and_on_nothing_else() {
    for sensor in Sensor::ALL {
        let one = frame(&sensor, 1, 1, 1);
        assert_eq!(one, frame(&sensor, 1, 1, 2), "{sensor} on two threads");
        let differs = sensor != Sensor::IDEAL;
        assert_eq!(one != frame(&sensor, 1, 2, 2), differs, "{sensor}: frames");
        assert_eq!(one != frame(&sensor, 2, 1, 2), differs, "{sensor}: specimens");
    }
}

#[test]
fn a_camera_out_of_calibration_tells_scaled_and_shifted_depth() {
    for sensor in Sensor::ALL {
        let camera = crop(&sensor, 40, 30);
        let wall = Wall::facing(1.5);
        let view = wall.view(&camera);
        let lit = vec![true; view.depth_m.len()];
        let told = |specimen: &Specimen| {
            let exposure = sensor.expose(&view, &camera, &lit, specimen);
            let frames = (0..60).map(|seed| exposure.frame(Random::new(seed)));
            let depths = frames.flat_map(|image| image.into_depth_m()).filter(|z| *z > 0.0);
            mean(&depths.map(f64::from).collect::<Vec<_>>())
        };
        // Over specimens, as their own errors change with what they take for the depth.
        let shifted = |seed: u64| {
            let sound = Specimen::new(Random::new(seed));
            let faulty = Specimen { depth_scale: 1.03, depth_offset_m: 0.02, ..sound };
            told(&faulty) - told(&sound)
        };
        let count = if sensor == Sensor::IDEAL { 1 } else { 12 };
        let found = mean(&(0..count).map(shifted).collect::<Vec<_>>());
        assert_near(found, 0.03 * 1.5 + 0.02, 0.08, sensor.name);
    }
}

#[test]
fn rounding_comes_after_the_fault() {
    // The Kinect tells multiples of 1/8 pixel, whatever it takes the depth for.
    let camera = crop(&Sensor::KINECT_V1, 40, 30);
    let view = Wall::facing(1.5).view(&camera);
    let specimen = Specimen { depth_scale: 1.01, ..Specimen::new(Random::new(2)) };
    let lit = vec![true; view.depth_m.len()];
    let image = Sensor::KINECT_V1.expose(&view, &camera, &lit, &specimen).frame(Random::new(1));
    for z in image.depth_m().iter().filter(|z| **z > 0.0) {
        let eighths = 8.0 * 580.0 * 0.075 / f64::from(*z);
        assert!((eighths - eighths.round()).abs() < 1e-3, "{eighths}");
    }
    // And errors do have a mean: of the fault alone.
    let errors = errors_m(&Sensor::KINECT_V1, &camera, &Wall::facing(1.5), [20, 1]);
    assert!(mean(&errors).abs() < 0.001, "{}", mean(&errors));
}

#[test]
fn stated_intrinsics_are_off_as_asked() {
    let camera = Sensor::D455.camera();
    assert_eq!(IntrinsicsError::NONE.stated(&camera), Ok(camera.clone()));
    let error = IntrinsicsError { focal_scale: [1.02, 0.98], centre_px: [3.0, -2.0] };
    let stated = error.stated(&camera).unwrap();
    let [fx, fy] = [stated.fx() / camera.fx(), stated.fy() / camera.fy()];
    assert!((fx - 1.02).abs() < 1e-12 && (fy - 0.98).abs() < 1e-12);
    assert_eq!([stated.cx() - camera.cx(), stated.cy() - camera.cy()], [3.0, -2.0]);
    assert!(IntrinsicsError { focal_scale: [-1.0, 1.0], ..error }.stated(&camera).is_err());
}
