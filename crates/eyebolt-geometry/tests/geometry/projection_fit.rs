use crate::strategies::{config, rotation};
use eyebolt_geometry::{
    Cloud, DepthImage, Distortion, PinholeCamera, ProjectionFitError, fit_projection,
    optical_from_body,
};
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

fn camera() -> impl Strategy<Value = PinholeCamera> {
    let size = (40..320_u32, 30..240_u32);
    // From 106 to 23 degrees across.
    (size, 0.4..2.5_f64, 0.9..1.1_f64, 0.4..0.6_f64, 0.4..0.6_f64).prop_map(
        |((width, height), focal, aspect, cx, cy)| {
            let (w, h) = (f64::from(width), f64::from(height));
            let (fx, fy) = (focal * w, focal * w * aspect);
            PinholeCamera::new(width, height, fx, fy, cx * w, cy * h, Distortion::None).unwrap()
        },
    )
}

/// A bumpy scene seen by `camera`, with every `every`-th pixel missing.
fn scene(camera: &PinholeCamera, every: u32) -> Cloud {
    let (width, height) = (camera.width(), camera.height());
    let depth = |i: u32| {
        let (u, v) = (i % width, i / width);
        let bump = (f64::from(u) * 0.13).sin() * (f64::from(v) * 0.07).cos();
        if i.is_multiple_of(every) { 0.0 } else { (1.5 + bump) as f32 }
    };
    let depth_m = (0..width * height).map(depth).collect();
    DepthImage::new(width, height, depth_m).unwrap().unproject(camera).unwrap()
}

/// Largest error of `fx, fy, cx, cy`, pixels.
fn intrinsics_error(a: &PinholeCamera, b: &PinholeCamera) -> f64 {
    [a.fx() - b.fx(), a.fy() - b.fy(), a.cx() - b.cx(), a.cy() - b.cy()]
        .into_iter()
        .fold(0.0, |far, e| e.abs().max(far))
}

fn with_points(cloud: &Cloud, change: impl Fn(usize, Point3<f32>) -> Point3<f32>) -> Cloud {
    let (width, height) = cloud.grid().unwrap();
    let points = cloud.points().iter().enumerate().map(|(i, p)| change(i, *p)).collect();
    Cloud::organised(width, height, points).unwrap()
}

proptest! {
    #![proptest_config(config(96))]

    #[test]
    fn the_camera_and_its_turn_are_found(camera in camera(), turn in rotation(), every in 2..9_u32) {
        let cloud = scene(&camera, every).rotated(&turn.inverse());
        let fit = fit_projection(&cloud).unwrap();
        let away = intrinsics_error(&fit.camera, &camera);
        prop_assert!(away < 2e-3, "{away:e} px");
        let off = (fit.camera_from_cloud * turn.inverse()).angle();
        prop_assert!(off < 1e-6, "{off:e} rad");
        prop_assert!(fit.residual_px < 1e-3, "{:e}", fit.residual_px);
        prop_assert_eq!(fit.camera.width(), camera.width());
    }

    #[test]
    fn a_few_wrong_points_do_no_harm(camera in camera(), turn in rotation()) {
        let cloud = with_points(&scene(&camera, 7), |i, p| {
            if i % 37 == 0 { p + Vector3::new(0.3, -0.2, 0.4) } else { p }
        });
        let fit = fit_projection(&cloud.rotated(&turn.inverse())).unwrap();
        prop_assert!(intrinsics_error(&fit.camera, &camera) < 0.02);
        prop_assert!((fit.camera_from_cloud * turn.inverse()).angle() < 1e-5);
    }

    #[test]
    fn millimetres_of_noise_along_the_ray_do_no_harm(camera in camera(), noise in 0.9..1.1_f32) {
        let cloud = with_points(&scene(&camera, 5), |i, p| if i % 2 == 0 { p * noise } else { p });
        let fit = fit_projection(&cloud).unwrap();
        prop_assert!(intrinsics_error(&fit.camera, &camera) < 2e-3);
    }
}

fn kinect(distortion: Distortion) -> PinholeCamera {
    PinholeCamera::new(960, 540, 540.68, 540.7, 479.75, 269.75, distortion).unwrap()
}

#[test]
fn a_cloud_in_body_axes_is_turned() {
    let body = scene(&kinect(Distortion::None), 3).rotated(&optical_from_body().inverse());
    let fit = fit_projection(&body).unwrap();
    assert!(fit.camera_from_cloud.angle_to(&optical_from_body()) < 1e-7);
    assert!(intrinsics_error(&fit.camera, &kinect(Distortion::None)) < 1e-3);
}

#[test]
fn what_no_pinhole_sees_is_refused() {
    let straight = scene(&kinect(Distortion::None), 3);
    let bent = scene(&kinect(Distortion::plumb_bob([0.2, -0.1, 0.0, 0.0, 0.0])), 3);
    // Depth registered to a colour camera 5 cm aside: the origin is elsewhere.
    let aside = with_points(&straight, |_, p| p + Vector3::new(0.05, 0.0, 0.0));
    for cloud in [bent, aside] {
        let error = fit_projection(&cloud).unwrap_err();
        assert!(matches!(error, ProjectionFitError::NotAPinhole { .. }), "{error}");
    }
}

#[test]
fn a_mirrored_image_is_refused() {
    let mirrored = with_points(&scene(&kinect(Distortion::None), 3), |_, mut p| {
        p.x = -p.x;
        p
    });
    assert_eq!(fit_projection(&mirrored).unwrap_err(), ProjectionFitError::Mirrored);
}

#[test]
fn too_little_is_refused() {
    let cloud = scene(&kinect(Distortion::None), 3);
    let nowhere = Point3::new(f32::NAN, f32::NAN, f32::NAN);
    let part = |keep: fn(usize) -> bool| {
        fit_projection(&with_points(&cloud, |i, p| if keep(i) { p } else { nowhere })).unwrap_err()
    };
    let few = ProjectionFitError::TooFewPoints { valid: 60, required: 100 };
    assert_eq!(part(|i| (1..91).contains(&i)), few);
    assert_eq!(part(|i| i / 960 == 100), ProjectionFitError::Degenerate);
    let loose = Cloud::new(cloud.points().to_vec());
    assert_eq!(fit_projection(&loose).unwrap_err(), ProjectionFitError::NoGrid);
    let same = with_points(&cloud, |_, _| Point3::new(0.1, 0.2, 1.0));
    assert_eq!(fit_projection(&same).unwrap_err(), ProjectionFitError::Degenerate);
    let zeros = with_points(&cloud, |_, _| Point3::origin());
    assert!(matches!(fit_projection(&zeros), Err(ProjectionFitError::TooFewPoints { .. })));
}

#[test]
fn the_same_cloud_gives_the_same_bytes() {
    let cloud = scene(&kinect(Distortion::None), 4);
    let (a, b) = (fit_projection(&cloud).unwrap(), fit_projection(&cloud).unwrap());
    assert_eq!(a.camera, b.camera);
    assert_eq!(a.camera_from_cloud, b.camera_from_cloud);
    assert!(a.camera_from_cloud.angle() < 1e-7);
}
