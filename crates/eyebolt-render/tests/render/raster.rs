use crate::oracle::{away_from_edges, cast_all};
use crate::scene::{
    Object, camera, config, cuboid, lens, pose, posed, rotation, scene, soup, sphere,
};
use eyebolt_geometry::{Distortion, PinholeCamera, Transform};
use eyebolt_render::Raster;
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

fn drawn(camera: &PinholeCamera, objects: &[Object]) -> Raster {
    let mut raster = Raster::new(camera);
    raster.draw(camera, &posed(objects));
    raster
}

/// Everything that a raster says of its pixels.
fn contents(raster: &Raster) -> Vec<Option<(u32, u8)>> {
    let count = raster.width() * raster.height();
    (0..count).map(|at| Some((raster.depth_m(at)?.to_bits(), raster.link(at)?))).collect()
}

/// Where pixels away from edges differ from what their rays hit, `relative` in depth.
fn differences(camera: &PinholeCamera, objects: &[Object], relative: f64) -> Vec<String> {
    let (raster, rays) = (drawn(camera, objects), cast_all(camera, objects));
    let width = raster.width();
    let mut wrong = Vec::new();
    let mut judged = 0;
    for at in 0..rays.len() {
        if !away_from_edges(&rays, width, at % width, at / width) {
            continue;
        }
        judged += 1;
        let seen = raster.depth_m(at).map(|z| (f64::from(z), raster.link(at).unwrap()));
        let same = match (seen, rays[at]) {
            (Some((z, link)), Some((true_z, true_link))) => {
                link == true_link && (z - true_z).abs() <= relative * true_z
            }
            (None, None) => true,
            _ => false,
        };
        if !same {
            wrong.push(format!("{at}: {seen:?}, ray {:?}", rays[at]));
        }
    }
    assert!(judged * 3 > rays.len(), "only {judged} pixels are away from edges");
    wrong
}

proptest! {
    #![proptest_config(config(32))]

    #[test]
    fn a_pixel_sees_what_its_ray_hits_first(objects in scene(0.5..1.8)) {
        let wrong = differences(&camera(Distortion::None), &objects, 1e-4);
        prop_assert!(wrong.is_empty(), "{wrong:?}");
    }

    #[test]
    fn a_pixel_behind_a_lens_sees_what_its_ray_hits_first(
        lens in lens(), pose in pose(0.6..1.5), link in any::<u8>(),
    ) {
        // Triangles of about three pixels: edges are drawn straight.
        let mesh = sphere(0.2, 4);
        let objects = [Object { mesh, camera_from_link: pose, link }];
        let wrong = differences(&camera(lens), &objects, 3e-4);
        prop_assert!(wrong.is_empty(), "{wrong:?}");
    }
}

proptest! {
    #![proptest_config(config(128))]

    #[test]
    fn the_order_of_drawing_does_not_matter(objects in scene(0.5..1.8)) {
        let camera = camera(Distortion::None);
        let backward: Vec<Object> = objects.iter().rev().cloned().collect();
        prop_assert_eq!(contents(&drawn(&camera, &objects)), contents(&drawn(&camera, &backward)));
    }

    #[test]
    fn what_was_drawn_before_leaves_no_trace(
        before in scene(0.3..1.8), now in scene(0.5..1.8),
    ) {
        let camera = camera(Distortion::None);
        let fresh = drawn(&camera, &now);
        let mut used = drawn(&camera, &before);
        for _ in 0..2 {
            used.draw(&camera, &posed(&now));
            prop_assert_eq!(contents(&used), contents(&fresh));
            prop_assert_eq!(used.drawn(), fresh.drawn());
            prop_assert_eq!(used.to_depth_image(), fresh.to_depth_image());
        }
        used.draw(&camera, &[]);
        prop_assert!(contents(&used).iter().all(Option::is_none));
        prop_assert_eq!(used.pixels().count(), 0);
    }

    #[test]
    fn every_way_to_ask_says_the_same(objects in scene(0.5..1.8)) {
        let raster = drawn(&camera(Distortion::None), &objects);
        let image = raster.to_depth_image();
        let (columns, rows) = raster.drawn();
        prop_assert!(columns.end <= 96 && rows.end <= 72);
        let mut seen = Vec::new();
        for (at, depth) in image.depth_m().iter().enumerate() {
            prop_assert_eq!(raster.depth_m(at).unwrap_or(0.0), *depth);
            prop_assert_eq!(raster.link(at).is_some(), *depth > 0.0);
            if *depth > 0.0 {
                prop_assert!(columns.contains(&(at % 96)) && rows.contains(&(at / 96)));
                seen.push(at);
            }
        }
        prop_assert_eq!(raster.pixels().collect::<Vec<_>>(), seen);
    }

    #[test]
    fn a_triangle_is_drawn_from_its_front_only(
        corners in prop::array::uniform3((-0.3..0.3_f64, -0.2..0.2_f64, 0.6..1.5_f64)),
    ) {
        let [a, b, c] = corners.map(|(x, y, z)| Vector3::new(x, y, z));
        let normal = (b - a).cross(&(c - a));
        // Neither edge-on nor too small for a pixel.
        prop_assume!(normal.dot(&a).abs() > 0.01);
        let count = |corners: [Vector3<f64>; 3]| {
            let mesh = soup(&[corners.map(|corner| corner.cast())]);
            let object = Object { mesh, camera_from_link: Transform::identity(), link: 1 };
            drawn(&camera(Distortion::None), &[object]).pixels().count()
        };
        let (front, back) = if normal.dot(&a) < 0.0 {
            ([a, b, c], [a, c, b])
        } else {
            ([a, c, b], [a, b, c])
        };
        prop_assert!(count(front) > 0);
        prop_assert_eq!(count(back), 0);
    }

    #[test]
    fn nothing_behind_the_camera_is_drawn(objects in scene(0.5..1.8), turn in rotation()) {
        let turned = objects.iter().map(|o| {
            let (translation, rotation) = (o.camera_from_link.translation_m(), turn);
            let behind = Vector3::new(translation.x, translation.y, -translation.z);
            Object { camera_from_link: Transform::from_parts(behind, rotation), ..o.clone() }
        });
        let raster = drawn(&camera(Distortion::None), &turned.collect::<Vec<_>>());
        prop_assert_eq!(raster.pixels().count(), 0);
    }

    #[test]
    fn what_surrounds_the_camera_does_no_harm(objects in scene(-0.3..0.3)) {
        let raster = drawn(&camera(Distortion::None), &objects);
        for at in raster.pixels() {
            let z = raster.depth_m(at).unwrap();
            prop_assert!((0.0199..1.0).contains(&z), "{z}");
        }
    }
}

#[test]
fn a_wall_beyond_the_whole_image_fills_it_at_its_depth() {
    let camera = camera(Distortion::None);
    let mesh = cuboid(Vector3::new(40.0, 40.0, 0.5), 1);
    let camera_from_link =
        Transform::from_parts(Vector3::new(3.0, -2.0, 2.25), UnitQuaternion::identity());
    let raster = drawn(&camera, &[Object { mesh, camera_from_link, link: 9 }]);
    assert_eq!(raster.drawn(), (0..96, 0..72));
    for at in 0..96 * 72 {
        assert_eq!(raster.link(at), Some(9));
        assert!((raster.depth_m(at).unwrap() - 2.0).abs() < 2e-4);
    }
}
