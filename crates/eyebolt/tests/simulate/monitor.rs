//! Calibrations that are still true, and some that are not.

use crate::stage::{ARM, CACHE, planned, preset, small};
use eyebolt::monitor::{Known, Monitor, Rate, Suspect, ViewReport, WhyNot};
use eyebolt::observations::Observations;
use eyebolt::record::{RecordOptions, observe};
use eyebolt::simulate::{Plan, Scenario};
use eyebolt_geometry::{Base, Camera, DepthImage, Transform};
use eyebolt_recording::{FrameSource, Range};
use eyebolt_registration::Start;
use eyebolt_robot::JointPositions;
use nalgebra::{Matrix6, Vector6};
use std::sync::LazyLock;

/// Six configurations, and what was seen in them.
struct Seen {
    plan: Plan<'static>,
    observations: Observations,
    views: Vec<(DepthImage, JointPositions)>,
}

static SEEN: LazyLock<Seen> = LazyLock::new(|| {
    let scenario = Scenario { configurations: 6, frames: 1, clutter: 4, ..small() };
    let plan = planned(Scenario { viewpoint: preset("paper-test-p2"), ..scenario });
    let source = plan.in_memory().unwrap();
    let options = RecordOptions { most_configurations: 2, ..RecordOptions::default() };
    let observations = observe(&source, &ARM, &CACHE, &options).unwrap();
    let view = |index: usize| {
        let frame = source.read_frame(index).unwrap();
        let Range::Depth(depth) = frame.range else { panic!("depth is images") };
        (depth, frame.joints)
    };
    let views = (0..source.frame_names().len()).map(view).collect();
    Seen { plan, observations, views }
});

/// A monitor of a calibration that is the truth moved by this, and is sure within half a millimetre and as many mrad.
fn monitor(moved: &Vector6<f64>) -> Monitor<'static> {
    let truth: Transform<Camera, Base> = SEEN.plan.sought_camera_from_base();
    let known = Known {
        start: Start::from(truth.retract(moved)),
        covariance: Matrix6::identity() * 5e-4f64.powi(2),
        workspace_in_base: SEEN.plan.workspace_in_base(),
        residual_m: None,
    };
    Monitor::new(&ARM, &SEEN.observations, known, &Rate::default())
}

fn watched(monitor: &mut Monitor<'_>, joint: Option<(&str, f64)>) -> Vec<ViewReport> {
    let view = |(number, (depth, joints)): (usize, &(DepthImage, JointPositions))| {
        let moved = joints.iter().map(|(name, position)| {
            let by = joint.filter(|(joint, _)| *joint == name).map_or(0.0, |(_, by)| by);
            (name.to_owned(), position + by)
        });
        monitor.see(&number.to_string(), (depth, None), &moved.collect()).unwrap()
    };
    SEEN.views.iter().enumerate().map(view).collect()
}

#[test]
fn what_is_true_raises_no_alarm_and_what_was_seen_before_does_not_count() {
    let mut monitor = monitor(&Vector6::zeros());
    let first = watched(&mut monitor, None);
    assert!(first.iter().all(|report| !report.alarm), "{first:?}");
    let counted = first.iter().filter(|report| report.counts).count();
    assert!(counted >= 4, "{first:?}");
    let evidence = first.last().unwrap().log10_evidence;
    let again = watched(&mut monitor, None);
    assert!(again.iter().all(|r| r.why_not == Some(WhyNot::SeenBefore) || !r.counts), "{again:?}");
    assert_eq!(again.last().unwrap().log10_evidence, evidence);
}

#[test]
fn a_view_of_nothing_neither_counts_nor_resets() {
    let mut monitor = monitor(&Vector6::zeros());
    let before = watched(&mut monitor, None).last().unwrap().log10_evidence;
    let (depth, joints) = &SEEN.views[0];
    let pixels = vec![0.0; depth.depth_m().len()];
    let blind = DepthImage::new(depth.width(), depth.height(), pixels).unwrap();
    let report = monitor.see("blind", (&blind, None), joints).unwrap();
    assert_eq!(report.why_not, Some(WhyNot::TellsNothing));
    assert_eq!(report.log10_evidence, before);
}

#[test]
fn a_degree_is_found_in_three_views_and_measured() {
    let turn = 1f64.to_radians() / 3f64.sqrt();
    let mut monitor = monitor(&Vector6::new(0.0, 0.0, 0.0, turn, -turn, turn));
    let reports = watched(&mut monitor, None);
    assert!(reports[2].alarm, "{reports:?}");
    let last = reports.last().unwrap();
    let drift = last.drift.as_ref().unwrap();
    assert!((drift.rotation_deg - 1.0).abs() < 2.0 * drift.rotation_sigma_deg, "{drift:?}");
    let is_joint = |what: &Suspect| matches!(what, Suspect::JointZero(_));
    assert!(!is_joint(&last.moved[0].what), "{:?}", last.moved);
    let truth = SEEN.plan.sought_camera_from_base();
    let proposed = last.proposed_camera_from_base.as_ref().unwrap();
    let proposed: Transform<Camera, Base> =
        Transform::from_xyzw(proposed.translation_m, proposed.rotation_xyzw).unwrap();
    let (metres, radians) = proposed.distance_to(&truth);
    assert!(metres < 5e-3 && radians < 5e-3, "{metres} {radians}");
}

#[test]
fn a_joint_that_slipped_is_named() {
    let joint = SEEN.observations.arm.joints()[2].name.clone();
    let mut monitor = monitor(&Vector6::zeros());
    let reports = watched(&mut monitor, Some((&joint, 1.5f64.to_radians())));
    let last = reports.last().unwrap();
    assert!(last.alarm, "{reports:?}");
    assert_eq!(last.moved[0].what, Suspect::JointZero(joint), "{:?}", last.moved);
    // It says that it stands farther than it does.
    let by = last.moved[0].joint_deg.unwrap();
    assert!((by + 1.5).abs() < 0.3, "{by}");
}
