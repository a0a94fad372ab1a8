//! The end-effector in one frame, as the paper has it.

use crate::pose::{EndEffectorShape, Judge, Observed, PoseError, PoseEstimator, PoseMethod};
use eyebolt_geometry::{Base, Camera, DepthImage, EndEffector, PinholeCamera, Transform};
use eyebolt_registration::{KdTree, PointToPointOptions, Posture, point_to_point};
use nalgebra::{Isometry3, Point3};
use std::fmt;

/// An end-effector of which less is seen is no end-effector: its area as a share of its extent squared. The
/// paper's code asks for 2048 pixels of a Kinect, which are 0.006 square metres of a Panda's hand at a metre.
const LEAST_AREA: f64 = 0.1;
/// Nor is one whose box is so much smaller, as a share of its extent.
const LEAST_BOX: f64 = 0.4;

/// Tells poses of an end-effector from single frames, by rotation and translation (RPT) and by keypoints (KPM).
#[derive(Debug)]
pub struct FrameEstimator {
    estimator: PoseEstimator,
    /// Whether poses are refined point to point on the meshes.
    pub refines: bool,
}

/// Poses of the end-effector in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FramePoses {
    /// By rotation and translation.
    pub rpt: Option<Transform<Camera, EndEffector>>,
    /// By keypoints.
    pub kpm: Option<Transform<Camera, EndEffector>>,
}

/// Why a frame says nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Insane {
    /// Too little of the end-effector is seen.
    FewPixels {
        /// How many pixels.
        pixels: usize,
    },
    /// What is seen is too small.
    SmallBox {
        /// Diagonal of the box around it, metres.
        diagonal_m: f64,
    },
}

impl fmt::Display for Insane {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FewPixels { pixels } => write!(f, "only {pixels} pixels show the end-effector"),
            Self::SmallBox { diagonal_m } => {
                write!(f, "what shows the end-effector is only {diagonal_m:.2} m across")
            }
        }
    }
}

impl FramePoses {
    /// Those that there are.
    pub fn all(&self) -> impl Iterator<Item = Transform<Camera, EndEffector>> {
        self.rpt.into_iter().chain(self.kpm)
    }
}

impl FrameEstimator {
    /// By the networks of `estimator`.
    pub fn new(estimator: PoseEstimator, refines: bool) -> Self {
        Self { estimator, refines }
    }

    /// The end-effector.
    pub fn shape(&self) -> &EndEffectorShape {
        self.estimator.shape()
    }

    /// Poses of the end-effector whose pixels have that label in `depth`, its links as in `posture`.
    ///
    /// # Errors
    ///
    /// No memory.
    pub fn poses(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        label: &[u8],
        posture: &Posture,
    ) -> Result<Result<FramePoses, Insane>, PoseError> {
        let extent_m = self.shape().extent_m();
        let Some(observed) = Observed::new(depth, camera, label, extent_m) else {
            return Ok(Err(Insane::FewPixels { pixels: 0 }));
        };
        if let Some(insane) = insane(&observed, camera, extent_m) {
            return Ok(Err(insane));
        }
        let target = self.refines.then(|| KdTree::new(observed.points.clone()));
        let mut pose = |method: PoseMethod| -> Result<_, PoseError> {
            let Some(found) = self.estimator.first_word(&observed, posture, method)? else {
                return Ok(None);
            };
            let pose = match &target {
                None => *found.pose.isometry(),
                Some(target) => {
                    let mut judge = Judge::new(self.estimator.shape(), &observed);
                    refined(&mut judge, posture, &observed, target, &found.pose)
                }
            };
            Ok(Some(Transform::from_isometry(pose)))
        };
        Ok(Ok(FramePoses { rpt: pose(PoseMethod::Rpt)?, kpm: pose(PoseMethod::Kpm)? }))
    }
}

fn insane(observed: &Observed, camera: &PinholeCamera, extent_m: f64) -> Option<Insane> {
    let pixels = observed.pixels;
    let area_m2 = pixels as f64 * observed.middle().z.powi(2) / (camera.fx() * camera.fy());
    if area_m2 < LEAST_AREA * extent_m * extent_m {
        return Some(Insane::FewPixels { pixels });
    }
    let first = observed.points.first()?.coords;
    let bounds = observed.points.iter().fold((first, first), |(low, high), point| {
        (low.inf(&point.coords), high.sup(&point.coords))
    });
    let diagonal_m = f64::from((bounds.1 - bounds.0).norm());
    (diagonal_m < LEAST_BOX * extent_m).then_some(Insane::SmallBox { diagonal_m })
}

/// `pose` moved so that the points that the camera would see of the shape there lie on the points of `target`.
///
/// The paper's code takes the front half of points on the hand's meshes; what is drawn is its front for any
/// end-effector and from anywhere.
fn refined(
    judge: &mut Judge<'_>,
    posture: &Posture,
    observed: &Observed,
    target: &KdTree,
    pose: &Transform<Camera, Base>,
) -> Isometry3<f64> {
    let raster = judge.draw(posture, pose);
    let point = |at: usize| {
        let z = raster.depth_m(at)?;
        let [x, y] = observed.image.rays[at];
        Some(Point3::new(x * z, y * z, z))
    };
    let source: Vec<Point3<f32>> = raster.pixels().filter_map(point).collect();
    let options = PointToPointOptions::default();
    let motion = point_to_point(&source, target, &Isometry3::identity(), &options);
    motion.target_from_source * pose.isometry()
}
