//! What a frame says of a pose, without any network.

use crate::scene::{SHAPE, Truth, frames};
use eyebolt::pose::{
    Comparison, Judge, Observed, PoseHypothesis, SmoothSurface, Source, half_turns,
    with_translation,
};
use eyebolt::segment::{BACKGROUND, END_EFFECTOR};
use eyebolt_geometry::{DepthImage, Transform};
use nalgebra::Vector3;

fn observed(truth: &Truth) -> Option<Observed> {
    let extent_m = SHAPE.end_effector.extent_m();
    Observed::new(&truth.ideal, &truth.camera, &truth.label, extent_m)
}

#[test]
fn the_true_pose_is_supported_best() {
    let mut seen = 0;
    for truth in frames("paper-test-p1") {
        let Some(observed) = observed(&truth) else { continue };
        seen += 1;
        let posture = SHAPE.posture(&truth.joints);
        let mut judge = Judge::new(&SHAPE, &observed);
        let right = judge.support(&posture, &truth.pose, 0.004);
        assert!(right.cost < 0.12 && right.explained > 0.9, "{right:?}");
        let hypothesis =
            PoseHypothesis { pose: truth.pose, source: Source::Rotation, probability: 1.0 };
        for wrong in half_turns(&SHAPE, &hypothesis) {
            let other = judge.support(&posture, &wrong.pose, 0.004);
            assert!(other.cost > 1.2 * right.cost, "{right:?} {other:?}");
        }
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let moved = Transform::from_parts(
                truth.pose.translation_m() + 0.02 * axis,
                truth.pose.rotation(),
            );
            let other = judge.support(&posture, &moved, 0.004);
            assert!(other.cost > right.cost + 0.1, "{right:?} {other:?}");
        }
    }
    assert!(seen >= 5, "{seen}");
}

/// What stands before a shape hides it, and says nothing against its pose.
#[test]
fn what_is_hidden_does_not_show() {
    let mut seen = 0;
    for mut truth in frames("paper-test-p1") {
        let of_hand = |truth: &Truth| {
            let label = &truth.label;
            (0..label.len()).filter(|at| label[*at] == END_EFFECTOR).collect::<Vec<_>>()
        };
        let hand = of_hand(&truth);
        let posture = SHAPE.posture(&truth.joints);
        let support = |truth: &Truth| {
            let observed = observed(truth)?;
            Some(Judge::new(&SHAPE, &observed).support(&posture, &truth.pose, 0.004))
        };
        let Some(whole) = support(&truth) else { continue };
        // A board before the lower half, nearer by 20 cm.
        let mut depth_m = truth.ideal.depth_m().to_vec();
        for at in &hand[hand.len() / 2..] {
            depth_m[*at] -= 0.2;
            truth.label[*at] = BACKGROUND;
        }
        truth.ideal =
            DepthImage::new(truth.camera.width(), truth.camera.height(), depth_m).unwrap();
        let Some(half) = support(&truth) else { continue };
        seen += 1;
        // Its own arm may hide some of it.
        assert!(whole.shown > 0.6, "{whole:?}");
        assert!((half.shown - 0.5 * whole.shown).abs() < 0.1, "{whole:?} {half:?}");
        assert!(half.cost < whole.cost + 0.1 && half.seen_through < 0.1, "{whole:?} {half:?}");
    }
    assert!(seen >= 4, "{seen}");
}

/// A frame speaks for the true pose against others, as much as it speaks against them for it.
#[test]
fn two_poses_are_compared_alike_either_way() {
    for truth in frames("paper-test-p1") {
        let Some(observed) = observed(&truth) else { continue };
        let posture = SHAPE.posture(&truth.joints);
        let mut judge = Judge::new(&SHAPE, &observed);
        let mut between =
            |a, b| Comparison::between(&mut judge, (&posture, a), (&posture, b), 0.004);
        let itself = between(&truth.pose, &truth.pose);
        assert!(itself.advantage == 0.0 && itself.deviation == 0.0, "{itself:?}");
        let turn = truth.pose.rotation();
        let moved = Transform::from_parts(truth.pose.translation_m() + 0.02 * Vector3::z(), turn);
        let (own, other) = (between(&truth.pose, &moved), between(&moved, &truth.pose));
        assert!(own.advantage > 4.0 * own.deviation, "{own:?}");
        assert!((own.advantage + other.advantage).abs() < 1e-6 * own.advantage);
        assert_eq!((own.deviation, own.pixels), (other.deviation, other.pixels));
    }
}

/// To millimetres; but for what the arm hides of its own hand, which is not drawn.
#[test]
fn the_translation_follows_from_the_rotation() {
    let off = |truth: &Truth| {
        let observed = observed(truth)?;
        let posture = SHAPE.posture(&truth.joints);
        let mut judge = Judge::new(&SHAPE, &observed);
        let rotation = truth.pose.rotation();
        let found = with_translation(&mut judge, &SHAPE, &posture, &observed, rotation);
        Some((found.translation_m() - truth.pose.translation_m()).norm())
    };
    let mut all: Vec<f64> = frames("paper-test-p2").iter().filter_map(off).collect();
    all.sort_by(f64::total_cmp);
    assert!(all[1] < 0.006 && all[all.len() / 2] < 0.015, "{all:?}");
    assert!(all[all.len() - 1] < 0.04, "{all:?}");
}

#[test]
fn too_little_in_view_is_nothing_observed() {
    let truth = frames("paper-test-p1").remove(0);
    let extent_m = SHAPE.end_effector.extent_m();
    let none = vec![0; truth.label.len()];
    assert!(Observed::new(&truth.depth, &truth.camera, &none, extent_m).is_none());
}

/// A hand has corners and steps, and a tube or a ball of the same outline has none: to that it is no matter how well the hand fits.
#[test]
fn a_hand_is_no_smooth_surface() {
    let mut seen = 0;
    for truth in frames("paper-test-p1") {
        let Some(mut observed) = observed(&truth) else { continue };
        seen += 1;
        let posture = SHAPE.posture(&truth.joints);
        let significance = |observed: &Observed| {
            let smooth = SmoothSurface::fit(observed).unwrap();
            let mut judge = Judge::new(&SHAPE, observed);
            let posed = (&posture, &truth.pose);
            Comparison::with_smooth(&mut judge, posed, &smooth, 0.002).significance()
        };
        let hand = significance(&observed);
        let smooth = SmoothSurface::fit(&observed).unwrap();
        let image = &mut observed.image;
        for at in 0..observed.label.len() {
            if observed.label[at] == END_EFFECTOR {
                image.depth_m[at] = smooth.depth_m(image.rays[at]) as f32;
            }
        }
        let other = significance(&observed);
        assert!(hand > 1.7 && other < -1.7, "{hand} {other}");
    }
    assert!(seen >= 5, "{seen}");
}

/// A patch of failed matches on a hand is nothing that the camera saw through it; the scene behind a pose beside the hand is.
#[test]
fn a_failed_match_is_not_seen_through() {
    let mut seen = 0;
    for mut truth in frames("paper-test-p1") {
        let width = truth.camera.width() as usize;
        let label = &truth.label;
        let hand: Vec<usize> = (0..label.len()).filter(|at| label[*at] == END_EFFECTOR).collect();
        // Within its outline.
        let middle = |of: fn(usize, usize) -> usize| {
            let mut all: Vec<usize> = hand.iter().map(|at| of(*at, width)).collect();
            all.sort_unstable();
            let quarter = |part: usize| all.get(part * all.len() / 4).copied();
            Some(quarter(1)?..quarter(3)?)
        };
        let (Some(columns), Some(rows)) = (middle(|at, w| at % w), middle(|at, w| at / w)) else {
            continue;
        };
        let mut depth_m = truth.ideal.depth_m().to_vec();
        let is_patch = |at: &usize| columns.contains(&(at % width)) && rows.contains(&(at / width));
        for at in hand.into_iter().filter(is_patch) {
            depth_m[at] *= 1.1;
            truth.label[at] = BACKGROUND;
        }
        truth.ideal =
            DepthImage::new(truth.camera.width(), truth.camera.height(), depth_m).unwrap();
        let Some(observed) = observed(&truth) else { continue };
        seen += 1;
        let posture = SHAPE.posture(&truth.joints);
        let mut judge = Judge::new(&SHAPE, &observed);
        let mut through = |pose| {
            let support = judge.support(&posture, &pose, 0.004);
            let close = judge.close_support(&posture, &pose, 0.004);
            assert_eq!(support.shown, close.shown);
            (support.seen_through, close.seen_through)
        };
        let (all, close) = through(truth.pose);
        assert!(all > 0.12 && close < 0.03, "{all} {close}");
        let turn = truth.pose.rotation();
        let beside = truth.pose.translation_m() + 0.1 * Vector3::x();
        let (all, close) = through(Transform::from_parts(beside, turn));
        assert!(all > 0.3 && close > 0.8 * all, "{all} {close}");
    }
    assert!(seen >= 5, "{seen}");
}
