//! What is written of the robot.

/// The robot of a recording, for those who read it later.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteRobot {
    /// Text of the URDF.
    pub urdf: Option<String>,
    /// Name of the base link.
    pub base: Option<String>,
    /// Name of the end-effector link.
    pub end_effector: Option<String>,
}
