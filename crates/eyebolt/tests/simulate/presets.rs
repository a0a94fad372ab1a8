//! The presets against the paper's table of relative camera poses.

use crate::stage::{ARM, Recorded, assert_same, small};
use eyebolt::simulate::{PRESETS, Preset, Scenario, Viewpoint};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_render::Sensor;
use nalgebra::{Point3, Vector3};

/// Rows: training P1 to P3; columns: test P1 to P3. Centimetres and degrees, as the paper prints
/// them.
const APART_CM: [[f64; 3]; 3] = [[5.15, 95.12, 173.49], [102.7, 5.88, 88.12], [175.35, 86.44, 6.2]];
const APART_DEG: [[f64; 3]; 3] =
    [[14.0, 71.33, 119.07], [96.32, 18.31, 95.37], [170.16, 112.66, 42.5]];

fn pose(name: &str) -> Transform<Base, Camera> {
    Preset::named(name).unwrap().base_from_camera()
}

#[test]
fn they_are_as_far_apart_as_the_papers() {
    for (i, (distances, angles)) in APART_CM.iter().zip(APART_DEG).enumerate() {
        for (j, (apart_cm, apart_deg)) in distances.iter().zip(angles).enumerate() {
            let train = pose(&format!("paper-train-p{}", i + 1));
            let (metres, radians) = train.distance_to(&pose(&format!("paper-test-p{}", j + 1)));
            let off = (100.0 * metres - apart_cm, radians.to_degrees() - apart_deg);
            assert!(off.0.abs() < 0.5 && off.1.abs() < 1.0, "P{} to P{}: {off:?}", i + 1, j + 1);
        }
    }
}

#[test]
fn names_are_unique() {
    assert_eq!(PRESETS.len(), 6);
    for preset in PRESETS {
        assert!(Preset::named(preset.name) == Some(preset));
    }
    assert_eq!(Preset::named("paper-test-p4"), None);
}

/// Where hands mostly work: what a box spans, base frame, metres.
const WORKSPACE_M: [[f64; 2]; 3] = [[0.32, 0.52], [-0.1, 0.1], [0.22, 0.42]];

#[test]
fn the_workspace_is_in_view_of_all_and_upright_in_none() {
    for (preset, sensor) in PRESETS.iter().flat_map(|p| Sensor::ALL.map(|sensor| (p, sensor))) {
        let camera_from_base = preset.base_from_camera().inverse();
        let [x, y, z] = WORKSPACE_M;
        let corners = x.map(|x| y.map(|y| z.map(|z| Point3::new(x, y, z))));
        for corner in corners.as_flattened().as_flattened() {
            let in_camera = camera_from_base.point(corner);
            let pixel = sensor.camera().project(&in_camera);
            let seen = pixel.is_some_and(|pixel| sensor.camera().contains(&pixel));
            assert!(seen, "{} of {sensor}: {corner}", preset.name);
            assert!((0.4..2.0).contains(&in_camera.z), "{}: {in_camera}", preset.name);
        }
        // Cameras stand above the table, and image rows run downward.
        let down = camera_from_base.direction(&-Vector3::z());
        assert!(preset.base_from_camera().translation_m().z > 0.5 && down.y > 0.0);
    }
}

#[test]
fn every_preset_can_be_recorded() {
    for preset in PRESETS {
        let viewpoint = Viewpoint::Preset(preset);
        let recorded = Recorded::of(Scenario { viewpoint, frames: 1, ..small() });
        assert_eq!((recorded.count(), recorded.truth.preset.as_deref()), (2, Some(preset.name)));
        assert_same(&recorded.truth.camera_from_base, &preset.base_from_camera().inverse());
        assert_eq!(recorded.truth.robot, ARM.robot().name);
    }
}
