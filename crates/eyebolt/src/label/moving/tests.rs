//! An arm that is elsewhere in each configuration, in a room that does not stay as it is.

use super::*;
use crate::made_up;
use crate::observations::Background;
use eyebolt_geometry::DepthImage;
use eyebolt_registration::{ArmModel, Posture};
use eyebolt_render::Random;
use std::ops::Range;

const WIDTH: usize = 160;
const HEIGHT: usize = 120;
const CONFIGURATIONS: usize = 6;
/// Columns of the arm in one configuration; in the next it is beside that.
const ARM_COLUMNS: usize = 24;
const ARM_ROWS: Range<usize> = 10..70;
const WALL_M: f64 = 2.5;

fn is_arm(configuration: usize, u: usize, v: usize) -> bool {
    u / ARM_COLUMNS == configuration && ARM_ROWS.contains(&v)
}

/// What is seen where the arm is not: in a configuration, a column and a row, metres.
type Room = fn(usize, usize, usize) -> f64;

fn observed(room: Room) -> Observations {
    let arm = ArmModel::new(Vec::new());
    let images = (0..CONFIGURATIONS).map(|configuration| {
        let mut random = Random::new(3).at(configuration as u64);
        let pixels = (0..WIDTH * HEIGHT).map(|at| {
            let (u, v) = (at % WIDTH, at / WIDTH);
            let arm_m = 1.0 + 0.1 * configuration as f64;
            let true_m =
                if is_arm(configuration, u, v) { arm_m } else { room(configuration, u, v) };
            (true_m + 0.002 * true_m * true_m * random.normal()) as f32
        });
        DepthImage::new(WIDTH as u32, HEIGHT as u32, pixels.collect()).unwrap()
    });
    let seen = images.map(|image| (Posture::new(&arm, Vec::new()), image)).collect();
    made_up::observations(made_up::camera(WIDTH as u32, HEIGHT as u32, 130.0), &arm, seen)
}

#[track_caller]
fn assert_only_the_arm(observations: &Observations) {
    for (configuration, labels) in Motion.label(observations).unwrap().labels.iter().enumerate() {
        let (mut missed, mut others) = (0, 0);
        for (u, v) in (0..HEIGHT).flat_map(|v| (0..WIDTH).map(move |u| (u, v))) {
            match (is_arm(configuration, u, v), labels.at(u, v) == Some(Label::Arm)) {
                (true, false) => missed += 1,
                (false, true) => others += 1,
                _ => {}
            }
        }
        assert_eq!((missed, others), (0, 0), "configuration {configuration}");
    }
}

/// A crate below the arm.
fn crated(u: usize, v: usize) -> f64 {
    if (30..110).contains(&u) && (80..110).contains(&v) { 1.6 } else { WALL_M }
}

#[test]
fn in_a_room_that_stays_only_the_arm_moves() {
    assert_only_the_arm(&observed(|_, u, v| crated(u, v)));
}

#[test]
fn what_was_taken_away_for_a_third_is_not_the_arm() {
    assert_only_the_arm(&observed(|at, u, v| if at < 4 { crated(u, v) } else { WALL_M }));
    assert_only_the_arm(&observed(|at, u, v| if at % 3 > 0 { crated(u, v) } else { WALL_M }));
}

#[test]
fn what_was_there_for_half_is_not_the_arm() {
    assert_only_the_arm(&observed(|at, u, v| if at < 3 { crated(u, v) } else { WALL_M }));
    assert_only_the_arm(&observed(|at, u, v| if at % 2 == 0 { crated(u, v) } else { WALL_M }));
}

#[test]
fn a_wall_that_stood_farther_for_a_third_makes_no_arm_of_the_wall() {
    assert_only_the_arm(&observed(|at, _, _| if at % 3 > 0 { WALL_M } else { 3.2 }));
}

/// What was there once cannot be told from an arm: nobody else saw it.
#[test]
fn what_was_there_once_is_taken_for_the_arm() {
    let observations = observed(|at, u, v| if at == 2 { crated(u, v) } else { WALL_M });
    let labels = Motion.label(&observations).unwrap().labels;
    assert_eq!(labels[2].at(70, 95), Some(Label::Arm));
    assert_eq!(labels[1].at(70, 95), Some(Label::Background));
}

/// Frames without the arm know better than a vote: an arm may rest at the same place for long.
#[test]
fn with_frames_of_the_scene_alone_nothing_is_voted_on() {
    let mut observations = observed(|at, u, v| if at < 4 { crated(u, v) } else { WALL_M });
    let wall = vec![WALL_M as f32; WIDTH * HEIGHT];
    let wall = DepthImage::new(WIDTH as u32, HEIGHT as u32, wall).unwrap();
    observations.background = Background::Seen(wall);
    let labels = Motion.label(&observations).unwrap().labels;
    assert_eq!(labels[0].at(70, 95), Some(Label::Arm));
    assert_eq!(labels[5].at(70, 95), Some(Label::Background));
}

/// Noise that the recording shows is no motion: a far wall that wanders by decimetres.
#[test]
fn a_wall_that_wanders_is_not_the_arm() {
    assert_only_the_arm(&observed(|at, u, v| {
        6.0 + 0.25 * f64::sin(1.7 * at as f64 + 0.9 * (u as f64 + v as f64))
    }));
}
