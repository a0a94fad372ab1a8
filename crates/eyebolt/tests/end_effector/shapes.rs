//! Boxes and symmetries of plain shapes.

use crate::gripper::{arm, joints, of, two_fingers};
use eyebolt::end_effector::{EndEffector, EndEffectorError, Symmetry};
use eyebolt::robots::BUILT_IN;
use eyebolt_robot::{Input, JointPositions};

#[test]
fn a_flange_can_be_turned_about_its_axis_and_nobody_sees() {
    let flange = of(&[("0 0 0.02", r#"<cylinder radius="0.04" length="0.04"/>"#)]).unwrap();
    let Symmetry::Axis { axis, through } = flange.symmetry() else {
        panic!("{:?}", flange.symmetry())
    };
    assert!(axis.z.abs() > 0.999, "{axis:?}");
    assert!(through.coords.xy().norm() < 1e-3, "{through}");
}

#[test]
fn a_suction_cup_off_the_middle_has_no_symmetry_and_one_on_it_has_all() {
    let cup = r#"<cylinder radius="0.02" length="0.06"/>"#;
    let body = r#"<cylinder radius="0.05" length="0.04"/>"#;
    let centred = of(&[("0 0 0.02", body), ("0 0 0.07", cup)]).unwrap();
    assert!(matches!(centred.symmetry(), Symmetry::Axis { .. }), "{:?}", centred.symmetry());
    let beside = of(&[("0 0 0.02", body), ("0.025 0.01 0.07", cup)]).unwrap();
    assert_eq!(beside.symmetry(), Symmetry::None);
}

#[test]
fn folds_of_a_prism_are_counted() {
    let box_of = |size: &str| of(&[("0 0 0.05", &format!(r#"<box size="{size}"/>"#))]).unwrap();
    let count = |hand: &EndEffector| match hand.symmetry() {
        Symmetry::Fold { count, .. } => count,
        other => panic!("{other:?}"),
    };
    assert_eq!(count(&box_of("0.06 0.14 0.10")), 2);
    assert_eq!(count(&box_of("0.12 0.12 0.05")), 4);
}

#[test]
fn partners_under_a_symmetry_can_be_exchanged() {
    let hand = of(&[("0 0 0.05", r#"<box size="0.06 0.14 0.10"/>"#)]).unwrap();
    let permutations = hand.keypoint_permutations();
    assert_eq!(permutations.len(), 2);
    let (points, turn) = (hand.keypoints(&JointPositions::default()), hand.symmetry().turns()[0]);
    for (index, partner) in permutations[1].iter().enumerate() {
        assert!((turn * points[index] - points[*partner]).norm() < 1e-3);
    }
}

#[test]
fn fingers_move_the_box() {
    let hand = EndEffector::of(&two_fingers()).unwrap();
    let width = |open: f64| hand.mesh_box(&joints(&[("slide_left", open)])).size_m();
    let palm = width(0.0);
    assert!((palm.y - 0.18).abs() < 1e-6 && (palm.z - 0.11).abs() < 1e-6, "{palm}");
    let long_reach = hand.bounding_box(&joints(&[("slide_left", 0.2)]));
    assert!((long_reach.high.y - 0.205).abs() < 1e-6 && (long_reach.low.y + 0.205).abs() < 1e-6);
}

#[test]
fn the_surface_lies_in_the_box_and_fills_it() {
    for robot in BUILT_IN {
        let hand = EndEffector::of(&robot.arm()).unwrap();
        let joints = JointPositions::default();
        let (about, points) = (hand.mesh_box(&joints), hand.points(&joints, 5000));
        assert_eq!(points.len(), 5000);
        assert!(points.iter().all(|point| about.widened(1e-6).contains(point)), "{}", robot.name);
        let covered = eyebolt::end_effector::BoundingBox::about(points).unwrap();
        assert!((covered.size_m() - about.size_m()).amax() < 0.01, "{}", robot.name);
    }
}

#[test]
fn an_end_effector_without_shape_says_what_to_do() {
    let error = EndEffector::of(&arm("", "", None)).unwrap_err();
    assert!(matches!(error, EndEffectorError::NoShape { .. }));
    assert_eq!(error.input(), Some(Input::END_EFFECTOR));
    let text = error.to_string();
    assert!(text.contains("hand") && text.contains("argument `end_effector`"), "{text}");
}
