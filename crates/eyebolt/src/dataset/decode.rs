//! A frame from its file: what is not a frame of the data set is refused, and said how.

use super::classes::label;
use super::description::Description;
use super::error::DatasetError;
use super::frame::DatasetFrame;
use super::npz::Archive;
use eyebolt_geometry::{Camera, DepthImage, Distortion, EndEffector, PinholeCamera, Transform};
use eyebolt_recording::{Dtype, Number};
use eyebolt_registration::Label;
use eyebolt_robot::JointPositions;
use nalgebra::{Matrix4, Point3};
use std::path::Path;

/// What to do about a frame that says what it cannot.
const REMEDY: &str = "Remove the file and label the recording again";
/// By how much a matrix may differ from that of a rigid motion.
const RIGID: f64 = 1e-6;

impl DatasetFrame {
    /// From the content of the file at `path`, of a data set of this description.
    pub(super) fn decode(
        path: &Path,
        bytes: &[u8],
        description: &Description,
    ) -> Result<Self, DatasetError> {
        let file = File { path, archive: Archive::open(path, bytes)? };
        let depth = file.depth()?;
        let image = [depth.height() as usize, depth.width() as usize];
        let camera = file.camera(&depth)?;
        let keypoint_count = description.keypoints.len();
        let names = &description.robot.joints;
        let positions = file.numbers_if_known("joint_positions", &[names.len()])?;
        let points = file.numbers_if_known("keypoints_in_camera_m", &[keypoint_count, 3])?;
        let (points, _) = points.as_chunks::<3>();
        Ok(Self {
            labels: file.labels(&image)?,
            keypoints: file.keypoints(&image, keypoint_count)?,
            camera_from_end_effector: file.pose()?,
            keypoints_in_camera: points.iter().map(|point| Point3::from(*point)).collect(),
            joints: names
                .iter()
                .cloned()
                .zip(positions)
                .filter(|(_, position)| !position.is_nan())
                .collect::<JointPositions>(),
            depth,
            camera,
        })
    }
}

/// The arrays of one file, read and checked.
struct File<'a> {
    path: &'a Path,
    archive: Archive<'a>,
}

impl File<'_> {
    fn invalid(&self, field: &str, problem: impl Into<String>) -> DatasetError {
        DatasetError::invalid(self.path, field, problem, REMEDY)
    }

    /// An array that has to be of this type and shape.
    fn array<T: Number>(
        &self,
        field: &str,
        dtype: Dtype,
        wanted: &[usize],
    ) -> Result<Vec<T>, DatasetError> {
        let (shape, values) = self.archive.array(field, &[dtype])?;
        if shape != wanted {
            let problem = format!("its shape is {shape:?}, but {wanted:?} is needed");
            return Err(self.invalid(field, problem));
        }
        Ok(values)
    }

    /// Numbers, NaN where they are not known.
    fn numbers_if_known(&self, field: &str, shape: &[usize]) -> Result<Vec<f64>, DatasetError> {
        let numbers: Vec<f64> = self.array(field, Dtype::Float64, shape)?;
        match numbers.iter().find(|number| number.is_infinite()) {
            Some(number) => Err(self.invalid(field, format!("{number} in it is no number"))),
            None => Ok(numbers),
        }
    }

    fn numbers(&self, field: &str, shape: &[usize]) -> Result<Vec<f64>, DatasetError> {
        let numbers: Vec<f64> = self.array(field, Dtype::Float64, shape)?;
        match numbers.iter().find(|number| !number.is_finite()) {
            Some(number) => Err(self.invalid(field, format!("{number} in it is no number"))),
            None => Ok(numbers),
        }
    }

    fn bytes(&self, field: &str, shape: &[usize]) -> Result<Vec<u8>, DatasetError> {
        let values: Vec<f32> = self.array(field, Dtype::Uint8, shape)?;
        // Every value was a byte.
        Ok(values.into_iter().map(|value| value as u8).collect())
    }

    fn depth(&self) -> Result<DepthImage, DatasetError> {
        const FIELD: &str = "depth_m";
        let (shape, depth_m) = self.archive.array::<f32>(FIELD, &[Dtype::Float32])?;
        let &[height, width] = shape.as_slice() else {
            return Err(self.invalid(FIELD, format!("its shape is {shape:?}, not H x W")));
        };
        if let Some(z) = depth_m.iter().find(|z| !z.is_finite() || **z < 0.0) {
            return Err(self.invalid(FIELD, format!("{z} is no depth; no depth is 0")));
        }
        let size = u32::try_from(width).ok().zip(u32::try_from(height).ok());
        let image = size.and_then(|(width, height)| DepthImage::new(width, height, depth_m).ok());
        image.ok_or_else(|| self.invalid(FIELD, format!("its shape is {shape:?}")))
    }

    fn camera(&self, depth: &DepthImage) -> Result<PinholeCamera, DatasetError> {
        const FIELD: &str = "camera_matrix";
        let matrix = self.numbers(FIELD, &[3, 3])?;
        let &[fx, s, cx, a, fy, cy, b, c, one] = matrix.as_slice() else {
            return Err(self.invalid(FIELD, "it has not nine numbers"));
        };
        if [s, a, b, c] != [0.0; 4] || one != 1.0 {
            return Err(self.invalid(FIELD, "it is not fx 0 cx, 0 fy cy, 0 0 1"));
        }
        let lens = self.numbers("distortion", &[8])?;
        let lens = lens.first_chunk::<8>().copied().unwrap_or_default();
        // Three coefficients fewer are the other model.
        let lens = match lens {
            [k1, k2, p1, p2, k3, 0.0, 0.0, 0.0] => Distortion::plumb_bob([k1, k2, p1, p2, k3]),
            lens => Distortion::rational_polynomial(lens),
        };
        PinholeCamera::new(depth.width(), depth.height(), fx, fy, cx, cy, lens)
            .map_err(|problem| self.invalid(FIELD, problem.to_string()))
    }

    fn labels(&self, image: &[usize]) -> Result<Vec<Label>, DatasetError> {
        let known = |code: u8| {
            let problem = || self.invalid("label", format!("{code} is the number of no class"));
            label(code).ok_or_else(problem)
        };
        self.bytes("label", image)?.into_iter().map(known).collect()
    }

    fn keypoints(&self, image: &[usize], count: usize) -> Result<Vec<u8>, DatasetError> {
        let classes = self.bytes("keypoint", image)?;
        match classes.iter().find(|class| usize::from(**class) > count) {
            Some(class) => {
                let problem = format!("{class} is the number of no keypoint; there are {count}");
                Err(self.invalid("keypoint", problem))
            }
            None => Ok(classes),
        }
    }

    fn pose(&self) -> Result<Transform<Camera, EndEffector>, DatasetError> {
        const FIELD: &str = "camera_from_end_effector";
        let numbers = self.numbers(FIELD, &[4, 4])?;
        let pose = Transform::from_matrix(&Matrix4::from_row_slice(&numbers), RIGID);
        pose.ok_or_else(|| self.invalid(FIELD, "it is not the matrix of a rigid motion"))
    }
}
