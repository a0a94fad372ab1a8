//! What a calibration file says.

use crate::good::parsed;
use crate::scene::{CAMERA, CAMERA_FROM_BASE};
use nalgebra::{Isometry3, Matrix4, Matrix6, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;
use std::collections::BTreeSet;

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

#[test]
fn the_file_says_what_it_is_and_between_which_frames() {
    let json = parsed();
    assert_eq!(json["schema"], "eyebolt.calibration/1");
    assert_eq!(json["verdict"], "trusted");
    assert_eq!(json["reasons"], Value::Array(Vec::new()));
    assert_eq!(json["robot"], "newcomer");
    assert_eq!(json["frames"]["camera"], "depth_optical");
    assert_eq!(json["frames"]["base"], "base");
    assert_eq!(json["frames"]["end_effector"], "hand");
    assert_eq!(json["masks"], true);
    assert_eq!(json["seed"], 1);
    assert_eq!(json["image_source"], "depth_images");
    assert_eq!(json["intrinsics"]["width"], CAMERA.width());
    assert_eq!(json["intrinsics"]["fx"].as_f64(), Some(CAMERA.fx()));
    assert!(json.get("timing_ms").is_none(), "bytes must not depend on the clock");
    let frames = json["configurations"].as_array().unwrap();
    let names: Vec<_> = frames.iter().map(|frame| frame["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["0", "1", "2", "3", "4"]);
    for frame in frames {
        assert_eq!(frame["used"], true);
        assert!((0.0..20.0).contains(&frame["residual_mm"].as_f64().unwrap()), "{frame}");
    }
}

#[test]
fn numbers_have_their_unit_in_their_name() {
    let json = parsed();
    let mut names = BTreeSet::new();
    collect_names(&json, &mut names);
    // Counts, shares and pixels of the intrinsics have none, and covariances two.
    let plain = [
        "configuration",
        "contradicted_share",
        "covariance",
        "cx",
        "cy",
        "depth_scale_error",
        "distortion",
        "fx",
        "fy",
        "height",
        "matrix",
        "rotation_xyzw",
        "seed",
        "silhouette_iou",
        "unexplained_share",
        "width",
    ];
    let units = ["_m", "_mm", "_deg", "_px", "_ms"];
    for name in names {
        let has_unit = units.iter().any(|unit| name.ends_with(unit));
        assert!(has_unit || plain.contains(&name.as_str()), "{name} has no unit");
    }
}

/// Names of fields with a number or a list of numbers.
fn collect_names(value: &Value, names: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            for (name, field) in fields {
                let first = std::iter::successors(Some(field), |field| field.get(0)).last();
                if first.is_some_and(Value::is_number) {
                    names.insert(name.clone());
                }
                collect_names(field, names);
            }
        }
        Value::Array(items) => items.iter().for_each(|item| collect_names(item, names)),
        _ => {}
    }
}

#[test]
fn the_two_poses_are_inverse_and_each_spells_one_transform() {
    let json = parsed();
    let matrix = |name: &str| Matrix4::from_row_slice(&numbers(&json[name]["matrix"]));
    let (there, back) = (matrix("camera_from_base"), matrix("base_from_camera"));
    assert!((there * back - Matrix4::identity()).amax() < 1e-12);
    for (name, matrix) in [("camera_from_base", there), ("base_from_camera", back)] {
        let translation_m =
            Translation3::from(Vector3::from_row_slice(&numbers(&json[name]["translation_m"])));
        let [x, y, z, w] = numbers(&json[name]["rotation_xyzw"])[..] else { panic!("{name}") };
        let rotation = Quaternion::new(w, x, y, z);
        assert!((rotation.norm() - 1.0).abs() < 1e-12 && w >= 0.0);
        let spelled =
            Isometry3::from_parts(translation_m, UnitQuaternion::from_quaternion(rotation));
        assert!((spelled.to_homogeneous() - matrix).amax() < 1e-12);
    }
    assert!((there - CAMERA_FROM_BASE.matrix()).amax() < 0.02, "{there}");
}

#[test]
fn the_covariance_is_one() {
    let json = parsed();
    let covariance = Matrix6::from_row_slice(&numbers(&json["covariance"]));
    assert!((covariance - covariance.transpose()).amax() <= 1e-12 * covariance.amax());
    // Translation (m) and rotation (rad) differ little in size here, so no scaling is needed.
    assert!(covariance.symmetric_eigenvalues().min() > 0.0, "{covariance}");
    let trace_rad2 = covariance.fixed_view::<3, 3>(3, 3).trace();
    let expected_deg = json["expected_error"]["rotation_deg"].as_f64().unwrap();
    assert!((trace_rad2.sqrt().to_degrees() - expected_deg).abs() < 1e-9);
}
