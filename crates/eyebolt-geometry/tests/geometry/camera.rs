use crate::strategies::config;
use eyebolt_geometry::{CameraError, Distortion, PinholeCamera};
use nalgebra::{Point2, Point3, Vector3};
use proptest::prelude::*;

const FIXTURE: &str = include_str!("../fixtures/camera.csv");

fn camera(distortion: Distortion) -> PinholeCamera {
    PinholeCamera::new(640, 480, 520.0, 515.0, 318.3, 242.9, distortion).unwrap()
}

/// Lenses as strong as those of depth cameras, which do not fold inside the image.
fn lens() -> impl Strategy<Value = Distortion> {
    let k = || -0.08..0.15_f64;
    let p = || -0.004..0.004_f64;
    prop_oneof![
        Just(Distortion::None),
        (k(), k(), p(), p(), k())
            .prop_map(|(k1, k2, p1, p2, k3)| Distortion::plumb_bob([k1, k2, p1, p2, k3])),
        (k(), k(), p(), p(), k(), 0.0..0.1_f64, 0.0..0.1_f64).prop_map(
            |(k1, k2, p1, p2, k3, k4, k5)| {
                Distortion::rational_polynomial([k1, k2, p1, p2, k3, k4, k5, 0.02])
            }
        ),
    ]
}

fn pixel() -> impl Strategy<Value = Point2<f64>> {
    (-0.5..639.5_f64, -0.5..479.5_f64).prop_map(|(u, v)| Point2::new(u, v))
}

proptest! {
    #![proptest_config(config(512))]

    #[test]
    fn a_point_on_the_ray_of_a_pixel_falls_on_it(lens in lens(), p in pixel(), z in 0.1..10.0) {
        let camera = camera(lens);
        let ray = camera.ray(&p).unwrap();
        prop_assert_eq!(ray.z, 1.0);
        let seen = camera.project(&Point3::from(ray * z)).unwrap();
        prop_assert!((seen - p).norm() < 1e-10, "{:e}", (seen - p).norm());
    }

    #[test]
    fn the_ray_of_a_projection_leads_to_the_point(lens in lens(), p in pixel(), z in 0.1..10.0) {
        let camera = camera(lens);
        let straight = PinholeCamera::new(640, 480, 520.0, 515.0, 318.3, 242.9, Distortion::None);
        let ray = straight.unwrap().ray(&p).unwrap();
        let back = camera.ray(&camera.project(&Point3::from(ray * z)).unwrap()).unwrap();
        prop_assert!((back - ray).norm() < 1e-11);
    }

    #[test]
    fn the_jacobian_is_the_derivative(lens in lens(), p in pixel(), z in 0.3..5.0) {
        let camera = camera(lens);
        let point = Point3::from(camera.ray(&p).unwrap() * z);
        let (seen, jacobian) = camera.project_with_jacobian(&point).unwrap();
        prop_assert!((seen - camera.project(&point).unwrap()).norm() < 1e-12);
        for axis in 0..3 {
            let step = Vector3::ith(axis, 1e-5);
            let ahead = camera.project(&(point + step)).unwrap();
            let behind = camera.project(&(point - step)).unwrap();
            let numeric = (ahead - behind) / 2e-5;
            let away = (numeric - jacobian.column(axis)).norm();
            prop_assert!(away < 1e-7 * jacobian.norm(), "{away:e}");
        }
    }

    #[test]
    fn a_binned_pixel_is_in_the_middle_of_its_bin(
        lens in lens(), p in pixel(), factor in 1..9_u32,
    ) {
        let (camera, binned) = (camera(lens), camera(lens).scaled(factor).unwrap());
        prop_assert_eq!(binned.width(), 640 / factor);
        prop_assert_eq!(binned.height(), 480 / factor);
        let by = f64::from(factor);
        let in_bins = (p - Point2::new(0.5, 0.5) * (by - 1.0)) / by;
        let (ray, of_bin) = (camera.ray(&p).unwrap(), binned.ray(&in_bins.into()).unwrap());
        prop_assert!((ray - of_bin).norm() < 1e-12);
    }
}

#[test]
fn projects_as_opencv_does() {
    let mut rows = 0;
    for line in FIXTURE.lines().skip(1) {
        let (lens, numbers) = line.split_once(',').unwrap();
        let n: Vec<f64> = numbers.split(',').map(|n| n.parse().unwrap()).collect();
        let d: [f64; 8] = n[4..12].try_into().unwrap();
        let distortion = match lens {
            "none" => Distortion::None,
            "plumb_bob" => Distortion::plumb_bob(d[..5].try_into().unwrap()),
            _ => Distortion::rational_polynomial(d),
        };
        let camera = PinholeCamera::new(640, 480, n[0], n[1], n[2], n[3], distortion).unwrap();
        let seen = camera.project(&Point3::new(n[12], n[13], n[14])).unwrap();
        let expected = Point2::new(n[15], n[16]);
        assert!((seen - expected).norm() < 1e-10, "{line}: {seen}");
        rows += 1;
    }
    assert_eq!(rows, 60);
}

#[test]
fn what_is_not_in_front_is_not_seen() {
    let camera = camera(Distortion::None);
    for z in [0.0, -0.0, -1.0, f64::NAN] {
        assert_eq!(camera.project(&Point3::new(0.1, 0.1, z)), None);
        assert!(camera.project_with_jacobian(&Point3::new(0.1, 0.1, z)).is_none());
    }
}

#[test]
fn a_lens_that_folds_back_shows_nothing_beyond_the_fold() {
    // r (1 - 0.3 r^2) grows up to r = 1.054 and reaches 0.703; at r = 1.8 it is 0.05 again.
    let camera = camera(Distortion::plumb_bob([-0.3, 0.0, 0.0, 0.0, 0.0]));
    assert!(camera.project(&Point3::new(1.04, 0.0, 1.0)).is_some());
    assert_eq!(camera.project(&Point3::new(1.8, 0.0, 1.0)), None);
    assert!(camera.ray(&Point2::new(318.3 + 0.70 * 520.0, 242.9)).is_some());
    assert_eq!(camera.ray(&Point2::new(318.3 + 0.71 * 520.0, 242.9)), None);
}

#[test]
fn coefficients_that_are_zero_are_no_distortion() {
    assert_eq!(*camera(Distortion::plumb_bob([0.0; 5])).distortion(), Distortion::None);
    assert_eq!(*camera(Distortion::rational_polynomial([-0.0; 8])).distortion(), Distortion::None);
}

#[test]
fn numbers_that_make_no_camera_are_refused() {
    let new = |width, f, c, k| {
        PinholeCamera::new(width, 4, f, 5.0, c, 2.0, Distortion::plumb_bob([k; 5])).unwrap_err()
    };
    assert_eq!(new(0, 5.0, 2.0, 0.0), CameraError::Size { width: 0, height: 4 });
    for fx in [0.0, -5.0, f64::INFINITY] {
        assert_eq!(new(4, fx, 2.0, 0.0), CameraError::FocalLength { fx, fy: 5.0 });
    }
    assert!(matches!(new(4, f64::NAN, 2.0, 0.0), CameraError::FocalLength { .. }));
    assert!(matches!(new(4, 5.0, f64::NAN, 0.0), CameraError::PrincipalPoint { .. }));
    assert_eq!(new(4, 5.0, 2.0, f64::NAN), CameraError::Distortion);
    for factor in [0, 481] {
        assert!(matches!(camera(Distortion::None).scaled(factor), Err(CameraError::Factor { .. })));
    }
}
