//! What a simulation knows, written and read.

use crate::sample::{Backgrounds, Desk, MS, START_NS, assert_says, open, truth, write};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_recording::{CameraMoved, Truth, read_truth};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::FRAC_PI_2;
use std::fs;

fn poses() -> impl Strategy<Value = Transform<Camera, Base>> {
    let translation = proptest::array::uniform3(-5.0_f64..5.0);
    let rotation = proptest::array::uniform3(-2.0_f64..2.0);
    (translation, rotation).prop_map(|(translation, rotation)| {
        let rotation = UnitQuaternion::from_scaled_axis(Vector3::from(rotation));
        Transform::from_parts(Vector3::from(translation), rotation)
    })
}

fn truths() -> impl Strategy<Value = Truth> {
    let moved = proptest::collection::btree_map(any::<i64>(), poses(), 0..3);
    let texts = ("\\PC{0,8}", "\\PC{0,8}", "[a-z]{1,8}", proptest::option::of("\\PC{0,8}"));
    let faults = proptest::collection::btree_map("\\PC{0,8}", any::<i32>(), 0..3);
    (texts, any::<u64>(), poses(), moved, faults).prop_map(
        |((robot, base, sensor, preset), seed, camera_from_base, moved, faults)| Truth {
            robot,
            base,
            sensor,
            preset,
            seed,
            camera_from_base,
            camera_from_base_after: moved
                .into_iter()
                .map(|(stamp_ns, camera_from_base)| CameraMoved { stamp_ns, camera_from_base })
                .collect(),
            faults: faults.into_iter().map(|(name, fault)| (name, json!(fault))).collect(),
        },
    )
}

fn near(a: &Transform<Camera, Base>, b: &Transform<Camera, Base>) -> bool {
    let (distance_m, angle_rad) = a.distance_to(b);
    // The angle of two quaternions is known to half their digits.
    distance_m == 0.0 && angle_rad < 1e-7 && (a.matrix() - b.matrix()).amax() < 1e-14
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn what_is_written_is_read(truth in truths()) {
        let desk = Desk::new();
        let file = desk.file("truth.json");
        fs::write(&file, truth.to_json()).unwrap();
        let read = read_truth(&file).unwrap();
        prop_assert!(near(&read.camera_from_base, &truth.camera_from_base));
        let (moved, expected) = (&read.camera_from_base_after, &truth.camera_from_base_after);
        prop_assert_eq!(moved.len(), expected.len());
        for (moved, expected) in moved.iter().zip(expected) {
            prop_assert_eq!(moved.stamp_ns, expected.stamp_ns);
            prop_assert!(near(&moved.camera_from_base, &expected.camera_from_base));
            prop_assert_eq!(&read.camera_from_base_at(moved.stamp_ns), &moved.camera_from_base);
        }
        let same = Truth {
            camera_from_base: truth.camera_from_base,
            camera_from_base_after: truth.camera_from_base_after.clone(),
            ..read
        };
        prop_assert_eq!(same, truth);
    }
}

/// The form, told without the code that writes it.
#[test]
fn matrices_are_row_by_row() {
    let quarter = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), FRAC_PI_2);
    let camera_from_base = Transform::from_parts(Vector3::new(1.0, 2.0, 3.0), quarter);
    let text = Truth { camera_from_base, ..truth() }.to_json();
    let written: Value = serde_json::from_str(&text).unwrap();
    let expected =
        [[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 2.0], [0.0, 0.0, 1.0, 3.0], [0.0, 0.0, 0.0, 1.0]];
    for (r, row) in expected.iter().enumerate() {
        for (c, number) in row.iter().enumerate() {
            let found = written["camera_from_base"][r][c].as_f64().unwrap();
            assert!((found - number).abs() < 1e-15, "{r} {c}: {found}");
        }
    }
    assert_eq!(written["schema"], "eyebolt.truth/1");
    assert_eq!(written["seed"], u64::MAX);
    assert_eq!(written["camera_from_base_after"][0]["stamp_ns"], START_NS + 250 * MS);
}

#[test]
fn a_bumped_camera_is_elsewhere_from_then_on() {
    let truth = truth();
    let x = |stamp_ns| truth.camera_from_base_at(stamp_ns).translation_m().x;
    let bump_ns = START_NS + 250 * MS;
    assert_eq!([x(i64::MIN), x(bump_ns - 1), x(bump_ns), x(i64::MAX)], [0.1, 0.1, 0.125, 0.125]);
}

#[test]
fn truth_is_found_wherever_it_may_lie() {
    let desk = Desk::new();
    let mcap = desk.record("a.mcap", false, |writer| {
        write(writer, Backgrounds::None)?;
        writer.truth(&Truth { seed: 1, ..truth() })?;
        // Of several the last one counts.
        writer.truth(&truth())
    });
    let folder = desk.folder(&mcap, "folder");
    let bags = desk.file("bags");
    fs::create_dir(&bags).unwrap();
    fs::copy(&mcap, bags.join("bags_0.mcap")).unwrap();
    let files = ["truth.json", "recording.toml"].map(|name| folder.join(name));
    for path in [&mcap, &folder, &bags].into_iter().chain(&files) {
        assert_eq!(read_truth(path).unwrap().seed, u64::MAX, "{}", path.display());
    }
    assert_says(read_truth(&desk.file("nowhere.json")), &["nowhere.json", "cannot read the truth"]);
    assert_says(read_truth(&desk.file("nowhere")), &["nowhere", "cannot read the truth"]);
}

/// Readers of recordings never look at it, whatever it says.
#[test]
fn nothing_depends_on_the_truth() {
    let desk = Desk::new();
    let mcap = desk.record("a.mcap", false, |writer| {
        writer.truth(&truth())?;
        write(writer, Backgrounds::None)
    });
    let folder = desk.folder(&mcap, "folder");
    fs::write(folder.join("truth.json"), "no JSON").unwrap();
    assert_eq!(open(&folder).frame_names().len(), 5);
    // It is carried as it is.
    let copy = desk.mcap(&folder, "copy.mcap");
    assert_eq!(open(&copy).frame_names().len(), 5);
    let said = ["copy.mcap: metadata eyebolt.truth: line 1, column 2"];
    assert_says(read_truth(&copy), &said);
    let again = desk.folder(&desk.mcap(&copy, "again.mcap"), "again");
    assert_eq!(fs::read_to_string(again.join("truth.json")).unwrap(), "no JSON");
}
