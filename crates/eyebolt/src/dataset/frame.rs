//! One frame of a data set, as a file of arrays.

use super::classes::code;
use super::description::Description;
use super::npz::{Array, npz};
use crate::label::LabelledFrame;
use eyebolt_geometry::{Camera, DepthImage, EndEffector, PinholeCamera, Transform};
use eyebolt_registration::Label;
use eyebolt_robot::JointPositions;
use nalgebra::Point3;

/// One frame of a data set. Vectors of pixels are row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct DatasetFrame {
    /// Depth along z, metres; 0 where there is none.
    pub depth: DepthImage,
    /// The camera, whose images are of the size of `depth`.
    pub camera: PinholeCamera,
    /// What each pixel shows; [`Label::Ignore`] where nobody can say, and without depth.
    pub labels: Vec<Label>,
    /// The keypoint that each pixel belongs to, from 1; 0 for none.
    pub keypoints: Vec<u8>,
    /// Pose of the end-effector link.
    pub camera_from_end_effector: Transform<Camera, EndEffector>,
    /// Where all keypoints are, seen or not, in the order of their classes; camera frame, metres. Not
    /// numbers on a finger whose joint was not recorded.
    pub keypoints_in_camera: Vec<Point3<f64>>,
    /// Positions of the arm's joints and of the end-effector's own, as far as they were recorded; radians,
    /// metres.
    pub joints: JointPositions,
}

impl DatasetFrame {
    /// Of a frame that was labelled; `joints` are all that the data set tells.
    pub(super) fn new(
        frame: LabelledFrame,
        camera: &PinholeCamera,
        joints: JointPositions,
    ) -> Self {
        let LabelledFrame {
            depth,
            labels,
            keypoints,
            camera_from_end_effector,
            keypoints_in_camera,
            ..
        } = frame;
        Self {
            depth,
            camera: camera.clone(),
            labels,
            keypoints,
            camera_from_end_effector,
            keypoints_in_camera,
            joints,
        }
    }

    /// The file, for a data set of this description; the same bytes for the same frame.
    pub(super) fn encode(&self, description: &Description) -> Vec<u8> {
        let image = [self.depth.height() as usize, self.depth.width() as usize];
        let camera = &self.camera;
        let matrix = [camera.fx(), 0.0, camera.cx(), 0.0, camera.fy(), camera.cy(), 0.0, 0.0, 1.0];
        // Columns of the transpose are rows.
        let pose = self.camera_from_end_effector.matrix().transpose();
        let keypoints = self.keypoints_in_camera.iter().flat_map(|p| [p.x, p.y, p.z]);
        let names = &description.robot.joints;
        let joints = names.iter().map(|name| self.joints.get(name).unwrap_or(f64::NAN));
        npz(&[
            Array::float32("depth_m", &image, self.depth.depth_m().iter().copied()),
            Array::uint8("label", &image, self.labels.iter().map(|label| code(*label))),
            Array::uint8("keypoint", &image, self.keypoints.iter().copied()),
            Array::float64("camera_matrix", &[3, 3], matrix),
            Array::float64("distortion", &[8], camera.distortion().coefficients()),
            Array::float64("camera_from_end_effector", &[4, 4], pose.iter().copied()),
            Array::float64(
                "keypoints_in_camera_m",
                &[self.keypoints_in_camera.len(), 3],
                keypoints,
            ),
            Array::float64("joint_positions", &[names.len()], joints),
        ])
    }
}
