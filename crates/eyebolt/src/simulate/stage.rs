//! What is around the arm while it rests in one configuration, and on the way there.

use super::body::ArmBody;
use super::configurations::Pose;
use super::random_stream::RandomStream;
use super::scenario::Scenario;
use super::scene::{HALL, ROOM, RoomSize};
use super::second_arm::{Beside, second_arm};
use super::solids::Solid;
use super::{scene, surroundings};
use nalgebra::Point3;

/// What is around the arm in one configuration besides what always is.
#[derive(Default)]
pub(super) struct Stage {
    /// Another room in the place of the usual one.
    pub(super) other_room: Option<Vec<Solid>>,
    /// Those who pass by.
    pub(super) passing: Vec<Solid>,
    /// Where another arm rests.
    pub(super) beside: Option<Beside>,
}

/// One stage for each of `poses` as seen from `eye` (base frame).
pub(super) fn stages(
    scenario: &Scenario<'_>,
    body: &ArmBody,
    poses: &[Pose],
    eye: &Point3<f64>,
) -> Vec<Stage> {
    let lab = &scenario.faults.lab;
    let mut beside = second_arm(scenario, body, poses, eye).into_iter();
    let mut passing = surroundings::passers_by(scenario, body, poses, eye).into_iter();
    let random = RandomStream::OtherRooms.of(scenario.seed);
    let stage = |index: usize| {
        let mut random = random.at(index as u64);
        let other = random.uniform() < lab.other_rooms;
        Stage {
            other_room: other.then(|| {
                let room = scene::room(&mut random, std::slice::from_ref(eye), any_size(index));
                room.into_iter().map(|solid| solid.raised(body.table_above_usual_m())).collect()
            }),
            passing: passing.next().unwrap_or_default(),
            beside: beside.next().flatten(),
        }
    };
    (0..poses.len()).map(stage).collect()
}

/// The size of the usual room of `scenario`.
pub(super) fn usual_size(scenario: &Scenario<'_>) -> RoomSize {
    if scenario.faults.lab.far_room { HALL } else { ROOM }
}

/// Rooms of both sizes in turn.
fn any_size(index: usize) -> RoomSize {
    if index.is_multiple_of(2) { ROOM } else { HALL }
}
