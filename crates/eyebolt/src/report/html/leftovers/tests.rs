//! Laws of what is left over, on a box that a made-up camera sees exactly.

use super::*;
use crate::depth_noise::DepthNoise;
use crate::observations::{Background, ImageSource};
use eyebolt_geometry::{Base, Camera, DepthImage, Distortion, PinholeCamera, RayTable, Transform};
use eyebolt_registration::{
    ArmLink, ArmModel, IntrinsicsOffset, JointOffsets, LinkModel, MOST_JOINTS, OUTLINES,
    OffsetDeviations, Posture, SURFACES, StopReason,
};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Matrix6, Point3, UnitQuaternion, Vector3, Vector6};
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
fn observations() -> Observations {
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
        joints_rad: Vec::new(),
    };
    Observations {
        background: Background::None,
        rays: RayTable::new(&camera),
        camera,
        optical_from_camera: Transform::identity(),
        source: ImageSource::DepthImages,
        arm: BOX.clone(),
        noise: DepthNoise::learn(&[&configuration.depth]),
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
        intrinsics: IntrinsicsOffset::default(),
        doubts: Vec::new(),
        offset_prior: OffsetDeviations::NONE,
        nuisances: [0.0; EVIDENCE_KINDS],
        information: Matrix6::identity(),
        covariance: Matrix6::identity(),
        deviations: [0.001, 1.0],
        views: Vec::new(),
        left_out: Vec::new(),
        groups_left_out: Vec::new(),
        iterations: 1,
        last_step: Vector6::zeros(),
        stop: StopReason::Converged,
    }
}

fn at(refinement: &Refinement) -> Leftover {
    leftovers(&observations(), refinement).remove(0)
}

#[test]
fn an_exact_pose_leaves_nothing_over() {
    let left = at(&refinement(pose(1.0)));
    assert!(left.shown[SURFACES].len() > 500 && left.shown[OUTLINES].len() > 200);
    assert!(left.shown[SURFACES].iter().all(|(link, mm)| *link == 0 && mm.abs() < 0.5));
    assert!(
        left.shown[OUTLINES].iter().all(|(_, px)| px.abs() <= 0.51),
        "{:?}",
        left.shown[OUTLINES]
    );
}

#[test]
fn what_is_seen_behind_a_pose_that_is_too_near_is_positive() {
    for by_mm in [-12.0, 4.0, 8.0] {
        let left = at(&refinement(pose(1.0 - 1e-3 * by_mm)));
        let off = left.shown[SURFACES].iter().map(|(_, mm)| (f64::from(*mm) - by_mm).abs());
        assert!(off.fold(0.0, f64::max) < 0.5, "{by_mm}");
    }
}

#[test]
fn the_depth_that_fits_best_is_what_counts() {
    // As above with the depth's scale to blame, not the pose.
    let left = at(&Refinement { nuisances: [-0.02, 0.0], ..refinement(pose(1.0)) });
    for (_, mm) in &left.shown[SURFACES] {
        // The face is 0.85 m away; its distance along the ray does not matter.
        assert!((mm + 17.0).abs() < 0.6, "{mm}");
    }
}

#[test]
fn a_drawing_that_is_too_large_is_outside_the_outline() {
    // Nearer by 5 %: the outline, 46 pixels from the middle, is 2.7 farther out.
    let left = at(&refinement(pose(0.955)));
    let mean = left.shown[OUTLINES].iter().map(|(_, px)| px).sum::<f32>()
        / left.shown[OUTLINES].len() as f32;
    assert!((1.5..4.0).contains(&mean), "{mean}");
    let excess = Refinement { nuisances: [0.0, 1.0], ..refinement(pose(0.955)) };
    let wider = &at(&excess).shown[OUTLINES];
    for ((_, wider), (_, px)) in wider.iter().zip(&left.shown[OUTLINES]) {
        assert!((wider - px - 1.0).abs() < 1e-4);
    }
}
