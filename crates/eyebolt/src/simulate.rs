//! Recordings of an arm and a camera that are not there: to try eyebolt without a robot, and to
//! judge it where the truth is known.
//!
//! [`plan`] decides where everything is, and [`Plan::record`] writes what the camera sees of it as
//! an ordinary recording. The truth goes into a record of its own, for [`crate::evaluate`].

mod body;
mod configurations;
mod faults;
mod record;
mod scene;
mod solids;
mod surroundings;
mod timeline;
mod true_view;
mod viewpoint;

pub use configurations::Rejected;
pub use faults::Faults;
pub use solids::Solid;
pub use true_view::TrueView;
pub use viewpoint::{PRESETS, Preset, Ranges, Viewpoint};

use crate::record::RecordError;
use body::ArmBody;
use configurations::{Onlooker, Pose, choose};
use eyebolt_geometry::{Base, Camera, CameraError, PinholeCamera, Transform};
use eyebolt_recording::WriteError;
use eyebolt_registration::LinkCache;
use eyebolt_render::{Random, RayScene, SceneMesh, Sensor};
use eyebolt_robot::Arm;
use nalgebra::Point3;
use surroundings::in_place;

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

/// Why something cannot be simulated.
#[derive(Debug, thiserror::Error)]
pub enum SimulateError {
    /// The robot's shapes cannot be read.
    #[error(transparent)]
    Robot(#[from] RecordError),
    /// Too few configurations are fit to be seen.
    #[error("only {found} configurations are fit to be seen, and {wanted} are wanted: {rejected}")]
    Unfit {
        /// How many were found.
        found: usize,
        /// How many were wanted.
        wanted: usize,
        /// Why the others were not.
        rejected: Rejected,
    },
    /// A camera is bumped between two configurations, and there is one.
    #[error("--bump: the camera is bumped halfway, so give at least two --configurations")]
    BumpOfOne,
    /// Faults leave the camera no valid intrinsics.
    #[error("--focal-scale, --centre-px: {0}; give a factor near 1 and a few pixels")]
    Intrinsics(#[from] CameraError),
    /// The recording cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Which stream of random numbers decides what: what is added later changes nothing else.
#[derive(Clone, Copy)]
enum Choice {
    Viewpoint = 1,
    Configurations,
    Room,
    Clutter,
    Specimen,
    Frames,
    Encoders,
    Bump,
}

impl Choice {
    fn of(self, seed: u64) -> Random {
        Random::new(seed).at(self as u64)
    }
}

/// Where everything is.
pub struct Plan<'a> {
    scenario: Scenario<'a>,
    body: ArmBody<'a>,
    /// The true intrinsics.
    camera: PinholeCamera,
    /// What the recording says they are.
    stated_camera: PinholeCamera,
    base_from_camera: Transform<Base, Camera>,
    /// Where the camera is after it was bumped, if it is.
    bumped: Option<Transform<Base, Camera>>,
    poses: Vec<Pose>,
    solids: Vec<Solid>,
}

/// Decides where everything of `scenario` is; `cache` keeps shapes of links.
///
/// # Errors
///
/// Shapes that cannot be read, a camera that hardly sees the end-effector, impossible intrinsics.
pub fn plan<'a>(scenario: Scenario<'a>, cache: &LinkCache) -> Result<Plan<'a>, SimulateError> {
    if scenario.faults.bump.is_some() && scenario.configurations < 2 {
        return Err(SimulateError::BumpOfOne);
    }
    let body = ArmBody::new(scenario.arm, cache)?;
    let camera = scenario.sensor.camera();
    let stated_camera = scenario.faults.intrinsics().stated(&camera)?;
    let seed = scenario.seed;
    let base_from_camera = scenario.viewpoint.base_from_camera(&mut Choice::Viewpoint.of(seed));
    let bumped = scenario.faults.bumped(&base_from_camera, &mut Choice::Bump.of(seed));
    let eye = base_from_camera.point(&Point3::origin());
    let mut solids = scene::room(&mut Choice::Room.of(seed), &eye);
    let room = RayScene::new(&solids.iter().map(in_place).collect::<Vec<_>>());
    let onlooker = Onlooker {
        camera: &camera,
        camera_from_base: base_from_camera.inverse(),
        range_m: scenario.sensor.range_m,
        told_m: [scenario.faults.depth_scale, scenario.faults.depth_offset_m],
        room: &room,
    };
    let random = Choice::Configurations.of(seed);
    let poses = choose(&body, &onlooker, scenario.configurations, random)?;
    solids.extend(surroundings::clutter_about(&scenario, &body, &poses, &eye));
    Ok(Plan { scenario, body, camera, stated_camera, base_from_camera, bumped, poses, solids })
}

impl Plan<'_> {
    /// The true pose of the base link in the camera's optical frame, when the recording begins.
    pub fn camera_from_base(&self) -> Transform<Camera, Base> {
        self.base_from_camera.inverse()
    }

    /// What stands around: the room, then the clutter.
    pub fn solids(&self) -> &[Solid] {
        &self.solids
    }

    /// The links of `arm`, then what stands around.
    fn scene(&self, arm: &[SceneMesh<'_>]) -> RayScene {
        let around = self.solids.iter().map(in_place);
        RayScene::new(&arm.iter().copied().chain(around).collect::<Vec<_>>())
    }
}
