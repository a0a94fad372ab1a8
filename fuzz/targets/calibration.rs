//! Saved calibrations in JSON and static transforms in YAML, up to every form of export.
#![no_main]

use eyebolt::export::{Format, Placement, SavedCalibration, StaticTree, Wanted};
use libfuzzer_sys::fuzz_target;

const CALIBRATION: &str = include_str!("../seeds/calibration/trusted.json");

fuzz_target!(|text: &str| {
    let tree = StaticTree::from_tf_message("tree", text).unwrap_or_else(|_| StaticTree::empty());
    let known = SavedCalibration::parse("known", CALIBRATION).expect("the seed is a calibration");
    let calibration = SavedCalibration::parse("calibration", text).unwrap_or(known);
    let wanted = Wanted { even_if_refused: true, ..Wanted::default() };
    let Ok(placement) = Placement::find(&calibration, &tree, &wanted) else { return };
    let isometry = placement.parent_from_child.isometry();
    assert!(isometry.to_matrix().iter().all(|number| number.is_finite()));
    for format in Format::ALL {
        let written = format.write(&placement, text);
        assert!(!written.is_empty());
    }
});
