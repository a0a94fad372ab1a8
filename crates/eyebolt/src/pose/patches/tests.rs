use super::*;
use crate::made_up;
use eyebolt_geometry::DepthImage;
use eyebolt_registration::{ArmModel, Posture};

const WIDTH: usize = 40;
const HEIGHT: usize = 30;
const FOCAL: f64 = 32.0;

/// A rectangle of pixels at one depth: first column, first row, columns, rows, metres.
type Patch = (usize, usize, usize, usize, f32);

/// The middles of these patches, all else being far away and outside the mask.
fn middles_of(patches: &[Patch]) -> Vec<Point3<f32>> {
    let mut depth = vec![9.0; WIDTH * HEIGHT];
    let mut set = vec![false; WIDTH * HEIGHT];
    for (u, v, columns, rows, z) in patches {
        for at in (*v..v + rows).flat_map(|v| (*u..u + columns).map(move |u| v * WIDTH + u)) {
            (depth[at], set[at]) = (*z, true);
        }
    }
    let (width, height) = (WIDTH as u32, HEIGHT as u32);
    let arm = ArmModel::new(Vec::new());
    let depth = DepthImage::new(width, height, depth).unwrap();
    let seen = vec![(Posture::new(&arm, Vec::new()), depth)];
    let observations = made_up::observations(made_up::camera(width, height, FOCAL), &arm, seen);
    let mask = Mask::new(width, height, set).unwrap();
    middles(&observations, &observations.configurations[0], &mask)
}

/// Where the middle of a patch is.
fn middle((u, v, columns, rows, z): Patch) -> Point3<f32> {
    let along = |first: usize, count: usize, centre: f64| {
        let pixel = first as f64 + 0.5 * (count as f64 - 1.0);
        ((pixel - centre) / FOCAL) as f32 * z
    };
    Point3::new(along(u, columns, 0.5 * WIDTH as f64), along(v, rows, 0.5 * HEIGHT as f64), z)
}

#[track_caller]
fn assert_are(found: &[Point3<f32>], expected: &[Point3<f32>]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).norm() < 1e-5, "{found} instead of {expected}");
    }
}

#[test]
fn of_a_single_patch_there_is_one_middle() {
    let patch = (10, 5, 8, 10, 1.2);
    assert_are(&middles_of(&[patch]), &[middle(patch)]);
}

#[test]
fn of_several_the_middle_of_all_comes_first_then_the_largest() {
    let (small, large) = ((2, 3, 5, 4, 1.0), (20, 10, 10, 8, 1.5));
    let all = (20.0 * middle(small).coords + 80.0 * middle(large).coords) / 100.0;
    assert_are(&middles_of(&[small, large]), &[all.into(), middle(large), middle(small)]);
}

#[test]
fn a_step_in_depth_parts_what_is_beside_each_other() {
    let (near, far) = ((5, 5, 10, 10, 1.0), (15, 5, 10, 9, 1.2));
    let found = middles_of(&[near, far]);
    assert_are(&found[1..], &[middle(near), middle(far)]);
    // Depth that grows by less from one pixel to the next is one surface.
    let slope: Vec<Patch> = (0..10).map(|u| (5 + u, 5, 1, 10, 1.0 + 0.04 * u as f32)).collect();
    assert_eq!(middles_of(&slope).len(), 1);
}

#[test]
fn the_end_of_a_row_is_not_beside_the_beginning_of_the_next() {
    let (left, right) = ((0, 4, 6, 10, 1.0), (WIDTH - 6, 3, 6, 10, 1.0));
    let found = middles_of(&[left, right]);
    assert_are(&found[1..], &[middle(right), middle(left)]);
}

#[test]
fn crumbs_and_pixels_without_depth_are_no_patch_of_their_own() {
    let (arm, crumb, hole) = ((5, 5, 20, 10, 1.0), (33, 20, 2, 4, 1.0), (5, 18, 10, 10, 0.0));
    let whole = (200.0 * middle(arm).coords + 8.0 * middle(crumb).coords) / 208.0;
    assert_are(&middles_of(&[arm, crumb, hole]), &[whole.into()]);
    assert!(middles_of(&[hole]).is_empty());
    assert!(middles_of(&[]).is_empty());
}

#[test]
fn no_more_than_the_four_largest_are_looked_at() {
    let patches: Vec<Patch> = (0..6).map(|i| (6 * i, 5, 5, 4 + i, 1.0)).collect();
    let found = middles_of(&patches);
    let largest: Vec<Point3<f32>> = patches[2..].iter().rev().map(|patch| middle(*patch)).collect();
    assert_are(&found[1..], &largest);
}
