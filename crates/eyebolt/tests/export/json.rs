//! Calibration files, made without the program.

use eyebolt::export::SavedCalibration;
use eyebolt_geometry::{Base, Camera, CoordinateFrame, Transform};
use serde_json::{Value, json};

/// What `eyebolt calibrate` writes, as far as it matters here; camera `eye_optical`, base `base`.
pub fn calibration(base_from_camera: &Transform<Base, Camera>) -> Value {
    json!({
        "schema": "eyebolt.calibration/1",
        "version": "0.1.0",
        "verdict": "trusted",
        "reasons": [],
        "frames": {"camera": "eye_optical", "base": "base", "end_effector": "hand",
                   "convention": "a_from_b maps coordinates in b to coordinates in a"},
        "camera_from_base": pose(&base_from_camera.inverse()),
        "base_from_camera": pose(base_from_camera),
        "seed": 1,
    })
}

fn pose<A: CoordinateFrame, B: CoordinateFrame>(pose: &Transform<A, B>) -> Value {
    let matrix = pose.matrix();
    let rows: Vec<Vec<f64>> = matrix.row_iter().map(|r| r.iter().copied().collect()).collect();
    json!({
        "translation_m": pose.translation_m().as_slice(),
        "rotation_xyzw": pose.rotation_xyzw(),
        "matrix": rows,
    })
}

pub fn example() -> Transform<Base, Camera> {
    Transform::from_xyzw([0.9, -0.2, 0.7], [-0.6, 0.48, -0.32, 0.5542562584220408]).unwrap()
}

pub fn parsed(json: &Value) -> SavedCalibration {
    SavedCalibration::parse("calibration.json", &json.to_string()).unwrap()
}
