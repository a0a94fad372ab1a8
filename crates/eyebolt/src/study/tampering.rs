//! What goes wrong with a recording after it was made.

use super::kind::Kind;
use crate::robots::{BUILT_IN, BuiltIn};
use eyebolt_geometry::DepthImage;
use eyebolt_recording::{Frame, FrameSource, InMemory, Range, RecordingError};
use eyebolt_render::Random;
use eyebolt_robot::{Arm, JointPositions};
use std::fmt;

/// What goes wrong with a recording after it was made.
#[derive(Clone, Debug, PartialEq)]
pub enum Tampering {
    /// It is calibrated by the description of this robot, whose joints its own are named after.
    OtherRobot(&'static BuiltIn),
    /// These two joints have each other's positions.
    ExchangedJoints([String; 2]),
    /// All depth is multiplied by this.
    DepthUnit(f64),
    /// Positions of joints are in degrees.
    Degrees,
}

impl fmt::Display for Tampering {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OtherRobot(other) => write!(f, "described as {}", other.name),
            Self::ExchangedJoints([one, other]) => write!(f, "{one} and {other} exchanged"),
            Self::DepthUnit(factor) => write!(f, "depth times {factor}"),
            Self::Degrees => f.write_str("joints in degrees"),
        }
    }
}

impl Tampering {
    /// One of `kind` for a recording of `robot`; `None` if `kind` is of another sort.
    pub fn draw(kind: Kind, robot: &'static BuiltIn, random: &mut Random) -> Option<Self> {
        match kind {
            Kind::OtherRobot => {
                let others: Vec<_> = BUILT_IN.iter().filter(|other| *other != robot).collect();
                Some(Self::OtherRobot(others[random.index(others.len())]))
            }
            Kind::JointOrder => {
                let arm = robot.arm();
                let mut names = arm.required_joints();
                let first = names.remove(random.index(names.len()));
                let second = names[random.index(names.len())];
                Some(Self::ExchangedJoints([first, second].map(str::to_owned)))
            }
            Kind::WrongUnit => Some(match random.index(3) {
                0 => Self::DepthUnit(1000.0),
                1 => Self::DepthUnit(0.001),
                _ => Self::Degrees,
            }),
            _ => None,
        }
    }

    /// The recording of `source`, which is of `arm`, after it went wrong.
    ///
    /// # Errors
    ///
    /// What no source of frames takes, such as depth of a kilometre.
    pub fn apply(&self, source: &InMemory, arm: &Arm) -> Result<InMemory, RecordingError> {
        let Some(camera) = source.camera() else { return Ok(source.clone()) };
        let mut spoiled = InMemory::new(camera.clone()).named("simulated");
        for index in 0..source.background_count() {
            spoiled.push_background(self.depth(source.read_background(index)?))?;
        }
        for index in 0..source.frame_names().len() {
            let Frame { name, range, joints, .. } = source.read_frame(index)?;
            let Range::Depth(depth) = range else { continue };
            spoiled.push(name, self.depth(depth), self.joints(&joints, arm))?;
        }
        Ok(spoiled)
    }

    fn depth(&self, depth: DepthImage) -> DepthImage {
        let Self::DepthUnit(factor) = self else { return depth };
        let (width, height) = (depth.width(), depth.height());
        let scaled = depth.into_depth_m().into_iter().map(|z| z * *factor as f32).collect();
        DepthImage::new(width, height, scaled).expect("as many pixels as before")
    }

    fn joints(&self, joints: &JointPositions, arm: &Arm) -> JointPositions {
        let named = |(name, position): (&str, f64)| (name.to_owned(), position);
        match self {
            Self::OtherRobot(other) => renamed(joints, arm, &other.arm()),
            Self::ExchangedJoints([one, other]) => {
                let exchanged = |(name, position): (&str, f64)| {
                    let from = match name {
                        name if name == one => other,
                        name if name == other => one,
                        _ => return named((name, position)),
                    };
                    (name.to_owned(), joints.get(from).unwrap_or(position))
                };
                joints.iter().map(exchanged).collect()
            }
            Self::DepthUnit(_) => joints.clone(),
            Self::Degrees => joints.iter().map(|(n, at)| named((n, at.to_degrees()))).collect(),
        }
    }
}

/// The joints of `arm` by the names of `other`'s, in the order of the chain. Where that has more of
/// them, the rest stand at 0.
fn renamed(joints: &JointPositions, arm: &Arm, other: &Arm) -> JointPositions {
    let ours = arm.required_joints().into_iter().map(|name| joints.get(name).unwrap_or(0.0));
    let ours = ours.chain(std::iter::repeat(0.0));
    other.required_joints().into_iter().map(str::to_owned).zip(ours).collect()
}
