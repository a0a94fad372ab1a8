use crate::strategies::config;
use eyebolt_geometry::{Cloud, DepthImage, Distortion, ImageError, PinholeCamera, RayTable};
use nalgebra::Point3;
use proptest::collection::vec;
use proptest::prelude::*;

const LENS: [f64; 5] = [0.1, -0.15, 0.002, -0.001, 0.03];

fn camera(distortion: Distortion) -> PinholeCamera {
    PinholeCamera::new(12, 9, 10.5, 10.2, 5.4, 4.1, distortion).unwrap()
}

fn image() -> impl Strategy<Value = DepthImage> {
    let depth = prop_oneof![4 => 0.2..5.0_f32, 1 => Just(0.0), 1 => Just(f32::NAN)];
    vec(depth, 12 * 9).prop_map(|depth_m| DepthImage::new(12, 9, depth_m).unwrap())
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn projecting_what_was_unprojected_gives_the_image(image in image(), lens: bool) {
        let lens = if lens { Distortion::plumb_bob(LENS) } else { Distortion::None };
        let camera = camera(lens);
        let cloud = image.unproject(&camera).unwrap();
        prop_assert_eq!(cloud.grid(), Some((12, 9)));
        prop_assert_eq!(cloud.to_depth_image(&camera), image);
    }

    #[test]
    fn every_pixel_projects_to_itself(image in image()) {
        let camera = camera(Distortion::plumb_bob(LENS));
        let cloud = RayTable::new(&camera).unproject(&image).unwrap();
        for (v, u) in (0..9).flat_map(|v| (0..12).map(move |u| (v, u))) {
            let Some(point) = cloud.at(u, v) else {
                prop_assert_eq!(image.at(u, v), 0.0);
                continue;
            };
            prop_assert_eq!(point.z, image.at(u, v));
            let pixel = camera.project(&point.cast::<f64>()).unwrap();
            let away = (pixel.x - f64::from(u)).hypot(pixel.y - f64::from(v));
            // Rays are f32.
            prop_assert!(away < 5e-6, "{away:e}");
        }
        let share = cloud.count_valid() as f64 / 108.0;
        prop_assert_eq!(image.share_valid(), share);
    }
}

#[test]
fn depths_are_cleaned() {
    let dirty = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -0.0, 1.5];
    let image = DepthImage::new(3, 2, dirty.to_vec()).unwrap();
    let bits: Vec<u32> = image.depth_m().iter().map(|d| d.to_bits()).collect();
    assert_eq!(bits, [0, 0, 0, 0, 0, 1.5_f32.to_bits()]);
    assert_eq!((image.at(2, 1), image.at(3, 0), image.at(0, 2)), (1.5, 0.0, 0.0));
    assert_eq!(image.share_valid(), 1.0 / 6.0);
    assert_eq!(image.into_depth_m().len(), 6);
}

#[test]
fn sizes_must_fit() {
    let size = ImageError::Size { width: 3, height: 2, values: 5 };
    assert_eq!(DepthImage::new(3, 2, vec![1.0; 5]), Err(size));
    assert!(DepthImage::new(0, 0, vec![]).is_err());
    let small = DepthImage::new(3, 2, vec![1.0; 6]).unwrap();
    let error = ImageError::Camera { image: (3, 2), camera: (12, 9) };
    assert_eq!(small.unproject(&camera(Distortion::None)).unwrap_err(), error);
}

#[test]
fn the_nearest_point_wins_and_what_is_outside_is_left_out() {
    let camera = camera(Distortion::None);
    let at = |u: f64, v: f64, z: f64| {
        Point3::from(camera.ray(&nalgebra::Point2::new(u, v)).unwrap() * z).cast::<f32>()
    };
    let behind = Point3::new(0.0, 0.0, -1.0);
    let points =
        [at(3.2, 2.0, 2.0), at(2.8, 2.3, 1.0), at(3.0, 1.6, 3.0), at(11.6, 0.0, 1.0), behind];
    for points in [points.to_vec(), points.into_iter().rev().collect()] {
        let image = Cloud::new(points).to_depth_image(&camera);
        assert_eq!(image.at(3, 2), 1.0);
        assert_eq!(image.share_valid(), 1.0 / 108.0);
    }
}

#[test]
fn a_ray_that_the_lens_does_not_have_is_missing() {
    let camera = camera(Distortion::plumb_bob([-1.5, 0.0, 0.0, 0.0, 0.0]));
    let table = RayTable::new(&camera);
    assert_eq!((table.width(), table.height(), table.rays().len()), (12, 9, 108));
    assert!(table.rays()[0][0].is_nan() && table.rays()[0][1].is_nan());
    let cloud = table.unproject(&DepthImage::new(12, 9, vec![1.0; 108]).unwrap()).unwrap();
    assert!(cloud.at(0, 0).is_none() && cloud.at(5, 4).is_some());
}
