//! What honest laboratories have: where it shows, and that nothing else changes.

use crate::stage::{ARM, planned, small};
use eyebolt::simulate::{Faults, Lab, Plan, Scenario, SecondArm, TrueView};
use eyebolt_geometry::DepthImage;
use eyebolt_recording::{FrameSource, Range};
use nalgebra::Point2;

fn lab(lab: Lab) -> Scenario<'static> {
    Scenario { frames: 1, faults: Faults { lab, ..Faults::default() }, ..small() }
}

fn frames(plan: &Plan<'_>) -> Vec<DepthImage> {
    let memory = plan.in_memory().unwrap();
    let depth = |frame| match memory.read_frame(frame).unwrap().range {
        Range::Depth(depth) => depth,
        Range::Cloud(_) => panic!("depth is images"),
    };
    (0..memory.frame_names().len()).map(depth).collect()
}

/// Depths of two images, pixel by pixel.
fn pairs<'a>(a: &'a DepthImage, b: &'a DepthImage) -> impl Iterator<Item = (f32, f32)> + 'a {
    a.depth_m().iter().copied().zip(b.depth_m().iter().copied())
}

fn is_arm(view: &TrueView) -> Vec<bool> {
    view.label.iter().map(|label| *label != TrueView::BACKGROUND).collect()
}

#[test]
fn gloss_is_on_the_arm_alone_and_elsewhere_in_each_configuration() {
    let gloss = 0.3;
    let (right, wrong) =
        (planned(lab(Lab::default())), planned(lab(Lab { gloss, ..Lab::default() })));
    let (right_frames, wrong_frames) = (frames(&right), frames(&wrong));
    for (index, (right_frame, wrong_frame)) in right_frames.iter().zip(&wrong_frames).enumerate() {
        let arm = is_arm(&right.true_view(index));
        let (mut failed, mut holes) = (0, 0);
        for (arm, (right, wrong)) in arm.iter().zip(pairs(right_frame, wrong_frame)) {
            if right != wrong {
                assert!(*arm, "only the arm glosses");
                assert!(
                    wrong == 0.0 || (0.019..0.301).contains(&(wrong - right)),
                    "{wrong} {right}"
                );
                failed += 1;
                holes += usize::from(wrong == 0.0);
            }
        }
        let share = failed as f64 / arm.iter().filter(|arm| **arm).count() as f64;
        assert!((share - gloss).abs() < 0.01, "{share}");
        assert!(holes > 0 && holes < failed, "{holes} of {failed}");
    }
}

#[test]
fn walls_of_a_far_room_are_far() {
    let nearest_wall = |far_room: bool| {
        let plan = planned(lab(Lab { far_room, ..Lab::default() }));
        let walls = plan.solids().iter().filter(|solid| solid.name == "wall");
        let away = walls.map(|wall| {
            let (low, high) = wall.bounds();
            let middle = nalgebra::center(&low, &high);
            f64::from(middle.x.abs().max(middle.y.abs()))
        });
        away.fold(f64::INFINITY, f64::min)
    };
    assert!((1.8..3.5).contains(&nearest_wall(false)));
    assert!((4.0..6.1).contains(&nearest_wall(true)));
}

/// Errors of depth over its square, and of which pixels.
fn relative(right: &DepthImage, wrong: &DepthImage) -> Vec<(usize, f32)> {
    let seen = pairs(right, wrong).enumerate().filter(|(_, (right, _))| *right > 0.0);
    seen.map(|(at, (right, wrong))| (at, (wrong - right) / (right * right))).collect()
}

#[test]
fn wandering_depth_is_smooth_grows_with_its_square_and_changes_with_the_configuration() {
    let wander_m = 0.012;
    let right = frames(&planned(lab(Lab::default())));
    let wrong = frames(&planned(lab(Lab { wander_m, ..Lab::default() })));
    let errors: Vec<_> = right.iter().zip(&wrong).map(|(r, w)| relative(r, w)).collect();
    for errors in &errors {
        let square = errors.iter().map(|(_, error)| f64::from(error * error)).sum::<f64>();
        let rms = (square / errors.len() as f64).sqrt();
        assert!((0.004..0.03).contains(&rms), "{rms}");
        let steps =
            errors.windows(2).filter(|pair| pair[1].0 == pair[0].0 + 1 && pair[1].0 % 320 != 0);
        let steepest = steps.map(|pair| (pair[1].1 - pair[0].1).abs()).fold(0.0, f32::max);
        assert!(steepest < 0.25 * wander_m as f32, "{steepest}");
    }
    let apart = errors[0].iter().zip(&errors[1]).map(|((_, a), (_, b))| (a - b).abs());
    assert!(apart.fold(0.0, f32::max) > wander_m as f32);
}

#[test]
fn a_fixed_pattern_is_the_same_in_every_frame() {
    let with = |fixed_pattern: f64| {
        let plan =
            planned(Scenario { backgrounds: 1, ..lab(Lab { fixed_pattern, ..Lab::default() }) });
        let mut frames = frames(&plan);
        frames.push(plan.in_memory().unwrap().read_background(0).unwrap());
        frames
    };
    let (right, wrong) = (with(0.0), with(1.0));
    let mut patterns = vec![None; 320 * 240];
    let mut largest = 0.0_f32;
    for (right, wrong) in right.iter().zip(&wrong) {
        for (at, error) in relative(right, wrong) {
            let known: f32 = *patterns[at].get_or_insert(error);
            assert!((known - error).abs() < 1e-5, "{at}: {known} {error}");
            largest = largest.max(error.abs());
        }
    }
    // Of a Kinect at 1.5 m.
    let mm = 1e3 * largest * 2.25;
    assert!((5.0..14.0).contains(&mm), "{mm}");
}

#[test]
fn cable_and_cover_are_seen_on_the_arm_and_move_nothing_else() {
    let bare = planned(lab(Lab::default()));
    for more in [Lab { cable: true, ..Lab::default() }, Lab { cover: true, ..Lab::default() }] {
        let dressed = planned(lab(more));
        let mut grown = 0;
        for index in 0..2 {
            let (before, after) = (bare.true_view(index), dressed.true_view(index));
            let nearer = before.view.depth_m.iter().zip(&after.view.depth_m).zip(&after.label);
            for ((before, after), label) in nearer {
                assert!(*after <= before + 1e-5, "parts come before what was there");
                if *after < before - 1e-4 {
                    assert_ne!(*label, TrueView::BACKGROUND);
                    grown += 1;
                }
            }
        }
        assert!(grown > 50, "{more:?}: {grown}");
    }
}

#[test]
fn a_tool_reaches_beyond_the_hand() {
    let farthest = |tool_m: f64| {
        let scenario = lab(Lab { tool_m, ..Lab::default() });
        let camera = scenario.sensor.camera();
        let plan = planned(scenario);
        let memory = plan.in_memory().unwrap();
        let base_from_camera = plan.camera_from_base().inverse();
        let mut farthest = 0.0_f64;
        for index in 0..2 {
            let view = plan.true_view(index);
            let joints = memory.read_joints(index).unwrap();
            let hand = ARM.base_from_end_effector(&joints).unwrap().translation_m();
            for (at, label) in view.label.iter().enumerate() {
                if *label == TrueView::END_EFFECTOR {
                    let pixel = Point2::new((at % 320) as f64, (at / 320) as f64);
                    let ray = camera.ray(&pixel).unwrap() * f64::from(view.view.depth_m[at]);
                    let point = base_from_camera.point(&ray.into());
                    farthest = farthest.max((point.coords - hand).norm());
                }
            }
        }
        farthest
    };
    assert!(farthest(0.0) < 0.15);
    assert!((0.2..0.35).contains(&farthest(0.2)), "{}", farthest(0.2));
}

/// Pixels that see the background in both of two configurations, and see it at different depths.
fn changed(plan: &Plan<'_>) -> usize {
    let [a, b] = [0, 1].map(|index| plan.true_view(index));
    let both = is_arm(&a).into_iter().zip(is_arm(&b)).map(|(a, b)| !a && !b);
    let depths = a.view.depth_m.iter().zip(&b.view.depth_m);
    both.zip(depths).filter(|(both, (a, b))| *both && (**a - **b).abs() > 0.02).count()
}

#[test]
fn people_and_rooms_change_between_configurations() {
    assert_eq!(changed(&planned(lab(Lab::default()))), 0);
    assert!(changed(&planned(lab(Lab { passers_by: 4, ..Lab::default() }))) > 300);
    let scenario =
        Scenario { configurations: 3, ..lab(Lab { other_rooms: 1.0, ..Lab::default() }) };
    assert!(changed(&planned(scenario)) > 3000);
}

#[test]
fn a_second_arm_rests_or_moves_where_it_touches_nothing() {
    // Where the room is small there may be none: of some seeds, one.
    let seen = |second_arm: SecondArm, seed: u64| {
        let plan = planned(Scenario { seed, ..lab(Lab { second_arm, ..Lab::default() }) });
        let known = ARM.robot().links.len() + plan.solids().len();
        let view = plan.true_view(0);
        let nothing = usize::from(eyebolt_render::IdealView::NOTHING);
        let others = view.view.surface.iter().map(|surface| usize::from(*surface));
        (others.filter(|surface| (known..nothing).contains(surface)).count(), changed(&plan))
    };
    let still: Vec<_> = (7..11).map(|seed| seen(SecondArm::Still, seed)).collect();
    assert!(still.iter().any(|(pixels, _)| *pixels > 200), "{still:?}");
    assert!(still.iter().all(|(_, changed)| *changed == 0), "{still:?}");
    let moving: Vec<_> = (7..11).map(|seed| seen(SecondArm::Moving, seed)).collect();
    assert!(moving.iter().any(|(_, changed)| *changed > 200), "{moving:?}");
}
