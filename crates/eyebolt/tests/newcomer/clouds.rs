//! The same recording as clouds.

use crate::recording::{npy_f32, write, write_masks, write_rest};
use crate::run::{
    MASKED, Ran, UNMASKED, WITH_MASKS, WITHOUT_MASKS, difference, folder, run, run_depth, truth,
    try_run,
};
use crate::scene::{CAMERA, Random, Shot, shots};
use eyebolt_geometry::Transform;
use nalgebra::{UnitQuaternion, Vector3};

/// Points of a shot in the optical frame, one for each pixel, NaN where there is no depth.
fn points(shot: &Shot) -> Vec<Vector3<f64>> {
    let width = CAMERA.width() as usize;
    let point = |(at, z): (usize, &f32)| {
        let (u, v, z) = ((at % width) as f64, (at / width) as f64, f64::from(*z));
        let ray =
            Vector3::new((u - CAMERA.cx()) / CAMERA.fx(), (v - CAMERA.cy()) / CAMERA.fy(), 1.0);
        if z > 0.0 { ray * z } else { Vector3::repeat(f64::NAN) }
    };
    shot.depth_m.iter().enumerate().map(point).collect()
}

fn array(shape: &[usize], points: &[Vector3<f64>]) -> Vec<u8> {
    let values: Vec<f32> =
        points.iter().flat_map(|p| [p.x as f32, p.y as f32, p.z as f32]).collect();
    npy_f32(shape, &values)
}

/// Runs organised clouds without a camera, their points mapped by `stored`.
fn run_organised(frame: &str, stored: impl Fn(Vector3<f64>) -> Vector3<f64>, masks: bool) -> Ran {
    let (folder, frames) = (folder(), shots());
    let shape = [CAMERA.height() as usize, CAMERA.width() as usize, 3];
    for (index, shot) in frames.iter().enumerate() {
        let points: Vec<_> = points(shot).into_iter().map(&stored).collect();
        write(folder.path(), &format!("xyz_{index}.npy"), &array(&shape, &points));
    }
    write_masks(folder.path(), &frames);
    let range =
        format!("cloud = \"xyz_{{}}.npy\"\ncloud_frame = \"{frame}\"\nmask = \"mask_{{}}.png\"");
    write_rest(folder.path(), &frames, "", &range);
    run(folder.path(), if masks { WITH_MASKS } else { WITHOUT_MASKS })
}

#[test]
fn organised_clouds_tell_their_camera_and_its_turn() {
    let turn = UnitQuaternion::from_euler_angles(0.2, -0.5, 0.4);
    for (masks, options, bounds) in [(true, WITH_MASKS, MASKED), (false, WITHOUT_MASKS, UNMASKED)] {
        let turned = run_organised("optical", |point| turn * point, masks);
        let depth = run_depth(&shots(), options);
        let cloud_from_optical = Transform::from_parts(Vector3::zeros(), turn);
        let (mm, deg) = difference(&turned.pose(), &(cloud_from_optical * depth.pose()));
        turned.assert_trusted(&(cloud_from_optical * truth()), bounds);
        assert!(mm < 1.0 && deg < 0.1, "{mm} mm, {deg} degrees from the depth images' answer");
        assert_eq!(turned.answer.image_source, Some("organised_clouds"));
        let fitted = turned.answer.intrinsics.unwrap();
        assert!((fitted.fx - CAMERA.fx()).abs() < 0.1, "{fitted:?}");
        assert!((fitted.cy - CAMERA.cy()).abs() < 0.1, "{fitted:?}");
    }
}

#[test]
fn the_body_frame_is_the_optical_frame_by_other_names() {
    // x forward, y left, z up.
    let body = run_organised("body", |p| Vector3::new(p.z, -p.x, -p.y), true);
    let optical = run_organised("optical", |p| p, true);
    assert_eq!(body.answer.to_json(), optical.answer.to_json());
    body.assert_trusted(&truth(), MASKED);
}

#[test]
fn a_bag_of_points_is_enough() {
    let (folder, frames) = (folder(), shots());
    let mut random = Random(99);
    for (index, shot) in frames.iter().enumerate() {
        let mut points = points(shot);
        points.retain(|point| point.z > 0.0);
        // Fisher and Yates.
        for last in (1..points.len()).rev() {
            points.swap(last, (random.next() % (last as u64 + 1)) as usize);
        }
        let bytes = array(&[points.len(), 3], &points);
        write(folder.path(), &format!("xyz_{index}.npy"), &bytes);
    }
    write_rest(folder.path(), &frames, "", "cloud = \"xyz_{}.npy\"\ncloud_frame = \"optical\"");
    let ran = run(folder.path(), WITHOUT_MASKS);
    assert_eq!(ran.answer.image_source, Some("drawn_clouds"));
    assert!(ran.answer.intrinsics.is_none(), "of a camera that nobody has");
    // Drawn on a coarser grid than the camera's: 1.1 mm and 0.03 degrees.
    ran.assert_trusted(&truth(), (5.0, 0.2));
}

#[test]
fn a_cloud_and_mask_of_another_size_are_an_error() {
    let (folder, frames) = (folder(), shots());
    let (width, height) = (CAMERA.width() as usize, CAMERA.height() as usize);
    write_masks(folder.path(), &frames);
    for (index, shot) in frames.iter().enumerate() {
        let mut points = points(shot);
        let mut shape = [height, width, 3];
        if index == 2 {
            // The upper half of the image only, with a mask to fit.
            points.truncate(height / 2 * width);
            shape[0] = height / 2;
            let mut bytes = Vec::new();
            let mut encoder = png::Encoder::new(&mut bytes, CAMERA.width(), CAMERA.height() / 2);
            encoder.set_color(png::ColorType::Grayscale);
            let white = vec![255; points.len()];
            encoder.write_header().unwrap().write_image_data(&white).unwrap();
            write(folder.path(), "mask_2.png", &bytes);
        }
        write(folder.path(), &format!("xyz_{index}.npy"), &array(&shape, &points));
    }
    let range = "cloud = \"xyz_{}.npy\"\ncloud_frame = \"optical\"\nmask = \"mask_{}.png\"";
    write_rest(folder.path(), &frames, "", range);
    let error = try_run(folder.path(), WITH_MASKS).err().unwrap().to_string();
    assert!(error.contains("frame 2") && error.contains("mask"), "{error}");
}

/// Masks belong to pixels, so a grid that tells no camera cannot be used with them, and can without.
#[test]
fn masks_on_a_grid_that_is_no_cameras_can_be_done_without() {
    let (folder, frames) = (folder(), shots());
    let shape = [CAMERA.height() as usize, CAMERA.width() as usize, 3];
    let mut random = Random(7);
    for (index, shot) in frames.iter().enumerate() {
        let mut points = points(shot);
        for last in (1..points.len()).rev() {
            points.swap(last, (random.next() % (last as u64 + 1)) as usize);
        }
        write(folder.path(), &format!("xyz_{index}.npy"), &array(&shape, &points));
    }
    write_masks(folder.path(), &frames);
    let range = "cloud = \"xyz_{}.npy\"\ncloud_frame = \"optical\"\nmask = \"mask_{}.png\"";
    write_rest(folder.path(), &frames, "", range);
    let error = try_run(folder.path(), WITH_MASKS).err().unwrap();
    assert_eq!(error.input(), Some(eyebolt_robot::Input::CAMERA_INFO), "{error}");
    run(folder.path(), WITHOUT_MASKS).assert_trusted(&truth(), (5.0, 0.2));
}
