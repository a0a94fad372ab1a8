//! From arrays in memory to an answer, with no file of frames: the example of docs/library.md.

use crate::run::{UNMASKED, difference, truth};
use crate::scene::{CAMERA, JOINT_NAMES, URDF, shots};
use eyebolt::calibrate::Verdict;

#[rustfmt::skip]
mod example {
// docs/library.md: begin
use eyebolt::pipeline::{Outcome, Request, run};
use eyebolt_geometry::{DepthImage, PinholeCamera};
use eyebolt_recording::InMemory;
use eyebolt_robot::{PackageRoots, Robot};
use std::{error::Error, path::Path};

/// Depth in metres, row by row, 0 where there is none; joints by name, radians.
type Frame = (Vec<f32>, Vec<(String, f64)>);

pub fn calibrate(camera: PinholeCamera, urdf: &Path, frames: Vec<Frame>) -> Result<Outcome, Box<dyn Error>> {
    let (width, height) = (camera.width(), camera.height());
    let mut source = InMemory::new(camera);
    for (number, (depth_m, joints)) in frames.into_iter().enumerate() {
        let depth = DepthImage::new(width, height, depth_m)?;
        source.push(number.to_string(), depth, joints.into_iter().collect())?;
    }
    let robot = Robot::from_urdf_file(urdf, &PackageRoots::new())?;
    let arm = robot.arm(None, None)?; // base and end-effector: guessed
    Ok(run(&Request::new(&source, &arm), &())?)
}
// docs/library.md: end
}

#[test]
fn arrays_in_memory_are_calibrated() {
    let folder = tempfile::tempdir().unwrap();
    let urdf = folder.path().join("arm.urdf");
    std::fs::write(&urdf, URDF).unwrap();
    let frames = shots().into_iter().map(|shot| {
        let joints = JOINT_NAMES.iter().zip(shot.joints);
        (shot.depth_m, joints.map(|(name, rad)| ((*name).to_owned(), rad)).collect())
    });
    let outcome = example::calibrate(CAMERA.clone(), &urdf, frames.collect()).unwrap();
    assert_eq!(outcome.calibration.verdict, Verdict::Trusted);
    let pose = outcome.calibration.camera_from_base.unwrap();
    let (mm, degrees) = difference(&pose, &truth());
    assert!(mm < UNMASKED.0 && degrees < UNMASKED.1, "{mm} mm, {degrees} degrees");
}

#[test]
fn the_page_on_the_library_shows_this_example() {
    let here = include_str!("in_memory.rs");
    let (_, example) = here.split_once("// docs/library.md: begin\n").unwrap();
    let (example, _) = example.split_once("// docs/library.md: end").unwrap();
    assert!(example.lines().count() < 30);
    let page = include_str!("../../../../docs/library.md");
    assert!(page.contains(example.trim_end()), "docs/library.md: the library's example is another");
}
