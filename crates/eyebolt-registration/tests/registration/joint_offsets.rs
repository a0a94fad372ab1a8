use crate::refine::{observed, refined, starts, truth};
use crate::strategies::config;
use crate::synthetic_arm::{ARM, JOINTS, POSTURES, posture, scenes};
use eyebolt_geometry::Transform;
use eyebolt_registration::{ArmModel, JointOffsets, Posture, RefineView, Refinement, Trust};
use nalgebra::{Isometry3, Point3, Vector3};
use proptest::prelude::*;
use std::sync::LazyLock;

fn offsets(limit: f64) -> impl Strategy<Value = JointOffsets> {
    [-limit..limit, -limit..limit, -limit..limit, -limit..limit].prop_map(joint_offsets)
}

fn joint_offsets([turn, shoulder, elbow, twist]: [f64; 4]) -> JointOffsets {
    JointOffsets { rad: [turn, shoulder, elbow, twist, 0.0, 0.0, 0.0, 0.0], ..Default::default() }
}

/// How far apart two postures have any corner of a cube of 2 m at any link, metres.
fn apart(a: &Posture, b: &Posture) -> f64 {
    let corners = (0..8).map(|corner| {
        Point3::from([1, 2, 4].map(|axis| if corner & axis == 0 { -1.0 } else { 1.0 }))
    });
    let pairs = a.base_from_link().iter().zip(b.base_from_link());
    let distances = pairs.flat_map(|(a, b)| {
        corners.clone().map(|corner| (a.point(&corner) - b.point(&corner)).norm())
    });
    distances.fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn a_moved_posture_is_where_forward_kinematics_has_it(
        joints in [-3.0..3.0_f64, -2.0..2.0_f64, -2.0..2.0_f64, -3.0..3.0_f64], by in offsets(0.5),
    ) {
        let farther = std::array::from_fn(|joint| joints[joint] + by.rad[joint]);
        prop_assert!(apart(&posture(&joints).moved(&ARM, &by), &posture(&farther)) < 1e-12);
    }

    #[test]
    fn moving_twice_is_moving_by_the_sum(a in offsets(0.5), b in offsets(0.5)) {
        let rad = std::array::from_fn(|joint| a.rad[joint] + b.rad[joint]);
        let sum = JointOffsets { rad, ..JointOffsets::default() };
        let twice = POSTURES[1].moved(&ARM, &a).moved(&ARM, &b);
        prop_assert!(apart(&twice, &POSTURES[1].moved(&ARM, &sum)) < 1e-12);
    }
}

/// The arm whose base frame is the one that its first joint refers to.
static AS_TOLD: LazyLock<ArmModel> = LazyLock::new(|| {
    let mut joints = ARM.joints().to_vec();
    joints[0].defines_base = true;
    ArmModel::new(ARM.links().to_vec()).with_joints(joints)
});

proptest! {
    #![proptest_config(config(64))]

    /// Seen from the base that the first joint refers to, its offset turns the foot back and nothing
    /// else: all links together are as forward kinematics has them, in a base turned by that offset.
    #[test]
    fn the_first_joint_turns_what_stands_before_it(
        joints in [-3.0..3.0_f64, -2.0..2.0_f64, -2.0..2.0_f64, -3.0..3.0_f64], by in offsets(0.5),
    ) {
        let farther = std::array::from_fn(|joint| joints[joint] + by.rad[joint]);
        let turned = Isometry3::rotation(Vector3::z() * by.rad[0]);
        let moved = posture(&joints).moved(&AS_TOLD, &by);
        let poses = moved.base_from_link().iter();
        let in_base = poses.map(|pose| Transform::from_isometry(turned * pose.isometry())).collect();
        let moved = Posture::new(&AS_TOLD, in_base);
        prop_assert!(apart(&moved, &posture(&farther)) < 1e-12);
    }

    /// How far a point on the fore arm goes, to first order.
    #[test]
    fn points_move_as_the_links_that_they_are_on(by in offsets(1e-4), x in -0.5..0.5_f64, y in -0.5..0.5_f64) {
        for posture in POSTURES.iter() {
            let (told, on_link) = (posture.base_from_link()[2], Point3::new(x, y, 0.2));
            let moved = posture.moved(&AS_TOLD, &by).base_from_link()[2].point(&on_link);
            let found = posture.moved_by(&AS_TOLD, &by, &told.point(&on_link));
            prop_assert!((moved - told.point(&on_link) - found).norm() < 1e-7);
        }
    }
}

/// The same views a second time show the same errors: nothing is known better.
#[test]
fn views_of_the_same_places_count_once() {
    let scenes = scenes(&truth(), None);
    let once: Vec<RefineView<'_>> = observed(&scenes);
    let twice: Vec<RefineView<'_>> = once.iter().chain(&once).cloned().collect();
    let [once, twice] = [once, twice].map(|views| refined(&views, &truth(), Trust::All));
    let off = (twice.information - once.information).norm() / once.information.norm();
    assert!(off < 1e-6, "information of the same views twice is off by {off}");
    let off = (twice.covariance - once.covariance).norm() / once.covariance.norm();
    assert!(off < 1e-6, "covariance of the same views twice is off by {off}");
}

/// Joints that are all off, one way or the other.
fn all_off() -> impl Strategy<Value = JointOffsets> {
    let off = (0.3..1.5_f64, any::<bool>())
        .prop_map(|(degrees, back)| if back { -degrees } else { degrees }.to_radians());
    [off.clone(), off.clone(), off.clone(), off].prop_map(joint_offsets)
}

/// Where the joints say that the links are, if they stand farther by `by` than they say.
fn told(by: &JointOffsets) -> [Posture; 4] {
    JOINTS.map(|joints| posture(&std::array::from_fn(|joint| joints[joint] - by.rad[joint])))
}

fn refined_with(told: &[Posture; 4]) -> Refinement {
    let scenes = scenes(&truth(), None);
    let mut views: Vec<RefineView<'_>> = observed(&scenes);
    for (view, posture) in views.iter_mut().zip(told) {
        view.view.posture = posture;
    }
    refined(&views, &starts()[0], Trust::All)
}

proptest! {
    #![proptest_config(config(6))]

    /// The foot hardly shows how far the first joint is turned, nor the fore arm how far it is itself:
    /// shoulder and elbow have to come back, and the links' axes to be where they are.
    #[test]
    fn offsets_put_into_the_joints_come_back(by in all_off()) {
        let told = told(&by);
        let outcome = refined_with(&told);
        for joint in [1, 2] {
            let degrees = (outcome.joint_offsets.rad[joint] - by.rad[joint]).to_degrees();
            prop_assert!(degrees.abs() < 0.1, "{degrees} of {}", by.rad[joint].to_degrees());
        }
        for (told, really) in told.iter().zip(&*POSTURES) {
            let found = told.moved(&ARM, &outcome.joint_offsets);
            for (found, really) in found.base_from_link().iter().zip(really.base_from_link()).skip(1) {
                for along in [0.0, 0.3] {
                    let point = Point3::new(0.0, 0.0, along);
                    let found = outcome.camera_from_base.point(&found.point(&point));
                    let away = found - truth().point(&really.point(&point));
                    prop_assert!(away.norm() < 1.5e-3, "{} m", away.norm());
                }
            }
        }
    }
}

#[test]
fn an_arm_without_offsets_is_given_none() {
    let outcome = refined_with(&told(&JointOffsets::default()));
    let largest = outcome.joint_offsets.rad.iter().fold(0.0, |most: f64, rad| most.max(rad.abs()));
    assert!(largest.to_degrees() < 0.02, "{} degrees", largest.to_degrees());
    let prior = outcome.offset_prior.joints_rad;
    assert!(prior.iter().all(|prior| prior.to_degrees() < 0.02), "{prior:?}");
}
