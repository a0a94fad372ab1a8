//! Labels of pixels, held against where the kinematics put the links.

use crate::stage::{ARM, Recorded, SENSOR, planned, small};
use eyebolt::simulate::TrueView;
use eyebolt_geometry::RayTable;
use nalgebra::Vector3;

#[test]
fn every_pixel_lies_on_the_link_that_it_says() {
    let plan = planned(small());
    let recorded = Recorded::of_plan(&plan);
    let rays = RayTable::new(&SENSOR.camera());
    let hand = ARM.end_effector_links();
    let joints = recorded.joints();
    // Two frames of each configuration.
    for (index, joints) in joints.iter().step_by(2).enumerate() {
        let TrueView { view, label, link } = plan.true_view(index);
        let poses = ARM.link_poses(joints).unwrap();
        let mut count = [0; 3];
        for (at, (label, link)) in label.iter().zip(&link).enumerate() {
            count[usize::from(*label)] += 1;
            let expected = match link {
                None => TrueView::BACKGROUND,
                Some(link) if hand.contains(link) => TrueView::END_EFFECTOR,
                Some(_) => TrueView::ARM,
            };
            assert_eq!(*label, expected);
            let Some(link) = link else { continue };
            // No link of this arm reaches farther from its joint than this.
            let seen = rays.point(at, view.depth_m[at]).cast::<f64>();
            let in_base = plan.camera_from_base().inverse().point(&seen);
            let in_link = poses[*link].unwrap().inverse().point(&in_base);
            assert!(in_link.coords.norm() < 0.30, "{link}: {in_link}");
            let normal = Vector3::from(view.normal_in_camera[at]);
            assert!((normal.norm() - 1.0).abs() < 1e-5 && normal.dot(&seen.coords.cast()) <= 1e-5);
        }
        // A quarter of a Kinect's pixels; the hand alone is some hundreds.
        assert!(count.iter().all(|count| *count > 100), "{count:?}");
    }
}
