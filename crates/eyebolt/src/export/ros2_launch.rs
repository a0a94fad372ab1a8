//! A launch file of ROS 2 that publishes the transform.

use super::placement::Placement;
use super::python_launch::python_launch;

pub(super) fn write(placement: &Placement) -> String {
    let title = ["Static transform of a camera calibrated by eyebolt.", "ros2 launch THIS_FILE"];
    python_launch(placement, title, &[])
}
