//! Laws of the overlay picture, on a box that a made-up camera sees.

use eyebolt::depth_noise::DepthNoise;
use eyebolt::observations::{Background, Configuration, ImageSource, Observations};
use eyebolt::report::{Drawn, overlay};
use eyebolt_geometry::{
    Base, Camera, DepthImage, Distortion, Mask, PinholeCamera, RayTable, Transform,
};
use eyebolt_recording::ColorImage;
use eyebolt_registration::{ArmLink, ArmModel, LinkModel, Posture};
use eyebolt_render::Raster;
use eyebolt_robot::TriangleMesh;
use nalgebra::{Point3, UnitQuaternion, Vector3};
use std::sync::{Arc, LazyLock};

/// Its distance field takes a moment.
static MODEL: LazyLock<Arc<LinkModel>> = LazyLock::new(|| Arc::new(LinkModel::build(&cube())));

/// A cube with an edge of 0.4 m about the origin.
fn cube() -> TriangleMesh {
    let corner = |i: u32| {
        let side = |bit: u32| if i >> bit & 1 == 1 { 0.2 } else { -0.2 };
        Point3::new(side(0), side(1), side(2))
    };
    // Faces counter-clockwise from outside.
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    TriangleMesh { vertices: (0..8).map(corner).collect(), triangles }
}

fn camera_from_base() -> Transform<Camera, Base> {
    let turn = UnitQuaternion::from_euler_angles(0.5, 0.7, 0.0);
    Transform::from_parts(Vector3::new(0.1, -0.05, 1.2), turn)
}

/// A observations of one configuration whose depth image shows the cube exactly, before a wall.
fn observations(width: u32, height: u32) -> Observations {
    let focal = 0.8 * f64::from(width);
    let (cx, cy) = (0.5 * f64::from(width), 0.5 * f64::from(height));
    let camera = PinholeCamera::new(width, height, focal, focal, cx, cy, Distortion::None).unwrap();
    let model = MODEL.clone();
    let arm = ArmModel::new(vec![ArmLink { name: "cube".into(), model }]);
    let posture = Posture::new(&arm, vec![Transform::identity()]);
    let mut raster = Raster::new(&camera);
    raster.draw(&camera, &posture.meshes(&arm, &camera_from_base()));
    let depth_m = raster.to_depth_image().into_depth_m();
    let walled = depth_m.into_iter().map(|z| if z > 0.0 { z } else { 2.5 }).collect();
    let configuration = Configuration {
        frames: vec!["cube".into()],
        depth: DepthImage::new(width, height, walled).unwrap(),
        mask: None,
        base_from_end_effector: Transform::identity(),
        posture,
        joints_rad: Vec::new(),
    };
    Observations {
        background: Background::None,
        rays: RayTable::new(&camera),
        camera,
        optical_from_camera: Transform::identity(),
        source: ImageSource::DepthImages,
        arm,
        noise: DepthNoise::learn(&[&configuration.depth]),
        configurations: vec![configuration],
        unplaced_joints: Vec::new(),
        outside_limits: Vec::new(),
        spare_configurations: 0,
        untold_frames: 0,
    }
}

/// The observations with everything that was seen on the cube `by_m` farther.
fn seen_farther(by_m: f32) -> Observations {
    let mut observations = observations(640, 480);
    let depth = &mut observations.configurations[0].depth;
    let moved = depth.depth_m().iter().map(|z| if *z < 2.0 { z + by_m } else { *z }).collect();
    *depth = DepthImage::new(640, 480, moved).unwrap();
    observations
}

fn picture(observations: &Observations, color: Option<&ColorImage>) -> eyebolt::report::Picture {
    let mut raster = Raster::new(&observations.camera);
    let configuration = &observations.configurations[0];
    let drawn = Drawn { configuration, posture: &configuration.posture, color };
    overlay(observations, &drawn, &mut raster, &camera_from_base())
}

/// Colours of the cube well inside its outline.
fn inside(observations: &Observations) -> Vec<[u8; 3]> {
    let mut raster = Raster::new(&observations.camera);
    let posture = &observations.configurations[0].posture;
    raster.draw(&observations.camera, &posture.meshes(&observations.arm, &camera_from_base()));
    let (width, height) = (observations.camera.width(), observations.camera.height());
    let drawn = raster.to_depth_image().depth_m().iter().map(|z| *z > 0.0).collect();
    let clear = Mask::new(width, height, drawn).unwrap().eroded(3);
    let rgb = picture(observations, None).rgb().to_vec();
    let pixels = clear.as_slice().iter().zip(rgb);
    pixels.filter_map(|(clear, rgb)| clear.then_some(rgb)).collect()
}

#[test]
fn it_has_the_cameras_size_whatever_the_colour_picture() {
    for (width, height) in [(1, 1), (7, 5), (320, 240), (641, 479)] {
        let observations = observations(width, height);
        let whole = ColorImage { width: 30, height: 20, rgb: vec![[9, 99, 199]; 600] };
        let short = ColorImage { rgb: vec![[1; 3]; 7], ..whole };
        let none = ColorImage { width: 0, height: 0, rgb: Vec::new() };
        for color in [None, Some(&whole), Some(&short), Some(&none)] {
            let picture = picture(&observations, color);
            assert_eq!((picture.width(), picture.height()), (width, height));
            assert_eq!(picture.rgb().len(), (width * height) as usize);
        }
    }
}

#[test]
fn an_exact_pose_is_grey_inside_its_outline() {
    let pixels = inside(&seen_farther(0.0));
    assert!(pixels.len() > 10_000, "{} pixels", pixels.len());
    for [r, g, b] in pixels {
        assert!(r.abs_diff(g) <= 2 && b.abs_diff(g) <= 2, "{:?}", [r, g, b]);
    }
}

#[test]
fn nearer_is_blue_farther_is_red_and_through_is_striped() {
    for [r, _, b] in inside(&seen_farther(-0.015)) {
        assert!(b > r + 20, "nearer: red {r}, blue {b}");
    }
    for [r, _, b] in inside(&seen_farther(0.015)) {
        assert!(r > b + 20, "farther: red {r}, blue {b}");
    }
    let through = inside(&seen_farther(0.06));
    assert!(through.iter().all(|[r, g, b]| r > &(g + 10) && b > &(g + 10)));
    let strong = through.iter().filter(|[r, g, _]| *r > g.saturating_add(100)).count();
    let share = strong as f64 / through.len() as f64;
    assert!((0.4..0.6).contains(&share), "share of stripes {share}");
}

#[test]
fn farther_shades_grow_with_the_distance_up_to_the_end_of_the_scale() {
    let redness = |by_m: f32| {
        let pixels = inside(&seen_farther(by_m));
        let sum: i64 = pixels.iter().map(|[r, _, b]| i64::from(*r) - i64::from(*b)).sum();
        sum as f64 / pixels.len() as f64
    };
    let shades: Vec<f64> = [0.004, 0.008, 0.016, 0.032, 0.038].map(redness).to_vec();
    assert!(shades[..4].windows(2).all(|pair| pair[0] + 5.0 < pair[1]), "{shades:?}");
    // Only the grey below differs beyond the end.
    assert!((shades[4] - shades[3]).abs() < 2.0, "{shades:?}");
}

#[test]
fn a_mask_has_a_yellow_edge_but_not_along_the_rim_of_the_image() {
    let yellow = |set: Vec<bool>| {
        let mut observations = observations(64, 48);
        observations.configurations[0].mask = Some(Mask::new(64, 48, set).unwrap());
        let picture = picture(&observations, None);
        picture.rgb().iter().map(|rgb| *rgb == [255, 225, 0]).collect::<Vec<bool>>()
    };
    assert!(!yellow(vec![true; 64 * 48]).contains(&true));
    // The left ten columns: their last one is the edge.
    let edge = yellow((0..64 * 48).map(|at| at % 64 < 10).collect());
    let expected: Vec<bool> = (0..64 * 48).map(|at| at % 64 == 9).collect();
    assert_eq!(edge, expected);
}

#[test]
fn the_legend_needs_room() {
    let paper = |observations: &Observations| {
        let picture = picture(observations, None);
        let corner = picture.rgb()[((picture.height() - 1) * picture.width()) as usize];
        corner.iter().all(|c| *c < 20)
    };
    assert!(paper(&observations(640, 480)));
    assert!(!paper(&observations(160, 120)));
}

#[test]
fn a_png_holds_the_same_pixels() {
    let picture = picture(&observations(320, 240), None);
    let bytes = picture.encode_png();
    let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut data).unwrap();
    assert_eq!((info.width, info.height), (320, 240));
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    assert_eq!(data, picture.rgb().as_flattened());
}

#[test]
fn the_bytes_are_the_same_on_any_number_of_threads() {
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| picture(&seen_farther(0.01), None).encode_png())
    };
    assert_eq!(bytes(1), bytes(2));
}
