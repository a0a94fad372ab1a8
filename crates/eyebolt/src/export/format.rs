//! The forms in which a placement can be written.

use super::placement::Placement;
use super::{csv, easy_handeye, easy_handeye2, mcap, moveit, npy, ros2_launch, tf2, urdf};

/// A form in which a placement can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Command for ROS 2.
    Tf2,
    /// Command for ROS 1.
    Tf2Ros1,
    /// Python launch file for ROS 2.
    Ros2Launch,
    /// File of easy_handeye2.
    EasyHandeye2,
    /// File of easy_handeye.
    EasyHandeye,
    /// What MoveIt Calibration saves, for ROS 2.
    Moveit,
    /// What MoveIt Calibration saves, for ROS 1.
    MoveitRos1,
    /// Fixed joint.
    Urdf,
    /// Matrix as text.
    Csv,
    /// Matrix of NumPy.
    Npy,
    /// `/tf_static` of ROS 2 in MCAP.
    Mcap,
}

impl Format {
    /// All of them, those most in use first.
    pub const ALL: [Self; 11] = [
        Self::Tf2,
        Self::Tf2Ros1,
        Self::Ros2Launch,
        Self::EasyHandeye2,
        Self::EasyHandeye,
        Self::Moveit,
        Self::MoveitRos1,
        Self::Urdf,
        Self::Csv,
        Self::Npy,
        Self::Mcap,
    ];

    /// What a person calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tf2 => "tf2",
            Self::Tf2Ros1 => "tf2-ros1",
            Self::Ros2Launch => "ros2-launch",
            Self::EasyHandeye2 => "easy-handeye2",
            Self::EasyHandeye => "easy-handeye",
            Self::Moveit => "moveit",
            Self::MoveitRos1 => "moveit-ros1",
            Self::Urdf => "urdf",
            Self::Csv => "csv",
            Self::Npy => "npy",
            Self::Mcap => "mcap",
        }
    }

    /// What it is, in a line.
    pub fn summary(self) -> &'static str {
        match self {
            Self::Tf2 => {
                "Command of ROS 2: ros2 run tf2_ros static_transform_publisher, quaternion"
            }
            Self::Tf2Ros1 => "Command of ROS 1: rosrun tf2_ros ..., x y z qx qy qz qw parent child",
            Self::Ros2Launch => "Launch file of ROS 2 (camera.launch.py) with the same publisher",
            Self::EasyHandeye2 => {
                "eye_on_base file of easy_handeye2, for ~/.ros2/easy_handeye2/calibrations/NAME.calib"
            }
            Self::EasyHandeye => {
                "eye-on-base file of easy_handeye (ROS 1), for ~/.ros/easy_handeye/NAME.yaml"
            }
            Self::Moveit => "Launch file of ROS 2 as MoveIt Calibration saves the camera's pose",
            Self::MoveitRos1 => "The same for ROS 1 (camera.launch, XML)",
            Self::Urdf => {
                "Fixed joint and link; rpy about fixed axes, R = Rz(yaw) Ry(pitch) Rx(roll)"
            }
            Self::Csv => "4 x 4 matrix that maps child to parent: a row a line, metres, no header",
            Self::Npy => {
                "The same matrix for numpy.load: float64, C order; needs argument `output`"
            }
            Self::Mcap => "/tf_static in an MCAP for Foxglove or ros2 bag; needs argument `output`",
        }
    }

    /// How names of its files end, the usual one first.
    pub fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Tf2 | Self::Tf2Ros1 => &["sh", "txt", "bash"],
            Self::Ros2Launch | Self::Moveit => &["py"],
            Self::EasyHandeye2 => &["calib", "yaml", "yml"],
            Self::EasyHandeye => &["yaml", "yml"],
            Self::MoveitRos1 => &["launch", "xml"],
            Self::Urdf => &["urdf", "xacro", "xml"],
            Self::Csv => &["csv", "txt"],
            Self::Npy => &["npy"],
            Self::Mcap => &["mcap"],
        }
    }

    /// Whether it is for somebody who publishes it on tf, and not for people who compute with it.
    pub fn is_published(self) -> bool {
        !matches!(self, Self::Csv | Self::Npy)
    }

    /// The placement in this form: UTF-8 text that ends with a line break, but for
    /// [`Format::Npy`] and [`Format::Mcap`].
    ///
    /// `name` is what the file of a hand-eye calibration calls itself; characters that ROS does not
    /// allow in names become underscores.
    pub fn write(self, placement: &Placement, name: &str) -> Vec<u8> {
        let text = match self {
            Self::Tf2 => tf2::ros2(placement),
            Self::Tf2Ros1 => tf2::ros1(placement),
            Self::Ros2Launch => ros2_launch::write(placement),
            Self::EasyHandeye2 => easy_handeye2::write(placement, name),
            Self::EasyHandeye => easy_handeye::write(placement, name),
            Self::Moveit => moveit::ros2(placement),
            Self::MoveitRos1 => moveit::ros1(placement),
            Self::Urdf => urdf::write(placement),
            Self::Csv => csv::write(placement),
            Self::Npy => return npy::write(placement),
            Self::Mcap => return mcap::write(placement),
        };
        text.into_bytes()
    }
}
