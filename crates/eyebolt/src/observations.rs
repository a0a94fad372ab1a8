//! What a calibration works on: arm configurations as one camera saw them.
//!
//! Observations never change after they are made: whatever is found out about them, such as joint
//! offsets, is part of the answer.

use crate::depth_noise::DepthNoise;
use crate::joint_limits::OutsideLimits;
use eyebolt_geometry::{
    Base, Camera, DepthImage, EndEffector, Mask, PinholeCamera, RayTable, Transform,
};
use eyebolt_registration::{ArmModel, Posture, View};
use nalgebra::{Point3, Vector3};

/// Arm configurations, the camera that saw them and the arm.
#[derive(Clone, Debug)]
pub struct Observations {
    /// The camera that the depth images are of.
    pub camera: PinholeCamera,
    /// Its rays.
    pub rays: RayTable,
    /// Turns from the frame of `camera` to the optical frame that answers are for. Only clouds that
    /// came without a camera make these two differ.
    pub optical_from_camera: Transform<Camera, Camera>,
    /// Where the depth images come from.
    pub source: ImageSource,
    /// Shapes of the arm's links.
    pub arm: ArmModel,
    /// The configurations, in the order of the recording.
    pub configurations: Vec<Configuration>,
    /// The scene without the arm.
    pub background: Background,
    /// By how much depth differs from one configuration to the next where nothing moved.
    pub noise: DepthNoise,
    /// Joints outside the chain that the recording does not have: the links behind them take no part.
    pub unplaced_joints: Vec<String>,
    /// Joints of the arm that were recorded outside their limits, each where it is farthest out.
    pub outside_limits: Vec<OutsideLimits>,
    /// How many more configurations the recording has, much like those that are used.
    pub spare_configurations: usize,
    /// Number of frames left out, since a joint of the arm was not told then.
    pub untold_frames: usize,
}

/// What is known of the scene without the arm.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Background {
    /// The recording has no frames of it.
    #[default]
    None,
    /// Its depth, of the camera's size.
    Seen(DepthImage),
    /// The recording's background shows another scene, or this one from another place: it was not
    /// used.
    OfAnotherScene,
}

impl Background {
    /// Its depth, if it is known.
    pub fn depth(&self) -> Option<&DepthImage> {
        match self {
            Self::Seen(depth) => Some(depth),
            Self::None | Self::OfAnotherScene => None,
        }
    }
}

/// Where the depth images of observations come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ImageSource {
    /// The recording has depth images and their camera.
    DepthImages,
    /// Organised clouds without a camera, whose grid tells it to this accuracy.
    OrganisedClouds {
        /// Root mean square distance of the points from their pixels.
        residual_px: f64,
    },
    /// Clouds, drawn as the recording's camera sees them.
    ProjectedClouds,
    /// Clouds without a camera or a grid that tells one, drawn as a camera made up for them sees
    /// them.
    DrawnClouds,
}

/// One arm configuration, of one frame or several merged.
#[derive(Clone, Debug)]
pub struct Configuration {
    /// Names of its frames in the recording; at least one.
    pub frames: Vec<String>,
    /// What the camera saw.
    pub depth: DepthImage,
    /// The whole arm's pixels, where the recording has them.
    pub mask: Option<Mask>,
    /// Where the joints put the end-effector.
    pub base_from_end_effector: Transform<Base, EndEffector>,
    /// Where they put the links.
    pub posture: Posture,
    /// Where the joints of the arm's model say they are, radians, in the order of
    /// [`ArmModel::joints`].
    pub joints_rad: Vec<f64>,
}

impl Observations {
    /// The views of all configurations.
    pub fn views(&self) -> Vec<View<'_>> {
        self.configurations.iter().map(|c| self.view(c)).collect()
    }

    /// Middle of where the end-effector was over all configurations.
    pub fn workspace(&self) -> Point3<f64> {
        let tips = self.configurations.iter().map(|c| c.base_from_end_effector.translation_m());
        Point3::from(tips.sum::<Vector3<f64>>() / self.configurations.len().max(1) as f64)
    }

    /// One configuration as registration sees it.
    pub fn view<'a>(&'a self, configuration: &'a Configuration) -> View<'a> {
        View {
            camera: &self.camera,
            depth: &configuration.depth,
            depth_factor: 1.0,
            mask: configuration.mask.as_ref(),
            posture: &configuration.posture,
        }
    }

    /// Whether the recording says which pixels are the arm.
    pub fn has_masks(&self) -> bool {
        self.configurations.iter().all(|c| c.mask.is_some())
    }
}
