//! What never moves: the frames of the camera's driver, and the fixed joints of the robot.

use eyebolt_geometry::optical_from_body;
use eyebolt_recording::StaticTransform;
use eyebolt_robot::Robot;

/// The frames that drivers put above the optical one.
const LINK: &str = "camera_link";
const DEPTH: &str = "camera_depth_frame";
/// From the mount of the camera to its depth sensor, metres: most have another sensor beside it.
const MOUNT_TO_DEPTH_M: [f64; 3] = [0.0, 0.0175, 0.0125];

/// `/tf_static` as the driver of a camera with the frame `optical` and `robot_state_publisher` tell it.
pub(super) fn static_transforms(robot: &Robot, optical: &str) -> Vec<StaticTransform> {
    let body_from_optical = optical_from_body().inverse();
    let [x, y, z, w] = body_from_optical.coords.into();
    let edge = |parent: &str, child: &str, translation_m, rotation_xyzw| StaticTransform {
        parent: parent.to_owned(),
        child: child.to_owned(),
        translation_m,
        rotation_xyzw,
    };
    let camera = [
        edge(LINK, DEPTH, MOUNT_TO_DEPTH_M, [0.0, 0.0, 0.0, 1.0]),
        edge(DEPTH, optical, [0.0; 3], [x, y, z, w]),
    ];
    let fixed = robot.joints.iter().filter(|joint| !joint.moves()).filter_map(|joint| {
        let (parent, child) = (robot.links.get(joint.parent)?, robot.links.get(joint.child)?);
        let pose = &joint.parent_from_child_at_zero;
        Some(edge(&parent.name, &child.name, pose.translation_m().into(), pose.rotation_xyzw()))
    });
    camera.into_iter().chain(fixed).collect()
}
