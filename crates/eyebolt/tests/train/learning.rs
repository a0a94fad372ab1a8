//! What is taught is learned.

use crate::small::{Memory, Repeated, Until, lesson, plan};
use eyebolt::segment::{Segmenter, UNKNOWN};
use eyebolt::train::{Beginning, Cast, Framing, Lesson, invented_arm, teach};
use eyebolt_net::{Cpu, Executor};
use eyebolt_render::Random;

/// Eight images, again and again: whoever cannot learn them by heart cannot learn.
#[test]
fn eight_images_are_learned_by_heart() {
    let lesson = Repeated(lesson());
    let mut keep = Memory::default();
    let steps = 500;
    let plan = eyebolt::train::Plan { rate: 1e-2, ..plan(steps, steps) };
    teach(&lesson, &plan, Beginning::Anew, &mut keep, &Until(usize::MAX)).unwrap();
    let last = keep.checkpoints.last().unwrap();
    let state = eyebolt::train::Checkpoint::from_bytes(lesson.graph(), last, &plan).unwrap();
    let (mut right, mut all) = (0, 0);
    for step in 0..2 {
        let (batch, labels) = lesson.batch(step).unwrap();
        // By the statistics of the batch, as while it learned: two batches leave no others.
        let mut found = Vec::new();
        let mut outputs = |outputs: &[eyebolt_net::Matrix]| {
            found = outputs[0].argmax();
            Ok(vec![eyebolt_net::Matrix::zeros(outputs[0].rows(), outputs[0].channels())])
        };
        let parameters = state.trainer.parameters();
        Cpu::new()
            .forward_backward(lesson.graph(), parameters, &batch, Default::default(), &mut outputs)
            .unwrap();
        let known = labels.iter().zip(&found).filter(|(label, _)| **label != u32::from(UNKNOWN));
        all += known.clone().count();
        right += known.filter(|(label, found)| label == found).count();
    }
    assert!(right as f64 > 0.999 * all as f64, "{right} of {all}");
}

#[test]
fn a_short_lesson_tells_an_arm_from_a_room() {
    let mut lesson = lesson();
    lesson.validation = 24;
    let mut keep = Memory::default();
    let model =
        teach(&lesson, &plan(160, 80), Beginning::Anew, &mut keep, &Until(usize::MAX)).unwrap();
    let (first, last) = (&keep.reports[0], &keep.reports[1]);
    assert!(last.loss < first.loss);
    let recall = model.description.metrics["arm_recall"];
    let precision = model.description.metrics["arm_precision"];
    assert!(recall > 0.5 && precision > 0.4, "{:?}", model.description.metrics);
    assert!(Segmenter::new(model).unwrap().tells_end_effector());
}

/// Arms that are made up are drawn as any other, and never two alike.
#[test]
fn images_of_invented_arms_have_the_arm_in_them() {
    let cast = Cast::Any { known: Vec::new(), share_known: 0.0 };
    let framing = Framing { columns: 64, ..Framing::ARM };
    let mut seen = 0;
    for step in 0..8 {
        let shots = cast.shots(Random::new(3).at(step), 4, framing).unwrap();
        assert_eq!(shots, cast.shots(Random::new(3).at(step), 4, framing).unwrap());
        assert!(shots.windows(2).all(|pair| pair[0].image != pair[1].image));
        seen += shots.iter().filter(|shot| shot.label.contains(&1)).count();
    }
    assert!(seen >= 28, "{seen} of 32");
    let names =
        (0..40).map(|seed| invented_arm(Random::new(seed)).unwrap().required_joints().len());
    assert!(names.collect::<std::collections::BTreeSet<_>>().len() >= 3);
}
