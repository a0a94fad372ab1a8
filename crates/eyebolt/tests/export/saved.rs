//! What a calibration file must say to be exported.

use crate::json::{calibration, example, parsed};
use crate::poses::{config, pose};
use eyebolt::export::{Corrections, SavedCalibration};
use eyebolt_geometry::Transform;
use eyebolt_robot::Input;
use proptest::prelude::*;
use serde_json::{Value, json};

proptest! {
    #![proptest_config(config(256))]

    #[test]
    fn the_pose_is_the_one_that_was_saved(pose in pose()) {
        let pose = Transform::from_isometry(*pose.isometry());
        let read = parsed(&calibration(&pose)).base_from_camera(false).unwrap();
        let size = 1.0 + pose.translation_m().norm();
        prop_assert!((read.matrix() - pose.matrix()).amax() < 1e-15 * size);
    }
}

#[test]
fn names_are_read() {
    let calibration = parsed(&calibration(&example()));
    assert_eq!(calibration.camera_frame.unwrap().as_str(), "eye_optical");
    assert_eq!(calibration.base_frame.as_str(), "base");
    assert_eq!(calibration.end_effector_frame.as_str(), "hand");
}

/// The calibration with `value` at `pointer`, or without what is there.
fn with(pointer: &str, value: Option<Value>) -> Value {
    let mut json = calibration(&example());
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = json.pointer_mut(parent).unwrap();
    match (parent, value) {
        (Value::Object(fields), Some(value)) => drop(fields.insert(key.to_owned(), value)),
        (Value::Object(fields), None) => drop(fields.remove(key)),
        (Value::Array(items), Some(value)) => items[key.parse::<usize>().unwrap()] = value,
        _ => panic!("{pointer}"),
    }
    json
}

fn error(json: &Value) -> String {
    let text = serde_json::to_string_pretty(json).unwrap();
    SavedCalibration::parse("cell/c.json", &text).unwrap_err().to_string()
}

#[test]
fn what_cannot_be_right_is_named_with_file_field_and_remedy() {
    let cases = [
        ("/schema", None, "schema: the field is missing"),
        ("/schema", Some(json!("eyebolt.calibration/2")), "schema: \"eyebolt.calibration/2\""),
        ("/verdict", None, "verdict: the field is missing"),
        ("/verdict", Some(json!("fine")), "verdict: \"fine\" is neither"),
        ("/frames", None, "frames: the field is missing"),
        ("/frames/base", None, "frames.base: the field is missing"),
        ("/frames/base", Some(json!("a\nb")), "frames.base: frame name \"a\\nb\""),
        ("/frames/camera", Some(json!("-x")), "frames.camera: frame name \"-x\""),
        ("/frames/end_effector", Some(Value::Null), "frames.end_effector: the field is missing"),
        ("/base_from_camera", None, "base_from_camera: the field is missing"),
        ("/camera_from_base", Some(Value::Null), "camera_from_base: the field is missing"),
        ("/base_from_camera/matrix", None, "base_from_camera.matrix: the field is missing"),
        ("/base_from_camera/translation_m", None, "base_from_camera.translation_m: the field"),
        ("/camera_from_base/rotation_xyzw", None, "camera_from_base.rotation_xyzw: the field"),
        (
            "/base_from_camera/rotation_xyzw/0",
            Some(json!(0.9)),
            "base_from_camera.rotation_xyzw: its length is",
        ),
        ("/base_from_camera/rotation_xyzw", Some(json!([0, 0, 0, 0])), "its length is 0, not 1"),
        (
            "/base_from_camera/translation_m/1",
            Some(json!(900.0)),
            "base_from_camera.matrix: it is not the matrix",
        ),
        (
            "/base_from_camera/translation_m/1",
            Some(json!(1e300)),
            "base_from_camera.translation_m: farther",
        ),
        (
            "/base_from_camera/matrix/2/3",
            Some(json!(0.701)),
            "base_from_camera.matrix: it is not the matrix",
        ),
        (
            "/base_from_camera/matrix/3/0",
            Some(json!(1.0)),
            "base_from_camera.matrix: it is not the matrix",
        ),
        ("/base_from_camera/matrix/0/0", Some(Value::Null), "line "),
        ("/base_from_camera/translation_m", Some(json!([1, 2])), "line "),
        ("/base_from_camera/rotation_xyzw/3", Some(json!("NaN")), "line "),
    ];
    for (pointer, value, words) in cases {
        let error = error(&with(pointer, value));
        assert!(
            error.starts_with(&format!("cell/c.json: {words}")) || error.contains(words),
            "{error}"
        );
        assert!(error.starts_with("cell/c.json: ") && error.contains(". "), "{error}");
    }
}

#[test]
fn poses_that_are_not_each_others_inverse_are_refused() {
    let mut json = calibration(&example());
    json["camera_from_base"] = json["base_from_camera"].clone();
    let error = error(&json);
    assert!(
        error.contains("camera_from_base: it is not the inverse of base_from_camera"),
        "{error}"
    );
}

#[test]
fn rounding_to_six_places_is_no_disagreement() {
    fn round(value: &mut Value) {
        match value {
            Value::Number(number) => *value = json!((number.as_f64().unwrap() * 1e6).round() / 1e6),
            Value::Array(items) => items.iter_mut().for_each(round),
            Value::Object(fields) => fields.values_mut().for_each(round),
            _ => {}
        }
    }
    let mut json = calibration(&example());
    round(&mut json);
    assert!(parsed(&json).base_from_camera(false).is_ok());
}

#[test]
fn a_refused_pose_is_exported_only_when_asked_for() {
    let mut json = calibration(&example());
    json["verdict"] = json!("refused");
    json["reasons"] = json!(["too few configurations", "a rival pose"]);
    let refused = parsed(&json);
    let error = refused.base_from_camera(false).unwrap_err();
    assert_eq!(error.input(), Some(Input::EVEN_IF_REFUSED));
    let error = error.to_string();
    for words in ["verdict: refused", "too few configurations; a rival pose", "`even_if_refused`"] {
        assert!(error.contains(words), "{error}");
    }
    assert!(refused.base_from_camera(true).is_ok());
}

#[test]
fn without_a_pose_there_is_nothing_to_export() {
    let mut json = calibration(&example());
    json["verdict"] = json!("refused");
    json["camera_from_base"] = Value::Null;
    json["base_from_camera"] = Value::Null;
    let error = parsed(&json).base_from_camera(true).unwrap_err().to_string();
    assert!(error.contains("calibration.json: base_from_camera: no pose was found"), "{error}");
}

#[test]
fn a_camera_without_a_name_is_allowed() {
    for name in [json!(null), json!("")] {
        assert_eq!(parsed(&with("/frames/camera", Some(name))).camera_frame, None);
    }
}

#[test]
fn what_was_found_to_be_off_is_read_in_si_units() {
    let mut json = calibration(&example());
    json["joint_offsets"] = json!([{"joint": "elbow", "offset_deg": 90.0, "sigma_deg": 0.1}]);
    json["link_lengths"] = json!([{"joint": "wrist", "longer_mm": -4.0}]);
    json["depth_scale_error"] = json!(0.01);
    json["intrinsics_offset"] = json!({"focal_percent": 2.0, "centre_px": [3.0, -1.0]});
    json["camera_moved"] = json!([{"before_frame": "7"}]);
    let found = parsed(&json);
    assert_eq!(
        *found.corrections(),
        Corrections {
            joint_offsets_rad: vec![("elbow".to_owned(), std::f64::consts::FRAC_PI_2)],
            link_lengths_m: vec![("wrist".to_owned(), -0.004)],
            depth_scale_error: 0.01,
            focal: 0.02,
            centre_px: [3.0, -1.0],
            camera_moved_before: Some("7".to_owned()),
        }
    );
    assert_eq!(*parsed(&calibration(&example())).corrections(), Corrections::default());
    json["depth_scale_error"] = json!(7.0);
    assert!(error(&json).contains("depth_scale_error: 7 is more than 0.5"), "{}", error(&json));
}

#[test]
fn how_far_off_it_may_be_is_read_and_checked() {
    let identity: Vec<Vec<f64>> =
        (0..6).map(|i| (0..6).map(|j| if i == j { 1e-6 } else { 0.0 }).collect()).collect();
    let mut json = with("/covariance", Some(json!(identity)));
    json["workspace_in_base_m"] = json!([0.1, 0.2, 0.3]);
    json["configurations"] = json!([
        { "configuration": 0, "used": true, "residual_mm": 2.0 },
        { "configuration": 0, "used": true, "residual_mm": 2.0 },
        { "configuration": 1, "used": true, "residual_mm": 4.0 },
        { "configuration": 2, "used": false, "residual_mm": 90.0 },
    ]);
    let read = parsed(&json);
    let told = read.uncertainty();
    assert_eq!(told.covariance.unwrap()[(3, 3)], 1e-6);
    assert_eq!(told.workspace_in_base.unwrap().coords.as_slice(), [0.1, 0.2, 0.3]);
    assert_eq!((told.residual_m, told.configurations), (Some(0.002), 2));
    json["covariance"][0][1] = json!(1e-3);
    assert!(error(&json).contains("covariance"), "{}", error(&json));
    json["covariance"][1][0] = json!(1e-3);
    assert!(error(&json).contains("covariance"), "{}", error(&json));
}
