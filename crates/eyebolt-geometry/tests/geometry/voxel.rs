use crate::strategies::config;
use eyebolt_geometry::{VoxelError, voxel_downsample};
use nalgebra::Point3;
use proptest::collection::vec;
use proptest::prelude::*;

fn points() -> impl Strategy<Value = Vec<Point3<f32>>> {
    let axis =
        || prop_oneof![9 => -0.3..0.3_f32, 1 => Just(0.0), 1 => Just(0.05), 1 => Just(f32::NAN)];
    vec([axis(), axis(), axis()].prop_map(Point3::from), 0..300)
}

fn key(point: &Point3<f32>, size: f64) -> [i32; 3] {
    [point.x, point.y, point.z].map(|c| (f64::from(c) / size).floor() as i32)
}

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn every_centroid_is_in_its_voxel(points in points(), size in 0.003..0.2_f64) {
        let voxels = voxel_downsample(&points, size).unwrap();
        for (centroid, expected) in voxels.centroids.iter().zip(&voxels.keys) {
            prop_assert_eq!(key(centroid, size), *expected);
        }
        prop_assert!(voxels.keys.is_sorted_by(|a, b| a < b));
    }

    #[test]
    fn every_point_is_counted_once(points in points(), size in 0.003..0.2_f64) {
        let voxels = voxel_downsample(&points, size).unwrap();
        let mut counts = vec![0; voxels.len()];
        for (point, voxel) in points.iter().zip(&voxels.voxel_of_point) {
            prop_assert_eq!(voxel.is_some(), point.iter().all(|c| c.is_finite()));
            if let Some(voxel) = voxel {
                prop_assert_eq!(voxels.keys[*voxel as usize], key(point, size));
                counts[*voxel as usize] += 1;
            }
        }
        prop_assert_eq!(&counts, &voxels.counts);
        prop_assert_eq!(voxels.is_empty(), counts.is_empty());
    }

    #[test]
    fn again_changes_nothing(points in points(), size in 0.003..0.2_f64) {
        let once = voxel_downsample(&points, size).unwrap();
        let twice = voxel_downsample(&once.centroids, size).unwrap();
        prop_assert_eq!(once.keys, twice.keys);
        prop_assert_eq!(once.centroids, twice.centroids);
    }

    #[test]
    fn the_weighted_mean_stays(points in points(), size in 0.003..0.2_f64) {
        let voxels = voxel_downsample(&points, size).unwrap();
        let all: f64 = points.iter().filter(|p| !p.iter().any(|c| c.is_nan()))
            .map(|p| f64::from(p.x)).sum();
        let weighted: f64 = voxels.centroids.iter().zip(&voxels.counts)
            .map(|(p, count)| f64::from(p.x) * f64::from(*count)).sum();
        // Every centroid is rounded once to f32.
        prop_assert!((all - weighted).abs() < 1e-8 * points.len() as f64);
    }

    #[test]
    fn threads_change_no_byte(points in points(), size in 0.003..0.2_f64) {
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| voxel_downsample(&points, size).unwrap())
        };
        prop_assert_eq!(on(1), on(3));
    }
}

#[test]
fn what_cannot_be_put_into_voxels_is_refused() {
    for size in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(voxel_downsample(&[], size), Err(VoxelError::Size { .. })));
    }
    let far = |x: f32| voxel_downsample(&[Point3::origin(), Point3::new(0.0, x, 0.0)], 1.0);
    let limit = (1 << 20) as f32;
    assert_eq!(far(limit - 0.5).unwrap().keys[1], [0, (1 << 20) - 1, 0]);
    assert_eq!(far(-limit).unwrap().keys[0], [0, -(1 << 20), 0]);
    for x in [limit, -limit - 1.0, f32::MAX, f32::MIN] {
        assert_eq!(far(x), Err(VoxelError::TooFar { index: 1 }));
    }
}

#[test]
fn nothing_gives_no_voxels() {
    assert!(voxel_downsample(&[], 0.01).unwrap().is_empty());
}
