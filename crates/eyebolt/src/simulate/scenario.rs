//! What to simulate.

use super::faults::Faults;
use super::viewpoint::Viewpoint;
use eyebolt_render::Sensor;
use eyebolt_robot::Arm;

/// What to simulate.
#[derive(Clone, Debug)]
pub struct Scenario<'a> {
    /// The arm.
    pub arm: &'a Arm,
    /// Text of its URDF, which goes into the recording.
    pub urdf: &'a str,
    /// The camera.
    pub sensor: Sensor,
    /// Where it stands.
    pub viewpoint: Viewpoint,
    /// How many configurations the arm rests in.
    pub configurations: usize,
    /// Frames of each.
    pub frames: usize,
    /// Frames on each way from one to the next.
    pub moving_frames: usize,
    /// Frames without the arm.
    pub backgrounds: usize,
    /// Things that stand about.
    pub clutter: usize,
    /// What goes wrong.
    pub faults: Faults,
    /// Of all random choices. The same seed gives the same bytes on any number of threads.
    pub seed: u64,
}
