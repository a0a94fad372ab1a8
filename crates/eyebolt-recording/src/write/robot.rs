//! What is written of the robot.

/// The robot of a recording, for those who read it later.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteRobot {
    /// Text of the URDF, the only one that is then written, whatever the recording has. Without it
    /// a bag's own is copied.
    pub urdf: Option<String>,
    /// Name of the base link.
    pub base: Option<String>,
    /// Name of the end-effector link.
    pub end_effector: Option<String>,
}
