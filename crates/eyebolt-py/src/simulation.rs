//! Simulated recordings.

use crate::work::{Call, Front, run};
use eyebolt_cli::call::{self, CallError, Simulated};
use eyebolt_geometry::{CoordinateFrame, DepthImage, Distortion, PinholeCamera, Transform};
use eyebolt_recording::{FrameSource, Range};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ffi::OsString;

/// Simulates what `words` ask for into memory: a dictionary of arrays and numbers.
#[pyfunction]
pub fn simulate<'py>(
    py: Python<'py>,
    words: Vec<OsString>,
    call: Call<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    let stacks = run(py, &call, |front| stacked(words, front))?;
    let [rows, columns] = [stacks.camera.height() as usize, stacks.camera.width() as usize];
    let images = |depth_m: Vec<f32>| -> PyResult<Bound<'py, PyArray3<f32>>> {
        let count = depth_m.len() / (rows * columns).max(1);
        PyArray1::from_vec(py, depth_m).reshape([count, rows, columns])
    };
    let told = PyDict::new(py);
    let count = stacks.names.len();
    let joints = PyArray1::from_vec(py, stacks.joints_rad);
    told.set_item("joints", joints.reshape([count, stacks.joint_names.len()])?)?;
    told.set_item("depth", images(stacks.depth_m)?)?;
    told.set_item("backgrounds", images(stacks.backgrounds_m)?)?;
    told.set_item("names", stacks.names)?;
    told.set_item("joint_names", stacks.joint_names)?;
    told.set_item("camera", camera(py, &stacks.camera)?)?;
    told.set_item("camera_frame", stacks.simulated.frames.camera_frame_id())?;
    let robot = stacks.simulated.frames.robot();
    told.set_item("urdf", &robot.description)?;
    told.set_item("base", &robot.base)?;
    told.set_item("end_effector", &robot.end_effector)?;
    told.set_item("camera_from_base", matrix(py, &stacks.simulated.camera_from_base)?)?;
    let after = stacks.simulated.camera_from_base_after.map(|after| matrix(py, &after));
    told.set_item("camera_from_base_after", after.transpose()?)?;
    told.set_item("joint_offsets_rad", stacks.simulated.joint_offsets)?;
    Ok(told)
}

/// Simulates what `words` ask for into the file that they name.
#[pyfunction]
pub fn record_simulation(py: Python<'_>, words: Vec<OsString>, call: Call<'_>) -> PyResult<()> {
    run(py, &call, |front| call::record_simulation(words, front.caller, front.progress))
}

struct Stacks {
    simulated: Simulated,
    camera: PinholeCamera,
    names: Vec<String>,
    depth_m: Vec<f32>,
    backgrounds_m: Vec<f32>,
    joint_names: Vec<String>,
    /// Row by row, one for each frame.
    joints_rad: Vec<f64>,
}

fn stacked(words: Vec<OsString>, front: &Front<'_>) -> Result<Stacks, CallError> {
    let simulated = call::simulate(words, front.caller)?;
    let frames = &simulated.frames;
    let (mut depth_m, mut joints_rad, mut joint_names) = (Vec::new(), Vec::new(), Vec::new());
    for index in 0..frames.frame_names().len() {
        let frame = frames.read_frame(index)?;
        if let Range::Depth(depth) = frame.range {
            depth_m.extend(depth.into_depth_m());
        }
        joint_names = frame.joints.iter().map(|(name, _)| name.to_owned()).collect();
        joints_rad.extend(frame.joints.iter().map(|(_, position)| position));
    }
    let backgrounds = (0..frames.background_count()).map(|index| frames.read_background(index));
    let backgrounds: Vec<DepthImage> = backgrounds.collect::<Result<_, _>>()?;
    let backgrounds_m = backgrounds.into_iter().flat_map(DepthImage::into_depth_m).collect();
    let Some(camera) = frames.camera().cloned() else {
        return Err(CallError::of_text("simulated: there is no camera"));
    };
    let names = frames.frame_names().to_vec();
    Ok(Stacks { simulated, camera, names, depth_m, backgrounds_m, joint_names, joints_rad })
}

/// As `sensor_msgs/CameraInfo` has it.
fn camera<'py>(py: Python<'py>, camera: &PinholeCamera) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    told.set_item("width", camera.width())?;
    told.set_item("height", camera.height())?;
    let (fx, fy, cx, cy) = (camera.fx(), camera.fy(), camera.cx(), camera.cy());
    told.set_item("k", [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0])?;
    let (model, count) = match camera.distortion() {
        Distortion::None => ("plumb_bob", 0),
        Distortion::PlumbBob { .. } => ("plumb_bob", 5),
        Distortion::RationalPolynomial { .. } => ("rational_polynomial", 8),
    };
    let coefficients = camera.distortion().coefficients();
    told.set_item("d", coefficients.into_iter().take(count).collect::<Vec<f64>>())?;
    told.set_item("distortion_model", model)?;
    Ok(told)
}

fn matrix<'py, To: CoordinateFrame, From: CoordinateFrame>(
    py: Python<'py>,
    transform: &Transform<To, From>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let matrix = transform.matrix();
    let rows: Vec<f64> = matrix.transpose().iter().copied().collect();
    PyArray1::from_vec(py, rows).reshape([4, 4])
}
