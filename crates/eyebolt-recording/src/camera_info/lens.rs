//! Distortion, by the names that drivers and calibrations give to lens models.

use super::raw::Raw;
use super::refusal::invalid;
use crate::error::RecordingError;
use eyebolt_geometry::Distortion;
use std::path::Path;

/// Names of the model of Brown and Conrady: ROS, Kalibr, librealsense.
const PLUMB_BOB: [&str; 4] = ["plumb_bob", "radtan", "brown_conrady", "radial_tangential"];
const RATIONAL: [&str; 2] = ["rational_polynomial", "rational"];
/// Models that bend even without coefficients.
const FISHEYE: [&str; 6] =
    ["equidistant", "fisheye", "kannala_brandt", "kannala_brandt4", "ftheta", "omni"];

pub(super) fn distortion(path: &Path, raw: &Raw) -> Result<Distortion, RecordingError> {
    let matrix = raw.distortion_coefficients.as_ref();
    let d = raw.d.as_deref().or(matrix.map(|m| m.data.as_slice())).unwrap_or(&[]);
    let told = raw.distortion_model.as_deref().unwrap_or_default();
    let model = told.trim().to_lowercase().replace([' ', '-'], "_");
    let is = |names: &[&str]| names.contains(&model.as_str());
    // A lens that bends nothing does so by any name.
    if !is(&FISHEYE) && d.iter().all(|c| *c == 0.0) {
        return Ok(Distortion::None);
    }
    // Every model's own number of coefficients; plumb_bob may lack its last, k3.
    let (least, most) = if is(&PLUMB_BOB) {
        (4, 5)
    } else if is(&RATIONAL) {
        (8, 8)
    } else if is(&["", "none"]) {
        // Drivers of rectified pictures leave the model out.
        (0, 0)
    } else {
        let problem = format!("the lens model \"{told}\" is not supported");
        let remedy = "Supported are plumb_bob and rational_polynomial: rectify the depth, or \
                      calibrate the camera with one of these";
        return Err(invalid(path, "distortion_model", problem, remedy));
    };
    // Files are padded with zeros at will.
    if d.len() < least || d.iter().skip(most).any(|c| *c != 0.0) {
        let problem = format!("{} coefficients do not make a lens of model \"{told}\"", d.len());
        let remedy = "plumb_bob has 5 (k1 k2 p1 p2 k3), rational_polynomial 8 (.. k4 k5 k6)";
        return Err(invalid(path, "d", problem, remedy));
    }
    let c = |i: usize| d.get(i).copied().unwrap_or(0.0);
    Ok(match most {
        5 => Distortion::plumb_bob(std::array::from_fn(c)),
        _ => Distortion::rational_polynomial(std::array::from_fn(c)),
    })
}
