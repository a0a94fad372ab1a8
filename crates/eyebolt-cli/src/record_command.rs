//! `eyebolt record-command`.

use crate::ending::Ending;
use crate::output;
use crate::shell::quoted;
use anyhow::Result;

/// Options of `eyebolt record-command`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Whose camera driver runs
    #[arg(long, value_enum, default_value_t)]
    driver: Driver,
    /// Topic of the depth, if the driver is another or has another name; camera_info is beside it
    #[arg(long, value_name = "TOPIC", conflicts_with = "driver")]
    depth_topic: Option<String>,
    /// Topic of the joint states
    #[arg(long, value_name = "TOPIC", default_value = "/joint_states")]
    joint_topic: String,
    /// Name of the bag
    #[arg(short, long, value_name = "FOLDER", default_value = "my_bag")]
    output: String,
    /// For ROS 2 Humble and Iron, which take topics without --topics
    #[arg(long)]
    humble: bool,
}

/// Drivers of depth cameras, by the names of their topics today.
#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
pub enum Driver {
    /// realsense-ros 4.54 and later
    #[default]
    Realsense,
    /// Orbbec SDK ROS 2
    Orbbec,
    /// Azure Kinect ROS driver
    AzureKinect,
    /// zed-ros2-wrapper
    Zed,
}

impl Driver {
    fn depth_topic(self) -> &'static str {
        match self {
            Self::Realsense => "/camera/camera/depth/image_rect_raw",
            Self::Orbbec => "/camera/depth/image_raw",
            Self::AzureKinect => "/depth/image_raw",
            Self::Zed => "/zed/zed_node/depth/depth_registered",
        }
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    let depth = arguments.depth_topic.as_deref().unwrap_or(arguments.driver.depth_topic());
    let line = line(depth, &arguments.joint_topic, &arguments.output, arguments.humble);
    output::deliver(format!("{line}\n").as_bytes())?;
    Ok(Ending::Done)
}

/// The command for a RealSense, as anybody would begin.
pub fn usual() -> String {
    line(Driver::default().depth_topic(), "/joint_states", "my_bag", false)
}

fn line(depth: &str, joints: &str, output: &str, humble: bool) -> String {
    let above = depth.rsplit_once('/').map_or("", |(above, _)| above);
    let info = format!("{above}/camera_info");
    let topics = [depth, &info, joints, "/robot_description", "/tf_static"];
    let topics = topics.map(quoted).join(" ");
    let option = if humble { "" } else { " --topics" };
    format!("ros2 bag record -s mcap -o {}{option} {topics}", quoted(output))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intrinsics_are_beside_the_depth() {
        let said = line("/a/depth/image raw", "/joint_states", "bag", true);
        assert_eq!(
            said,
            "ros2 bag record -s mcap -o bag '/a/depth/image raw' /a/depth/camera_info \
             /joint_states /robot_description /tf_static"
        );
        assert!(usual().contains(" --topics /camera/camera/depth/image_rect_raw "));
    }
}
