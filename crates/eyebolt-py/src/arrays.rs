//! NumPy arrays as the frames of a recording, without copies.

use crate::error::raised;
use eyebolt_cli::call::CallError;
use eyebolt_geometry::{DepthImage, ImageError, Mask};
use eyebolt_recording::{BorrowedFrame, BorrowedFrames, CameraInfo, DepthUnit, Make, Recording};
use numpy::PyReadonlyArray2;
use numpy::ndarray::ArrayView2;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;

/// Frames as the package hands them over, checked for shapes and types there.
#[derive(FromPyObject)]
pub struct Arrays<'py> {
    /// Name of each frame.
    names: Vec<String>,
    /// `(rows, columns)` each: uint16, float32 or float64.
    depth: Vec<DepthArray<'py>>,
    /// `(rows, columns)` each, one for each frame or none at all.
    masks: Vec<MaskArray<'py>>,
    /// Positions of the joints of each frame: radians, metres for prismatic joints.
    joints: Vec<BTreeMap<String, f64>>,
    /// As `depth`: the scene without the robot.
    backgrounds: Vec<DepthArray<'py>>,
    /// What `camera_info.yaml` says, and what that is called.
    camera: String,
    camera_name: String,
    /// What one of the numbers of depth is, in the words of `--depth-unit`.
    depth_unit: Option<String>,
}

/// An array of depth. While it is borrowed, nothing else of Rust writes to it; Python's own threads have to see to that
/// themselves.
#[derive(FromPyObject)]
enum DepthArray<'py> {
    Integers(PyReadonlyArray2<'py, u16>),
    Floats(PyReadonlyArray2<'py, f32>),
    Doubles(PyReadonlyArray2<'py, f64>),
}

#[derive(FromPyObject)]
enum MaskArray<'py> {
    Bools(PyReadonlyArray2<'py, bool>),
    Bytes(PyReadonlyArray2<'py, u8>),
}

/// What such frames are called in messages.
const NAME: &str = "arrays";

impl Arrays<'_> {
    /// The frames, which borrow from the arrays.
    pub fn recording(&self, py: Python<'_>) -> PyResult<Recording<'_>> {
        let told = self.frames().map_err(|error| raised(py, &error))?;
        Ok(Recording::Other(Box::new(told)))
    }

    fn frames(&self) -> Result<BorrowedFrames<'_>, CallError> {
        let info = CameraInfo::parse(Path::new(&self.camera_name), &self.camera)?;
        let integers = matches!(self.depth.first(), Some(DepthArray::Integers(_)));
        let unit = self.unit(integers, info.depth_unit_m)?;
        let frames = BorrowedFrames::new(info.camera).named(NAME);
        let frames = match info.frame_id {
            Some(frame_id) => frames.with_camera_frame_id(frame_id),
            None => frames,
        };
        let mut frames = if integers { frames.of_integers(unit) } else { frames.of_floats(unit) };
        let factor = unit.metres() as f32;
        let mut masks = self.masks.iter();
        for ((name, depth), joints) in self.names.iter().zip(&self.depth).zip(&self.joints) {
            frames.push(BorrowedFrame {
                name: name.clone(),
                depth: depth.image(factor),
                mask: masks.next().map(MaskArray::mask),
                joints: joints.iter().map(|(name, at)| (name.clone(), *at)).collect(),
            })?;
        }
        for depth in &self.backgrounds {
            frames.push_background(depth.image(factor));
        }
        Ok(frames)
    }

    fn unit(&self, integers: bool, of_camera_m: Option<f64>) -> Result<DepthUnit, CallError> {
        if let Some(text) = &self.depth_unit {
            let known =
                DepthUnit::parse(text).filter(|unit| !integers || *unit != DepthUnit::METRES);
            return known.ok_or_else(|| {
                CallError::of_text(&format!(
                    "`depth_unit`: {text:?} cannot be the unit of this depth. Give mm, or the metres of one, as in \
                     0.0001 or 1/5000; of floats also m"
                ))
            });
        }
        let of_camera = of_camera_m.filter(|_| integers).and_then(DepthUnit::of_metres);
        let usual = if integers { DepthUnit::MILLIMETRES } else { DepthUnit::METRES };
        Ok(of_camera.unwrap_or(usual))
    }
}

impl DepthArray<'_> {
    /// The image that it is in metres, `factor` of which one number is.
    fn image(&self, factor: f32) -> Make<'_, DepthImage> {
        // What drivers store where they saw nothing, and never 65 m.
        let whole = |value: &u16| if *value == u16::MAX { 0.0 } else { f32::from(*value) };
        match self {
            Self::Integers(array) => {
                let view = array.as_array();
                Box::new(move || of_view(&view, |value| whole(value) * factor))
            }
            Self::Floats(array) => {
                let view = array.as_array();
                Box::new(move || of_view(&view, |value| value * factor))
            }
            Self::Doubles(array) => {
                let view = array.as_array();
                Box::new(move || of_view(&view, |value| *value as f32 * factor))
            }
        }
    }
}

fn of_view<T>(
    view: &ArrayView2<'_, T>,
    metres: impl Fn(&T) -> f32,
) -> Result<DepthImage, ImageError> {
    let (rows, columns) = view.dim();
    let depth_m = match view.to_slice() {
        Some(values) => values.iter().map(metres).collect(),
        None => view.iter().map(metres).collect(),
    };
    DepthImage::new(side(columns), side(rows), depth_m)
}

impl MaskArray<'_> {
    fn mask(&self) -> Make<'_, Mask> {
        match self {
            Self::Bools(array) => {
                let view = array.as_array();
                Box::new(move || {
                    let (rows, columns) = view.dim();
                    Mask::new(side(columns), side(rows), view.iter().copied().collect())
                })
            }
            Self::Bytes(array) => {
                let view = array.as_array();
                Box::new(move || {
                    let (rows, columns) = view.dim();
                    let set = view.iter().map(|value| *value != 0).collect();
                    Mask::new(side(columns), side(rows), set)
                })
            }
        }
    }
}

/// No camera has a side that does not fit; what has is refused for its size.
fn side(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}
