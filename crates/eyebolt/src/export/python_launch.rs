//! A launch file of ROS 2, in Python.

use super::placement::Placement;
use super::text::{meaning, quoted};
use super::tf2::options;

/// A launch file with one `static_transform_publisher`. `title` and `more` are comments; in `title`
/// no name may stand: Python looks for the file's encoding in its first two lines.
pub(super) fn python_launch(placement: &Placement, title: [&str; 2], more: &[String]) -> String {
    let comments = title.into_iter().map(str::to_owned).chain(meaning(placement));
    let comments = comments.chain(more.iter().cloned());
    let comments: String = comments.map(|comment| format!("# {comment}\n")).collect();
    let arguments: String = options(placement)
        .map(|(name, value)| format!("                {}, {},\n", quoted(name), quoted(&value)))
        .concat();
    format!(
        r#"{comments}from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            output="log",
            arguments=[
{arguments}            ],
        ),
    ])
"#
    )
}
