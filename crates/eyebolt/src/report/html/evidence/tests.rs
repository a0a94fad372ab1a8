//! Laws of what is left over, on a box that a made-up camera sees exactly.

use super::*;
use crate::session::{Background, ImageSource};
use eyebolt_geometry::{DepthImage, Distortion, PinholeCamera, RayTable};
use eyebolt_registration::{
    ArmLink, ArmModel, JointOffsets, LinkModel, MOST_JOINTS, Posture, StopReason,
};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Matrix6, UnitQuaternion, Vector3, Vector6};
use std::sync::{Arc, LazyLock};

/// A box with an edge of 0.3 m about the origin.
static BOX: LazyLock<ArmModel> = LazyLock::new(|| {
    let corner = |i: u32| {
        let side = |bit: u32| if i >> bit & 1 == 1 { 0.15 } else { -0.15 };
        Point3::new(side(0), side(1), side(2))
    };
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = TriangleMesh { vertices: (0..8).map(corner).collect(), triangles };
    let model = Arc::new(LinkModel::build(&mesh));
    ArmModel::new(vec![ArmLink { name: "box".into(), model }])
});

/// One face of the box towards the camera, which is `away_m` from its middle.
fn pose(away_m: f64) -> Transform<Camera, Base> {
    Transform::from_parts(Vector3::new(0.02, -0.01, away_m), UnitQuaternion::identity())
}

/// What the camera sees of the box at 1 m before a wall.
fn session() -> Session {
    let camera =
        PinholeCamera::new(320, 240, 260.0, 260.0, 160.0, 120.0, Distortion::None).unwrap();
    let posture = Posture::new(&BOX, vec![Transform::identity()]);
    let mut raster = Raster::new(&camera);
    raster.draw(&camera, &posture.meshes(&BOX, &pose(1.0)));
    let depth_m = raster.to_depth_image().into_depth_m();
    let walled = depth_m.into_iter().map(|z| if z > 0.0 { z } else { 2.5 }).collect();
    let configuration = Configuration {
        frames: vec!["box".into()],
        depth: DepthImage::new(320, 240, walled).unwrap(),
        mask: None,
        base_from_end_effector: Transform::identity(),
        posture,
    };
    Session {
        background: Background::None,
        rays: RayTable::new(&camera),
        camera,
        optical_from_camera: Transform::identity(),
        source: ImageSource::DepthImages,
        arm: BOX.clone(),
        configurations: vec![configuration],
        assumed_joints: Vec::new(),
        outside_limits: Vec::new(),
        spare_configurations: 0,
    }
}

fn refinement(camera_from_base: Transform<Camera, Base>) -> Refinement {
    Refinement {
        camera_from_base,
        joint_offsets: JointOffsets::default(),
        joint_sigma_rad: [0.0; MOST_JOINTS],
        joint_prior_rad: [1.0; MOST_JOINTS],
        depth_scale: 0.0,
        outline_px: 0.0,
        information: Matrix6::identity(),
        covariance: Matrix6::identity(),
        surface_sigma_m: 0.001,
        outline_sigma_px: 1.0,
        views: Vec::new(),
        iterations: 1,
        last_step: Vector6::zeros(),
        stop: StopReason::Converged,
    }
}

fn at(refinement: &Refinement) -> Leftover {
    leftovers(&session(), refinement).remove(0)
}

#[test]
fn an_exact_pose_leaves_nothing_over() {
    let left = at(&refinement(pose(1.0)));
    assert!(left.surface_mm.len() > 500 && left.outline_px.len() > 200);
    assert!(left.surface_mm.iter().all(|(link, mm)| *link == 0 && mm.abs() < 0.5));
    assert!(left.outline_px.iter().all(|px| px.abs() <= 0.51), "{:?}", left.outline_px);
}

#[test]
fn what_is_seen_behind_a_pose_that_is_too_near_is_positive() {
    for by_mm in [-12.0, 4.0, 8.0] {
        let left = at(&refinement(pose(1.0 - 1e-3 * by_mm)));
        let off = left.surface_mm.iter().map(|(_, mm)| (f64::from(*mm) - by_mm).abs());
        assert!(off.fold(0.0, f64::max) < 0.5, "{by_mm}");
    }
}

#[test]
fn the_depth_that_fits_best_is_what_counts() {
    // As above with the depth's scale to blame, not the pose.
    let left = at(&Refinement { depth_scale: -0.02, ..refinement(pose(1.0)) });
    for (_, mm) in &left.surface_mm {
        // The face is 0.85 m away; its distance along the ray does not matter.
        assert!((mm + 17.0).abs() < 0.6, "{mm}");
    }
}

#[test]
fn a_drawing_that_is_too_large_is_outside_the_outline() {
    // Nearer by 5 %: the outline, 46 pixels from the middle, is 2.7 farther out.
    let left = at(&refinement(pose(0.955)));
    let mean = left.outline_px.iter().sum::<f32>() / left.outline_px.len() as f32;
    assert!((1.5..4.0).contains(&mean), "{mean}");
    let excess = Refinement { outline_px: 1.0, ..refinement(pose(0.955)) };
    let wider = at(&excess).outline_px;
    assert_eq!(wider, left.outline_px.iter().map(|px| px + 1.0).collect::<Vec<_>>());
}
