//! Answers without some of the views, against refinements without them.

use crate::refine::{observed, refined, truth};
use crate::synthetic_arm::{ARM, CAMERA, scenes};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::{
    OffsetPrior, Reach, RefineOptions, RefineView, Refinement, Start, Trust, refine, settle,
};
use eyebolt_render::Raster;
use nalgebra::Vector3;

fn rasters(count: usize) -> Vec<Raster> {
    (0..count).map(|_| Raster::new(&CAMERA)).collect()
}

/// Refined on from `full` on all but one of `views`.
fn without(views: &[RefineView<'_>], full: &Refinement, left_out: usize) -> Start {
    let mut kept = views.to_vec();
    kept.remove(left_out);
    let options = RefineOptions {
        iterations: 20,
        reach: Reach::Close,
        trust: Trust::All,
        offset_prior: OffsetPrior::Known(full.offset_prior),
        in_full: false,
    };
    refine(&ARM, &kept, &mut rasters(kept.len()), &full.end(), &options).end()
}

fn millimetres(a: &Transform<Camera, Base>, b: &Transform<Camera, Base>) -> f64 {
    1e3 * a.inverse().distance_to(&b.inverse()).0
}

/// Views of which each saw the arm about a millimetre off, in a direction of its own: without it, the
/// answer is another.
#[test]
fn two_newton_steps_lead_where_a_refinement_does() {
    let scenes = scenes(&truth(), None);
    let mut views = observed(&scenes);
    let shifts = [[1.0, 0.0, 0.0], [0.0, -1.2, 0.0], [0.0, 0.0, 1.5], [-0.8, 0.8, 0.0]];
    for (view, shift) in views.iter_mut().zip(shifts) {
        let by = Vector3::from(shift.map(|mm: f32| 1e-3 * mm));
        view.arm_points.iter_mut().for_each(|point| *point += by);
    }
    let full = refined(&views, &truth(), Trust::All);
    assert_eq!(full.left_out.len(), views.len());
    assert!(full.groups_left_out.is_empty());
    for (index, left_out) in full.left_out.iter().enumerate() {
        assert_eq!(left_out.views, [index]);
        let exact = without(&views, &full, index).camera_from_base;
        let settled = settle(&ARM, &views, &mut rasters(4), &full, left_out, 1).camera_from_base;
        let moved_mm = millimetres(&exact, &full.camera_from_base);
        let first_mm = millimetres(&left_out.first_step().camera_from_base, &exact);
        let second_mm = millimetres(&settled, &exact);
        assert!(moved_mm > 0.3, "view {index} matters: {moved_mm} mm");
        assert!(first_mm < 0.4 * moved_mm + 0.2, "view {index}: {first_mm} of {moved_mm} mm");
        assert!(second_mm < 0.1 * moved_mm + 0.1, "view {index}: {second_mm} of {moved_mm} mm");
    }
}

/// A view seen twice counts once, so leaving one of the two out changes nothing.
#[test]
fn one_of_two_views_that_show_the_same_can_be_missed() {
    let scenes = scenes(&truth(), None);
    let mut views = observed(&scenes);
    let last = views[3].clone();
    views.push(last);
    let full = refined(&views, &truth(), Trust::All);
    for left_out in [3, 4] {
        let start = full.left_out[left_out].first_step();
        let mm = millimetres(&start.camera_from_base, &full.camera_from_base);
        assert!(mm < 0.02, "{mm} mm");
    }
}

#[test]
fn many_views_are_left_out_in_ten_groups() {
    let scenes = scenes(&truth(), None);
    let four = observed(&scenes);
    let views: Vec<RefineView<'_>> = four.iter().cycle().take(13).cloned().collect();
    let full = refined(&views, &truth(), Trust::All);
    assert_eq!((full.left_out.len(), full.groups_left_out.len()), (13, 10));
    let mut all: Vec<usize> =
        full.groups_left_out.iter().flat_map(|group| group.views.iter().copied()).collect();
    all.sort_unstable();
    assert_eq!(all, (0..13).collect::<Vec<_>>());
}
