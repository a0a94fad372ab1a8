use crate::strategies::{config, rotation, transform};
use eyebolt_geometry::{Cloud, optical_from_body};
use nalgebra::{Point3, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;

fn points() -> impl Strategy<Value = Vec<Point3<f32>>> {
    let axis = || prop_oneof![9 => -3.0..3.0_f32, 1 => Just(f32::NAN)];
    vec([axis(), axis(), axis()].prop_map(Point3::from), 24)
}

/// Largest distance between points of the same index, which must be missing together.
fn distance(a: &Cloud, b: &Cloud) -> f32 {
    a.points().iter().zip(b.points()).fold(0.0, |far, (a, b)| {
        assert_eq!(a.x.is_nan(), b.x.is_nan());
        far.max((a - b).norm())
    })
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn moving_keeps_the_grid_and_comes_back(points in points(), a in transform(), r in rotation()) {
        let cloud = Cloud::organised(6, 4, points).unwrap();
        let back = cloud.transformed(&a).transformed(&a.inverse());
        prop_assert_eq!(back.grid(), Some((6, 4)));
        // Points up to 8 m away are rounded to f32 twice.
        prop_assert!(distance(&back, &cloud) < 3e-6);
        prop_assert!(distance(&cloud.rotated(&r).rotated(&r.inverse()), &cloud) < 2e-6);
    }

    #[test]
    fn the_box_is_tight_and_holds_the_centroid(points in points()) {
        let cloud = Cloud::new(points);
        let Some(bounds) = cloud.bounding_box() else {
            prop_assert!(cloud.centroid().is_none() && cloud.count_valid() == 0);
            return Ok(());
        };
        let centroid = cloud.centroid().unwrap();
        for axis in 0..3 {
            let inside = |p: &Point3<f32>| (bounds.min[axis]..=bounds.max[axis]).contains(&p[axis]);
            prop_assert!(cloud.valid().all(inside));
            prop_assert!(cloud.valid().any(|p| p[axis] == bounds.min[axis]));
            prop_assert!(cloud.valid().any(|p| p[axis] == bounds.max[axis]));
            prop_assert!(f64::from(bounds.min[axis]) <= centroid[axis] + 1e-12);
            prop_assert!(f64::from(bounds.max[axis]) >= centroid[axis] - 1e-12);
        }
    }

    #[test]
    fn the_centroid_moves_with_the_cloud(points in points(), a in transform()) {
        let cloud = Cloud::new(points);
        let pair = cloud.centroid().zip(cloud.transformed(&a).centroid());
        prop_assert!(pair.is_none_or(|(before, after)| (a.point(&before) - after).norm() < 1e-6));
    }
}

#[test]
fn a_point_is_there_or_missing_altogether() {
    let partly = Point3::new(1.0, f32::INFINITY, 2.0);
    let cloud = Cloud::organised(2, 1, vec![partly, Point3::new(0.0, 0.0, 1.0)]).unwrap();
    assert!(cloud.points()[0].iter().all(|c| c.is_nan()));
    assert_eq!((cloud.at(0, 0), cloud.at(2, 0), cloud.at(0, 1)), (None, None, None));
    assert_eq!(cloud.at(1, 0), Some(&Point3::new(0.0, 0.0, 1.0)));
    assert_eq!(cloud.valid_indexed().map(|(i, _)| i).collect::<Vec<_>>(), [1]);
    assert!(Cloud::new(cloud.into_points()).grid().is_none());
    assert!(Cloud::organised(2, 2, vec![]).is_err());
}

#[test]
fn body_axes_become_optical_axes() {
    let turn = optical_from_body();
    assert_eq!(turn * Vector3::x(), Vector3::z());
    assert_eq!(turn * Vector3::y(), -Vector3::x());
    assert_eq!(turn * Vector3::z(), -Vector3::y());
}

#[test]
fn the_centre_of_a_box_is_its_middle() {
    let corners = vec![Point3::new(-1.0, 0.0, 2.0), Point3::new(3.0, 1.0, 2.0)];
    let bounds = Cloud::new(corners).bounding_box().unwrap();
    assert_eq!(bounds.centre(), Point3::new(1.0, 0.5, 2.0));
}
