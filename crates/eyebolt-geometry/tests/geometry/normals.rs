use crate::strategies::config;
use eyebolt_geometry::{
    Cloud, DepthImage, Distortion, NormalOptions, NormalsError, PinholeCamera, fast_normals,
    normals,
};
use nalgebra::{Point2, Vector3};
use proptest::prelude::*;

const WIDTH: u32 = 40;
const HEIGHT: u32 = 30;

fn camera() -> PinholeCamera {
    PinholeCamera::new(WIDTH, HEIGHT, 60.0, 61.0, 19.3, 14.8, Distortion::None).unwrap()
}

/// What the camera sees of surfaces that give the depth of a ray.
fn seen(depth: impl Fn(u32, &Vector3<f64>) -> f64) -> Cloud {
    let pixels = (0..HEIGHT).flat_map(|v| (0..WIDTH).map(move |u| (u, v)));
    let depth_m = pixels.map(|(u, v)| {
        let ray = camera().ray(&Point2::new(f64::from(u), f64::from(v))).unwrap();
        depth(u, &ray) as f32
    });
    DepthImage::new(WIDTH, HEIGHT, depth_m.collect()).unwrap().unproject(&camera()).unwrap()
}

/// Normals toward the camera, seen at 55 degrees from it at most.
fn facing() -> impl Strategy<Value = Vector3<f64>> {
    (-0.8..0.8_f64, -0.8..0.8_f64).prop_map(|(x, y)| Vector3::new(x, y, -1.0).normalize())
}

fn inside(index: usize, margin: u32) -> bool {
    let (u, v) = (index as u32 % WIDTH, index as u32 / WIDTH);
    (margin..WIDTH - margin).contains(&u) && (margin..HEIGHT - margin).contains(&v)
}

const LOOSE: NormalOptions =
    NormalOptions { radius_px: 2, step_m: 0.02, step_per_m: 0.1, min_share: 0.5 };

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn a_plane_has_its_normal_everywhere(normal in facing(), distance in 0.5..3.0_f64) {
        let cloud = seen(|_, ray| -distance / normal.dot(ray));
        for found in [normals(&cloud, &LOOSE).unwrap(), fast_normals(&cloud, &LOOSE).unwrap()] {
            for (index, found) in found.iter().enumerate().filter(|(i, _)| inside(*i, 2)) {
                let away = (found.cast::<f64>() - normal).norm();
                // Depths are f32 and neighbours a few millimetres to centimetres apart.
                prop_assert!(away < 2e-4, "{index}: {away:e}");
            }
        }
    }

    #[test]
    fn normals_look_at_the_camera_with_length_one(
        bumps in proptest::collection::vec(0.95..1.05_f64, 40), distance in 0.5..3.0_f64,
    ) {
        let cloud = seen(|u, _| distance * bumps[u as usize]);
        for found in [normals(&cloud, &LOOSE).unwrap(), fast_normals(&cloud, &LOOSE).unwrap()] {
            for (normal, point) in found.iter().zip(cloud.points()).filter(|(n, _)| !n.x.is_nan()) {
                prop_assert!(normal.dot(&point.coords) <= 0.0);
                prop_assert!((normal.norm() - 1.0).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn threads_change_no_byte(normal in facing()) {
        let cloud = seen(|_, ray| -1.0 / normal.dot(ray));
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let found = pool.install(|| normals(&cloud, &LOOSE).unwrap());
            found.iter().flatten().map(|c| c.to_bits()).collect::<Vec<_>>()
        };
        prop_assert_eq!(on(1), on(3));
    }
}

#[test]
fn a_depth_edge_is_not_smoothed_over() {
    // A wall at 1 m left of column 20, at 1.5 m right of it.
    let cloud = seen(|u, _| if u < 20 { 1.0 } else { 1.5 });
    let options = NormalOptions::default();
    let (fast, fitted) =
        (fast_normals(&cloud, &options).unwrap(), normals(&cloud, &options).unwrap());
    for index in (0..fast.len()).filter(|i| inside(*i, 2)) {
        let beside_the_edge = [19, 20].contains(&(index as u32 % WIDTH));
        assert_eq!(fast[index].x.is_nan(), beside_the_edge);
        assert!((fitted[index] + Vector3::z()).norm() < 1e-6);
    }
}

#[test]
fn the_step_of_a_surface_grows_with_depth() {
    let options = NormalOptions::default();
    for depth in [0.5_f64, 1.0, 4.0] {
        let limit = f64::from(options.step_m) + f64::from(options.step_per_m) * depth;
        for (share, same_surface) in [(0.95, true), (1.05, false)] {
            let cloud = seen(|u, _| if u < 20 { depth } else { depth + share * limit });
            // Left of the edge, so that its own depth sets the limit.
            let beside_the_edge = 10 * WIDTH as usize + 19;
            let found = fast_normals(&cloud, &options).unwrap()[beside_the_edge];
            assert_eq!(!found.x.is_nan(), same_surface);
            let fitted = normals(&cloud, &options).unwrap()[beside_the_edge];
            assert_eq!((fitted + Vector3::z()).norm() > 1e-3, same_surface);
        }
    }
}

#[test]
fn a_pixel_without_neighbours_has_no_normal() {
    let cloud = seen(|u, _| if u % 2 == 0 { 1.0 } else { 2.0 });
    let options = NormalOptions { radius_px: 1, min_share: 0.3, ..NormalOptions::default() };
    for found in [fast_normals(&cloud, &options).unwrap(), normals(&cloud, &options).unwrap()] {
        // Neighbours on one's own surface lie on a line.
        assert!(found.iter().all(|n| n.x.is_nan()));
    }
    let empty = seen(|_, _| 0.0);
    assert!(normals(&empty, &options).unwrap().iter().all(|n| n.x.is_nan()));
}

#[test]
fn a_cloud_without_grid_is_refused() {
    let cloud = Cloud::new(vec![]);
    assert_eq!(normals(&cloud, &LOOSE), Err(NormalsError::NoGrid));
    assert_eq!(fast_normals(&cloud, &LOOSE), Err(NormalsError::NoGrid));
}
