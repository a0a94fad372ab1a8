//! Images to learn from, made as they are needed.

use super::actor::{Actor, Pose};
use super::corrupt::corrupt;
use super::drawing::Drawing;
use super::error::TrainError;
use super::invented::invented_arm;
use super::look::{look_at_arm, look_from_near};
use super::scenery::scenery;
use crate::segment::{END_EFFECTOR, Thinned};
use eyebolt_geometry::{Camera, EndEffector, Transform};
use eyebolt_render::Random;
use eyebolt_robot::JointPositions;
use nalgebra::Point3;

/// Whose images.
pub enum Cast {
    /// Of one of these arms.
    Known(Vec<Actor>),
    /// Of arms that nobody built, and in one of so many images of a known one.
    Any {
        /// Known ones, too.
        known: Vec<Actor>,
        /// Share of the images that are of a known one.
        share_known: f64,
    },
}

/// An image with the truth about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// What the camera saw, its faults included.
    pub image: Thinned,
    /// Of each pixel: background, arm, end-effector or, where a tool or a cable that no description has hides them, unknown (see [`crate::segment`]).
    pub label: Vec<u8>,
    /// Pose of the end-effector.
    pub camera_from_end_effector: Transform<Camera, EndEffector>,
    /// Joints of the arm, fingers included.
    pub joints: JointPositions,
    /// Whether it was drawn, and not recorded: then all that is unknown is mounted on the arm.
    pub drawn: bool,
}

/// What a camera looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum At {
    /// The whole arm.
    Arm,
    /// Its end-effector, from near.
    EndEffector,
    /// Any part of the arm, from as near.
    AnyPart,
}

/// What images are like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// Pixels in a row.
    pub columns: usize,
    /// What the camera looks at.
    pub at: At,
    /// Whether there is a room around, or only a plane behind.
    pub room: bool,
    /// Whether most images of the arm have to show its end-effector, too.
    pub with_end_effector: bool,
    /// Whether depth is what a camera makes of it, or as it is.
    pub faults: bool,
}

impl Framing {
    /// The arm in its room, as a segmentation sees it.
    pub const ARM: Self =
        Self { columns: 160, at: At::Arm, room: true, with_end_effector: false, faults: true };
    /// The part of an image with the end-effector.
    pub const AT_END_EFFECTOR: Self = Self {
        columns: 104,
        at: At::EndEffector,
        room: false,
        with_end_effector: true,
        faults: true,
    };
}

/// Images drawn until one shows the arm, and rooms until all images do.
const TRIES: u64 = 40;
const ROOMS: u64 = 5;
/// Share of the image that the arm, or the end-effector, takes at least, and how often it may be less.
const LEAST_SHARE: f64 = 0.01;
const NOTHING: f64 = 0.02;
/// Share of the image that an end-effector takes at least where it has to be seen, and of the images in which
/// it has to be: 80 of 160 x 120 pixels can tell what they are.
const LEAST_END_EFFECTOR: f64 = 0.004;
const WITH_END_EFFECTOR: f64 = 0.75;
/// Pixels that the faults of a camera leave at least.
const FEWEST_PIXELS: usize = 64;
/// Images that an arm which is made up is in, before the next is made.
const OF_ONE: u64 = 2;

impl Cast {
    /// `count` images of the stream `random` in one room, the same whatever was drawn before.
    ///
    /// A room takes longer to build than to look at: images of one step share it, each with another arm
    /// or posture, another camera and other faults.
    ///
    /// # Errors
    ///
    /// The arm is in none of many images.
    pub fn shots(
        &self,
        random: Random,
        count: u64,
        framing: Framing,
    ) -> Result<Vec<Shot>, TrainError> {
        // An arm that was made up may never be in view; the next one is.
        let mut tries = (0..ROOMS).map(|room| self.in_one_room(random.at(room), count, framing));
        let failed = |shots: &Result<_, _>| matches!(shots, Err(TrainError::NothingToSee { .. }));
        let none = Err(TrainError::NothingToSee { tries: ROOMS * TRIES });
        tries.find(|shots| !failed(shots)).unwrap_or(none)
    }

    fn in_one_room(
        &self,
        random: Random,
        count: u64,
        framing: Framing,
    ) -> Result<Vec<Shot>, TrainError> {
        let made = self.made(random.at(0), count)?;
        let actor = |index: u64, style: &mut Random| match self {
            Self::Known(actors) => &actors[style.index(actors.len())],
            Self::Any { known, share_known } if style.uniform() < *share_known => {
                &known[style.index(known.len())]
            }
            Self::Any { .. } => &made[(index / OF_ONE) as usize],
        };
        let mut drawings = Vec::new();
        for index in 0..count {
            let stream = random.at(1).at(index);
            let mut tries = (0..TRIES).filter_map(|attempt| {
                let random = stream.at(attempt);
                in_view(actor(index, &mut random.at(0)), random.at(1), framing)
            });
            drawings.push(tries.next().ok_or(TrainError::NothingToSee { tries: TRIES })?);
        }
        let eyes: Vec<Point3<f64>> = drawings.iter().map(Drawing::eye).collect();
        let scene = framing.room.then(|| scenery(random.at(2), &eyes));
        let shot = |(drawing, index): (Drawing<'_>, u64)| {
            let random = random.at(3).at(index);
            let (mut image, label) = drawing.finished(scene.as_ref(), random.at(0));
            if framing.faults {
                let ideal = image.depth_m.clone();
                corrupt(&mut image, &label, random.at(1));
                if image.seen().take(FEWEST_PIXELS).count() < FEWEST_PIXELS {
                    // A camera that sees nothing teaches nothing.
                    image.depth_m = ideal;
                }
            }
            let camera_from_end_effector = drawing.camera_from_end_effector();
            let joints = drawing.pose.joints;
            Shot { image, label, camera_from_end_effector, joints, drawn: true }
        };
        Ok(drawings.into_iter().zip(0..).map(shot).collect())
    }

    /// Arms that are made up, as many as `count` images need.
    fn made(&self, random: Random, count: u64) -> Result<Vec<Actor>, TrainError> {
        if matches!(self, Self::Known(_)) {
            return Ok(Vec::new());
        }
        let arm = |index| Actor::of_plain_shapes(invented_arm(random.at(index))?);
        (0..count.div_ceil(OF_ONE)).map(arm).collect()
    }
}

/// An arm somewhere before a camera, if enough of it is in view.
fn in_view(actor: &Actor, random: Random, framing: Framing) -> Option<Drawing<'_>> {
    let mut style = random.at(0);
    let pose = any_pose(actor, &mut random.at(1))?;
    let (camera, base_from_camera) = match framing.at {
        At::Arm => look_at_arm(actor, &pose, &mut style, framing.columns),
        At::EndEffector => {
            let middle = pose.base_from_end_effector.point(&actor.end_effector_middle());
            look_from_near(actor, middle, &mut style, framing.columns)
        }
        At::AnyPart => {
            let part = style.index(actor.meshes.len());
            let middle = pose.base_from_link[part].point(&actor.middle(part));
            look_from_near(actor, middle, &mut style, framing.columns)
        }
    };
    let drawing = Drawing::new(actor, pose, camera, base_from_camera);
    let share = match framing.at {
        At::EndEffector => drawing.share_of(|label| label == END_EFFECTOR),
        At::Arm | At::AnyPart => drawing.share_of(|_| true),
    };
    let nothing = framing.at == At::Arm && style.uniform() < NOTHING;
    if framing.with_end_effector && style.uniform() < WITH_END_EFFECTOR {
        let hand = drawing.share_of(|label| label == END_EFFECTOR);
        return (hand >= LEAST_END_EFFECTOR).then_some(drawing);
    }
    (share >= LEAST_SHARE || nothing).then_some(drawing)
}

/// A posture that does not sink into what the arm stands on, if there is one among a few.
fn any_pose(actor: &Actor, random: &mut Random) -> Option<Pose> {
    const SINKS_M: f64 = -0.05;
    let mut poses = (0..12).filter_map(|_| actor.pose(actor.any_joints(random)));
    poses.find(|pose| actor.lowest_m(pose) > SINKS_M)
}
