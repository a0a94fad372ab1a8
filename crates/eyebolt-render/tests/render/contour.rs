use crate::scene::{Object, config, cuboid, lens, posed, sphere};
use eyebolt_geometry::{Distortion, PinholeCamera, Transform};
use eyebolt_render::{ContourPoint, Raster, contour};
use nalgebra::{Point2, UnitQuaternion, Vector2, Vector3};
use proptest::prelude::*;

/// Small enough that its surface does not fall by a step from one pixel to the next.
const RADIUS_M: f64 = 0.08;
const FOCAL_PX: f64 = 360.0;

fn camera(lens: Distortion) -> PinholeCamera {
    PinholeCamera::new(384, 288, FOCAL_PX, FOCAL_PX, 190.2, 141.1, lens).unwrap()
}

fn ball(centre: Vector3<f64>, link: u8) -> Object {
    let camera_from_link = Transform::from_parts(centre, UnitQuaternion::identity());
    Object { mesh: sphere(RADIUS_M as f32, 5), camera_from_link, link }
}

fn contour_of(camera: &PinholeCamera, objects: &[Object]) -> Vec<ContourPoint> {
    let mut raster = Raster::new(camera);
    raster.draw(camera, &posed(objects));
    contour(&raster, camera)
}

/// Pixels from the outline of a ball, positive outside, and the direction out of it: rays touch the
/// ball at a fixed angle to the one through its centre.
fn from_outline(
    camera: &PinholeCamera,
    centre: &Vector3<f64>,
    pixel: &Point2<f32>,
) -> (f64, Vector2<f64>) {
    let excess = |du: f64, dv: f64| {
        let pixel = pixel.cast::<f64>() + Vector2::new(du, dv);
        let ray = camera.ray(&pixel).expect("a lens that sees its image");
        ray.angle(centre) - (RADIUS_M / centre.norm()).asin()
    };
    let by_u = (excess(0.01, 0.0) - excess(-0.01, 0.0)) / 0.02;
    let by_v = (excess(0.0, 0.01) - excess(0.0, -0.01)) / 0.02;
    let gradient = Vector2::new(by_u, by_v);
    (excess(0.0, 0.0) / gradient.norm(), gradient.normalize())
}

/// Balls of 60 to 100 pixels that lie wholly in the image.
fn centre() -> impl Strategy<Value = Vector3<f64>> {
    (-0.15..0.15_f64, -0.1..0.1_f64, 0.65..1.0_f64).prop_map(|(x, y, z)| Vector3::new(x, y, z))
}

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn the_contour_of_a_ball_is_where_rays_touch_it(
        centre in centre(), lens in prop_oneof![Just(Distortion::None), lens()],
    ) {
        let camera = camera(lens);
        let points = contour_of(&camera, &[ball(centre, 5)]);
        let around = std::f64::consts::TAU * FOCAL_PX * RADIUS_M / centre.z;
        prop_assert!(points.len() as f64 > around, "{} points around {around} px", points.len());
        for point in &points {
            let (away, outward) = from_outline(&camera, &centre, &point.pixel);
            prop_assert!(away.abs() < 0.75, "{away} px from the outline");
            let angle = outward.angle(&point.outward.cast()).to_degrees();
            prop_assert!(angle < 15.0, "{angle} degrees");
            prop_assert!((point.outward.norm() - 1.0).abs() < 1e-5);
            prop_assert_eq!(point.link, 5);
            prop_assert_eq!(point.behind_m, None);
        }
    }

    #[test]
    fn a_contour_point_projects_to_its_pixel_and_lies_on_the_surface(
        centre in centre(), lens in prop_oneof![Just(Distortion::None), lens()],
    ) {
        let camera = camera(lens);
        for point in contour_of(&camera, &[ball(centre, 5)]) {
            let pixel = camera.project(&point.point_in_camera.cast()).unwrap();
            let apart = (pixel - point.pixel.cast()).norm();
            prop_assert!(apart < 1e-3, "{apart} px");
            // Half a pixel off the surface at most, seen at a grazing angle.
            let from_centre = (point.point_in_camera.coords.cast() - centre).norm();
            let pixel_m = centre.z / FOCAL_PX;
            prop_assert!((from_centre - RADIUS_M).abs() < pixel_m, "{from_centre}");
        }
    }

    #[test]
    fn where_one_part_hides_another_the_step_is_reported(centre in centre(), gap in 0.1..0.6_f64) {
        let camera = camera(Distortion::None);
        let wall = Object {
            mesh: cuboid(Vector3::new(9.0, 9.0, 0.1), 1),
            camera_from_link: Transform::from_parts(
                Vector3::new(0.0, 0.0, centre.z + gap + 0.05),
                UnitQuaternion::identity(),
            ),
            link: 2,
        };
        let alone = contour_of(&camera, &[ball(centre, 5)]);
        let before_wall = contour_of(&camera, &[ball(centre, 5), wall]);
        prop_assert_eq!(alone.len(), before_wall.len());
        for (free, hiding) in alone.iter().zip(&before_wall) {
            prop_assert_eq!(ContourPoint { behind_m: None, ..*hiding }, *free);
            let behind = f64::from(hiding.behind_m.unwrap());
            prop_assert!((behind - centre.z - gap).abs() < 1e-3, "{behind}");
        }
    }

    #[test]
    fn the_border_of_the_image_is_no_contour(
        u in 0.0..384.0_f64, v in 0.0..288.0_f64, z in 0.5..1.0_f64,
    ) {
        let camera = camera(Distortion::None);
        let centre = camera.ray(&Point2::new(u, v)).unwrap() * z;
        for point in contour_of(&camera, &[ball(centre, 5)]) {
            let (away, _) = from_outline(&camera, &centre, &point.pixel);
            prop_assert!(away.abs() < 0.75, "{away} px from the outline");
        }
    }
}

#[test]
fn what_fills_the_image_or_is_not_in_it_has_no_contour() {
    let camera = camera(Distortion::None);
    assert!(contour_of(&camera, &[]).is_empty());
    assert!(contour_of(&camera, &[ball(Vector3::new(0.0, 0.0, 0.12), 1)]).is_empty());
    assert!(contour_of(&camera, &[ball(Vector3::new(5.0, 0.0, 1.0), 1)]).is_empty());
}
