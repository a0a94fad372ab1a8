//! What RViz draws of an answer.

use crate::assessment::Assessment;
use eyebolt_recording::{Marker, MarkerShape, markers_message};
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

/// Metres.
const AXIS_M: f64 = 0.15;
const THICKNESS_M: f64 = 0.01;
const LETTERS_M: f64 = 0.04;
const ABOVE_M: f64 = 0.12;

/// The camera's axes (x red, y green, z, where it looks, blue) and how good the answer is, as a
/// `visualization_msgs/MarkerArray` in the frame `base`; `None` while there is no pose.
pub fn pose_markers(base: &str, assessment: &Assessment) -> Option<Vec<u8>> {
    let (origin_m, [x, y, z, w]) = assessment.base_from_camera?;
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let origin = Point3::from(origin_m);
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let colors = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.2, 0.4, 1.0, 1.0]];
    let arrows = (0..).zip(axes).zip(colors).map(|((id, axis), rgba)| {
        let end = origin + turn * axis * AXIS_M;
        let ends_m = [origin_m, end.coords.into()];
        Marker { id, shape: MarkerShape::Arrow { ends_m, thickness_m: THICKNESS_M }, rgba }
    });
    let mut markers: Vec<Marker> = arrows.collect();
    let error = assessment.expected_mm_deg;
    let error = error.map_or("?".to_owned(), |[mm, deg]| format!("{mm:.1} mm, {deg:.2} deg"));
    let verdict = if assessment.trusted { "" } else { ", not trusted yet" };
    let text = format!("{} configurations, {error}{verdict}", assessment.used);
    let at_m = (origin + Vector3::z() * ABOVE_M).coords.into();
    let shape = MarkerShape::Text { text, at_m, height_m: LETTERS_M };
    markers.push(Marker { id: 3, shape, rgba: [1.0; 4] });
    Some(markers_message(base, "eyebolt", &markers))
}
