//! Depth images: the answer, and what must not change it.

use crate::run::{
    MASKED, Options, Ran, UNMASKED, WITH_MASKS, WITHOUT_MASKS, difference, run_depth, truth,
};
use crate::scene::{JOINTS, shot, shots};
use std::sync::LazyLock;

static ANSWER: LazyLock<Ran> = LazyLock::new(|| run_depth(&shots(), WITH_MASKS));

#[test]
fn with_masks_the_answer_is_the_truth() {
    ANSWER.assert_trusted(&truth(), MASKED);
    assert!(ANSWER.answer.masks);
    assert_eq!(ANSWER.answer.image_source, Some("depth_images"));
    assert_eq!(ANSWER.answer.frames.camera.as_deref(), Some("depth_optical"));
}

#[test]
fn without_masks_the_answer_is_the_truth() {
    let ran = run_depth(&shots(), WITHOUT_MASKS);
    ran.assert_trusted(&truth(), UNMASKED);
    assert!(!ran.answer.masks);
    assert_eq!(ran.answer.silhouette_iou, None);
}

#[test]
fn the_error_to_expect_is_of_the_size_of_the_error() {
    let expected = ANSWER.answer.expected_error.unwrap();
    let (off_mm, off_deg) = difference(&ANSWER.pose(), &truth());
    assert!(off_mm < 4.0 * expected.translation_mm, "{off_mm} mm off, {expected:?}");
    assert!(off_deg < 4.0 * expected.rotation_deg, "{off_deg} degrees off, {expected:?}");
}

#[test]
fn another_seed_is_another_way_to_the_same_answer() {
    let other = run_depth(&shots(), Options { seed: 7, ..WITH_MASKS });
    let (mm, deg) = difference(&other.pose(), &ANSWER.pose());
    assert!(mm < 0.5 && deg < 0.05, "{mm} mm, {deg} degrees apart");
}

#[test]
fn the_bytes_are_the_same_on_one_thread_and_on_two() {
    let text = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run_depth(&shots(), WITHOUT_MASKS)).answer.to_json()
    };
    assert_eq!(text(1), text(2));
}

#[test]
fn frames_of_the_same_joints_are_one_configuration() {
    let mut frames = shots();
    // Not quite the same: by 0.06 degrees, which moves the hand by a millimetre.
    let trembling = JOINTS[1].map(|angle| angle + 1e-3);
    frames.insert(2, shot(trembling, 60));
    let ran = run_depth(&frames, WITH_MASKS);
    ran.assert_trusted(&truth(), (2.0, 0.15));
    let outcomes = ran.answer.configurations.iter();
    let of_frames: Vec<_> = outcomes.map(|o| (o.name.as_str(), o.configuration)).collect();
    assert_eq!(of_frames, [("0", 0), ("1", 1), ("2", 1), ("3", 2), ("4", 3), ("5", 4)]);
}
