//! What is learned from windows around an end-effector, and views of it.

use crate::small::{Memory, Repeated, Until, end_effector_lesson, hand, plan};
use eyebolt::train::{Beginning, Lesson, Plan, teach};
use nalgebra::{Isometry3, Point3};

/// The same windows, again and again, are learned by heart: a hand can be told from its arm in them.
#[test]
fn windows_are_learned_by_heart() {
    let lesson = Repeated(end_effector_lesson());
    let mut keep = Memory::default();
    let plan = Plan { rate: 1e-2, ..plan(240, 80) };
    teach(&lesson, &plan, Beginning::Anew, &mut keep, &Until(usize::MAX)).unwrap();
    let losses: Vec<f64> = keep.reports.iter().map(|report| report.loss).collect();
    assert!(losses[2] < 0.25 * losses[0] && losses[2] < 0.3, "{losses:?}");
}

/// A camera may see nothing of the arm before it: then another image is drawn, and no step is without windows.
#[test]
fn no_step_is_without_windows() {
    let mut lesson = end_effector_lesson();
    lesson.images = 1;
    for step in 0..200 {
        let (_, labels) = lesson.batch(step).unwrap();
        assert!(!labels.is_empty(), "{step}");
    }
}

/// However a view is rolled, its points are on the end-effector where the truth has it; no two views are alike.
#[test]
fn views_of_one_image_agree_with_the_truth() {
    let hand = hand();
    let views = hand.views(3, 5, 8).unwrap();
    assert!(views.len() >= 6, "{}", views.len());
    for view in &views {
        let surface = hand.end_effector.points(&view.joints, 3000);
        let end_effector_from_view: Isometry3<f64> =
            view.view_from_end_effector.inverse().isometry().to_owned();
        let distance = |point: &[f32; 3]| {
            let point = end_effector_from_view * Point3::from(*point).cast::<f64>();
            let distances = surface.iter().map(|of| (of - point).norm());
            distances.fold(f64::INFINITY, f64::min)
        };
        let mut off: Vec<f64> = view.view.points_m.iter().map(distance).collect();
        off.sort_by(f64::total_cmp);
        assert!(off[off.len() / 2] < 0.02, "{}", off[off.len() / 2]);
    }
    let turns: Vec<_> = views.iter().map(|view| view.view_from_end_effector.rotation()).collect();
    for (index, turn) in turns.iter().enumerate() {
        assert!(turns[index + 1..].iter().all(|other| other.angle_to(turn) > 1e-3));
    }
}
