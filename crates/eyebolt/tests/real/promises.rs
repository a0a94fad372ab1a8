//! How close the answers come.

use crate::measures::{apart, masks, reference, silhouette_iou, surface_distance};
use crate::recording::{FRAMES, Variant, shared, trusted};
use eyebolt::answer::Answer;
use eyebolt::calibrate::Verdict;

#[test]
fn with_masks_within_12_mm_of_the_reference() {
    let Some(shared) = shared() else { return };
    let opened = Variant::default().open(&shared);
    let outcome = opened.run();
    let pose = trusted(&outcome);
    let (mm, degrees) = apart(&pose, &reference());
    assert!(mm <= 12.0 && degrees <= 0.8, "{mm} mm, {degrees} degrees");
    let masks = masks(&opened.recording);
    let iou = silhouette_iou(&outcome, &masks, &pose);
    assert!(iou >= 0.93, "{iou}");
    let distance = surface_distance(&outcome, &masks, &pose);
    assert!(distance <= 6.5, "{distance} mm");
}

#[test]
fn without_masks_within_20_mm_of_the_reference() {
    let Some(shared) = shared() else { return };
    let opened = Variant { masks: false, ..Variant::default() }.open(&shared);
    let outcome = opened.run();
    let pose = trusted(&outcome);
    let (mm, degrees) = apart(&pose, &reference());
    assert!(mm <= 20.0 && degrees <= 1.2, "{mm} mm, {degrees} degrees");
    let iou = silhouette_iou(&outcome, &masks(&opened.recording), &pose);
    assert!(iou >= 0.92, "{iou}");
}

#[test]
fn three_configurations_are_enough_or_refused() {
    let Some(shared) = shared() else { return };
    let whole = trusted(&Variant::default().open(&shared).run());
    let mut trusted = 0;
    for left_out in pairs() {
        let frames = FRAMES.into_iter().filter(|frame| !left_out.contains(frame)).collect();
        let outcome = Variant { frames, ..Variant::default() }.open(&shared).run();
        if outcome.calibration.verdict != Verdict::Trusted {
            continue;
        }
        trusted += 1;
        let pose = outcome.calibration.camera_from_base.unwrap();
        let (mm, degrees) = apart(&pose, &whole);
        assert!(mm <= 25.0 && degrees <= 1.5, "without {left_out:?}: {mm} mm, {degrees} degrees");
    }
    assert!(trusted >= 7, "{trusted} of 10 trusted");
}

fn pairs() -> Vec<[usize; 2]> {
    FRAMES.iter().flat_map(|a| FRAMES[a + 1..].iter().map(|b| [*a, *b])).collect()
}

#[test]
fn the_same_bytes_on_one_and_on_two_threads() {
    let Some(shared) = shared() else { return };
    for masks in [true, false] {
        let opened = Variant { masks, ..Variant::default() }.open(&shared);
        let bytes = [1, 2].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Answer::new(&opened.request(), &opened.run()).to_json())
        });
        assert_eq!(bytes[0], bytes[1]);
    }
}

#[test]
fn another_seed_finds_the_same_answer() {
    let Some(shared) = shared() else { return };
    let [one, other] = [1, 2].map(|seed| {
        trusted(&Variant { masks: false, seed, ..Variant::default() }.open(&shared).run())
    });
    let (mm, degrees) = apart(&one, &other);
    assert!(mm <= 1.0 && degrees <= 0.1, "{mm} mm, {degrees} degrees");
}
