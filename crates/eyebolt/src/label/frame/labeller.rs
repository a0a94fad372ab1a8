//! One frame after the other, with what is known of the whole recording.

use super::backdrop::Backdrop;
use super::classes::Judge;
use super::consistency::{Consistency, Contradiction};
use super::keypoints;
use super::near::Near;
use super::outline::Outline;
use crate::end_effector::EndEffector;
use crate::observations::Observations;
use crate::record::posture;
use eyebolt_geometry::{
    Base, Camera, DepthImage, EndEffector as EndEffectorFrame, Mask, PinholeCamera, RayTable,
    Transform,
};
use eyebolt_registration::{Label, Start};
use eyebolt_render::Raster;
use eyebolt_robot::{Arm, JointPositions, KinematicsError};
use nalgebra::Point3;

/// Labels frames of a recording whose calibration is known.
#[derive(Debug)]
pub struct FrameLabeller<'a> {
    observations: &'a Observations,
    arm: &'a Arm,
    end_effector: &'a EndEffector,
    at: Start,
    /// The camera that the calibration found, and its rays.
    camera: PinholeCamera,
    rays: RayTable,
    backdrop: Backdrop,
}

/// A frame with its labels. Vectors have an entry for each pixel, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelledFrame {
    /// Depth, with the error of its scale corrected.
    pub depth: DepthImage,
    /// What each pixel shows; [`Label::Ignore`] where nobody can say, and without depth.
    pub labels: Vec<Label>,
    /// The keypoint that each pixel belongs to, from 1; 0 for none.
    pub keypoints: Vec<u8>,
    /// Pose of the end-effector link in the camera of the images, with joint offsets corrected.
    pub camera_from_end_effector: Transform<Camera, EndEffectorFrame>,
    /// Where every keypoint is, whether it is seen or not; camera frame, metres. Not numbers on a finger
    /// whose joint was not recorded.
    pub keypoints_in_camera: Vec<Point3<f64>>,
    /// What speaks against the labels of the whole frame.
    pub contradiction: Option<Contradiction>,
}

impl<'a> FrameLabeller<'a> {
    /// For frames of the recording of `observations` with `arm` posed as `at` has it.
    pub fn new(
        observations: &'a Observations,
        arm: &'a Arm,
        end_effector: &'a EndEffector,
        at: Start,
    ) -> Self {
        let camera = corrected(&observations.camera, &at);
        let rays = RayTable::new(&camera);
        let backdrop = Backdrop::learn(observations, &camera, &at);
        Self { observations, arm, end_effector, at, camera, rays, backdrop }
    }

    /// The camera of the images as the calibration found it.
    pub fn camera(&self) -> &PinholeCamera {
        &self.camera
    }

    /// Labels what the camera saw with the joints at `joints`; `mask` are the arm's pixels, where
    /// somebody marked them. `None` if a link hangs on a joint that has no position.
    ///
    /// # Errors
    ///
    /// Joints that do not place the arm.
    pub fn label(
        &self,
        depth: &DepthImage,
        mask: Option<&Mask>,
        joints: &JointPositions,
    ) -> Result<Option<LabelledFrame>, KinematicsError> {
        let (model, at) = (&self.observations.arm, &self.at);
        let Some(recorded) = posture(self.arm, model, joints)? else { return Ok(None) };
        let posture = recorded.moved(model, &at.joint_offsets);
        let hand = (0..model.links().len()).find(|link| model.is_end_effector(*link));
        // Offsets turn the hand with every link of it.
        let moved = |link: usize| {
            posture.base_from_link()[link] * recorded.base_from_link()[link].inverse()
        };
        let base_from_base = hand.map_or(Transform::<Base, Base>::identity(), moved);
        let base_from_end_effector = base_from_base * self.arm.base_from_end_effector(joints)?;
        let camera_from_end_effector = at.camera_from_base * base_from_end_effector;

        let depth = scaled(depth, at.depth_factor());
        let mut raster = Raster::new(&self.camera);
        raster.draw(&self.camera, &posture.meshes(model, &at.camera_from_base));
        let outline = Outline::new(model, &raster, mask);
        let near = Near::new(model, &posture, &self.rays, &depth, &at.camera_from_base, &outline);
        let judge = Judge {
            noise: &self.observations.noise,
            backdrop: &self.backdrop,
            outline: &outline,
            raster: &raster,
            near: &near,
            masked: mask.is_some(),
        };
        let labels = judge.labels(&depth);
        let consistency = Consistency::of(&judge, &depth);
        let keypoints_in_camera: Vec<Point3<f64>> = self
            .end_effector
            .known_keypoints(joints)
            .iter()
            .map(|keypoint| keypoint.map_or(UNKNOWN, |at| camera_from_end_effector.point(&at)))
            .collect();
        let keypoints = keypoints::classes(&keypoints_in_camera, &labels, &depth, &self.rays);
        Ok(Some(LabelledFrame {
            contradiction: consistency.contradiction(),
            depth,
            labels,
            keypoints,
            camera_from_end_effector,
            keypoints_in_camera,
        }))
    }
}

/// Where a keypoint is on a finger that may be anywhere.
const UNKNOWN: Point3<f64> = Point3::new(f64::NAN, f64::NAN, f64::NAN);

fn scaled(depth: &DepthImage, factor: f32) -> DepthImage {
    let depth_m = depth.depth_m().iter().map(|z| factor * z).collect();
    DepthImage::new(depth.width(), depth.height(), depth_m).expect("as many pixels as before")
}

/// The camera with the intrinsics that the calibration found.
fn corrected(camera: &PinholeCamera, at: &Start) -> PinholeCamera {
    let (longer, [x, y]) = (1.0 + at.intrinsics.focal, at.intrinsics.centre);
    let (width, height) = (camera.width(), camera.height());
    let (fx, fy) = (longer * camera.fx(), longer * camera.fy());
    let (cx, cy) = (camera.cx() + x * camera.fx(), camera.cy() + y * camera.fy());
    let corrected = PinholeCamera::new(width, height, fx, fy, cx, cy, *camera.distortion());
    corrected.unwrap_or_else(|_| camera.clone())
}
