use crate::shapes::{cuboid, cylinder, star};
use crate::strategies::{config, isometry, point};
use eyebolt_geometry::{Base, Camera, Link, Transform};
use eyebolt_registration::{ArmLink, ArmModel, LinkModel, Posture};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Isometry3, Point3};
use proptest::prelude::*;
use std::sync::{Arc, LazyLock};

fn link(name: &str, mesh: &TriangleMesh) -> ArmLink {
    ArmLink { name: name.to_owned(), model: Arc::new(LinkModel::build(mesh)) }
}

static ARM: LazyLock<ArmModel> = LazyLock::new(|| {
    ArmModel::new(vec![
        link("box", &cuboid([0.1, 0.05, 0.3], [0.0, 0.0, 0.15])),
        link("round", &cylinder(0.04, 0.2, 24)),
        link("ball", &star(3, |_| 0.06)),
    ])
});

fn posture() -> impl Strategy<Value = Posture> {
    [isometry(0.4), isometry(0.4), isometry(0.4)].prop_map(|poses| {
        Posture::new(&ARM, poses.map(Transform::<Base, Link>::from_isometry).to_vec())
    })
}

/// Distance to each link's field by itself, in double precision up to the field.
fn distances(posture: &Posture, p: &Point3<f32>) -> Vec<f32> {
    let links = ARM.links().iter().zip(posture.base_from_link());
    links
        .map(|(link, pose)| {
            let in_link = pose.inverse().point(&p.cast());
            link.model.field.sample(&in_link.cast()).distance_m
        })
        .collect()
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn nearest_is_the_least_over_all_links(
        posture in posture(), points in prop::collection::vec(point(1.2), 50),
    ) {
        for p in points {
            let nearest = posture.nearest(&ARM, &p).unwrap();
            let each = distances(&posture, &p);
            let least = each.iter().copied().fold(f32::INFINITY, f32::min);
            prop_assert!((nearest.distance_m - least).abs() < 2e-6);
            prop_assert!((each[nearest.link] - least).abs() < 2e-6);
            let pose = posture.base_from_link()[nearest.link];
            let in_link = pose.inverse().point(&p.cast()).cast();
            let gradient = ARM.links()[nearest.link].model.field.sample(&in_link).gradient;
            let in_base = pose.direction(&gradient.cast()).cast::<f32>();
            // In one of a hundred cases rounding takes the neighbouring cell's patch.
            prop_assert!((in_base - nearest.gradient_in_base).norm() < 0.3);
        }
    }

    #[test]
    fn nearest_within_a_limit_is_nearest_or_nothing(
        posture in posture(),
        points in prop::collection::vec((point(0.8), -0.02..0.5_f32, 0..5_usize), 50),
    ) {
        for (p, limit, first) in points {
            let nearest = posture.nearest(&ARM, &p).unwrap();
            match posture.nearest_within(&ARM, &p, limit, first) {
                Some(within) => {
                    prop_assert!(within.distance_m < limit);
                    prop_assert_eq!(within.distance_m, nearest.distance_m);
                    prop_assert_eq!(within.link, nearest.link);
                    prop_assert_eq!(within.gradient_in_base, nearest.gradient_in_base);
                }
                None => prop_assert!(nearest.distance_m >= limit),
            }
        }
    }

    #[test]
    fn the_nearest_surface_moves_with_the_arm(
        posture in posture(), motion in isometry(1.0), p in point(0.6),
    ) {
        let moved = posture.base_from_link().iter().map(|pose| motion * pose.isometry());
        let moved = moved.map(Transform::from_isometry).collect();
        let q: Point3<f32> = (motion * p.cast::<f64>()).cast();
        let before = posture.nearest(&ARM, &p).unwrap();
        let after = Posture::new(&ARM, moved).nearest(&ARM, &q).unwrap();
        prop_assert!((before.distance_m - after.distance_m).abs() < 2e-6);
    }

    #[test]
    fn meshes_are_where_the_camera_has_the_links(
        posture in posture(), camera_from_base in isometry(1.0), p in point(0.2),
    ) {
        let camera_from_base = Transform::<Camera, Base>::from_isometry(camera_from_base);
        let meshes = posture.meshes(&ARM, &camera_from_base);
        prop_assert_eq!(meshes.len(), 3);
        for (index, mesh) in meshes.iter().enumerate() {
            prop_assert_eq!(usize::from(mesh.link), index);
            prop_assert_eq!(mesh.mesh, &ARM.links()[index].model.mesh);
            let in_base = posture.base_from_link()[index].point(&p.cast());
            let in_camera = camera_from_base.point(&in_base);
            prop_assert!((mesh.camera_from_link.point(&p.cast()) - in_camera).norm() < 1e-12);
        }
    }
}

#[test]
fn an_arm_without_links_is_nowhere() {
    let arm = ArmModel::new(Vec::new());
    assert!(Posture::new(&arm, Vec::new()).nearest(&arm, &Point3::origin()).is_none());
}

#[test]
fn a_link_without_triangles_is_never_the_nearest() {
    let empty = link("empty", &TriangleMesh::default());
    let arm = ArmModel::new(vec![empty, ARM.links()[0].clone()]);
    let pose = || Transform::<Base, Link>::from_isometry(Isometry3::translation(0.0, 0.0, 0.1));
    let posture = Posture::new(&arm, vec![pose(), pose()]);
    for p in [Point3::origin(), Point3::new(0.0, 0.0, 0.1), Point3::new(3.0, 1.0, 2.0)] {
        let nearest = posture.nearest(&arm, &p).unwrap();
        assert_eq!(nearest.link, 1);
        assert!(nearest.distance_m.is_finite());
    }
}
