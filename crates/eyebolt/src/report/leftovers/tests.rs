//! Laws of what is left over, on a box that a made-up camera sees exactly.

use super::*;
use crate::made_up::{self, BOX, refinement};
use eyebolt_geometry::{Base, Camera, DepthImage, Transform};
use eyebolt_registration::{OUTLINES, Posture, SURFACES};
use nalgebra::{UnitQuaternion, Vector3};

/// One face of the box towards the camera, which is `away_m` from its middle.
fn pose(away_m: f64) -> Transform<Camera, Base> {
    Transform::from_parts(Vector3::new(0.02, -0.01, away_m), UnitQuaternion::identity())
}

/// What the camera sees of the box at 1 m before a wall.
fn observations() -> Observations {
    let camera = made_up::camera(320, 240, 260.0);
    let posture = Posture::new(&BOX, vec![Transform::identity()]);
    let mut raster = Raster::new(&camera);
    raster.draw(&camera, &posture.meshes(&BOX, &pose(1.0)));
    let depth_m = raster.to_depth_image().into_depth_m();
    let walled = depth_m.into_iter().map(|z| if z > 0.0 { z } else { 2.5 }).collect();
    let depth = DepthImage::new(320, 240, walled).unwrap();
    made_up::observations(camera, &BOX, vec![(posture, depth)])
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
