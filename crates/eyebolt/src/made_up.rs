//! Observations made up for tests.

use crate::depth_noise::DepthNoise;
use crate::observations::{Background, Configuration, ImageSource, Observations};
use eyebolt_geometry::{Base, Camera, DepthImage, Distortion, PinholeCamera, RayTable, Transform};
use eyebolt_registration::{
    ArmLink, ArmModel, EVIDENCE_KINDS, IntrinsicsOffset, JointOffsets, LinkModel, MOST_JOINTS,
    OffsetDeviations, Posture, Refinement, StopReason,
};
use eyebolt_robot::TriangleMesh;
use nalgebra::{Matrix6, Point3, Vector6};
use std::sync::{Arc, LazyLock};

/// An arm that is a box with an edge of 0.3 m about the origin.
pub(crate) static BOX: LazyLock<ArmModel> = LazyLock::new(|| {
    let corner = |i: u32| {
        let side = |bit: u32| if i >> bit & 1 == 1 { 0.15 } else { -0.15 };
        Point3::new(side(0), side(1), side(2))
    };
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mesh = TriangleMesh { vertices: (0..8).map(corner).collect(), triangles };
    let model = Arc::new(LinkModel::build(&mesh));
    ArmModel::new(vec![ArmLink { name: "box".into(), model }])
});

/// A camera of this size and focal length (pixels) that looks straight ahead.
pub(crate) fn camera(width: u32, height: u32, focal: f64) -> PinholeCamera {
    let (cx, cy) = (0.5 * f64::from(width), 0.5 * f64::from(height));
    PinholeCamera::new(width, height, focal, focal, cx, cy, Distortion::None).unwrap()
}

/// One configuration of `arm` for each posture, of which `camera` saw the image beside it.
pub(crate) fn observations(
    camera: PinholeCamera,
    arm: &ArmModel,
    seen: Vec<(Posture, DepthImage)>,
) -> Observations {
    let images: Vec<&DepthImage> = seen.iter().map(|(_, depth)| depth).collect();
    let noise = DepthNoise::learn(&images);
    let configuration =
        |(number, (posture, depth)): (usize, (Posture, DepthImage))| Configuration {
            frames: vec![number.to_string()],
            depth,
            mask: None,
            base_from_end_effector: Transform::identity(),
            posture,
            joints_rad: Vec::new(),
        };
    Observations {
        background: Background::None,
        rays: RayTable::new(&camera),
        camera,
        optical_from_camera: Transform::identity(),
        source: ImageSource::DepthImages,
        arm: arm.clone(),
        configurations: seen.into_iter().enumerate().map(configuration).collect(),
        noise,
        unplaced_joints: Vec::new(),
        outside_limits: Vec::new(),
        spare_configurations: 0,
        untold_frames: 0,
    }
}

/// A refinement that ended at this pose and found nothing off.
pub(crate) fn refinement(camera_from_base: Transform<Camera, Base>) -> Refinement {
    Refinement {
        doubts: Vec::new(),
        camera_from_base,
        joint_offsets: JointOffsets::default(),
        joint_sigma_rad: [0.0; MOST_JOINTS],
        intrinsics: IntrinsicsOffset::default(),
        offset_prior: OffsetDeviations::NONE,
        nuisances: [0.0; EVIDENCE_KINDS],
        information: Matrix6::identity(),
        covariance: Matrix6::identity(),
        deviations: [0.001, 1.0],
        views: Vec::new(),
        left_out: Vec::new(),
        groups_left_out: Vec::new(),
        iterations: 1,
        last_step: Vector6::zeros(),
        stop: StopReason::Converged,
    }
}
