//! Which of several topics of joint states is the arm's.

use super::kinds::is_joints;
use crate::bag_recording::options::BagOptions;
use crate::bag_recording::scan::{Content, TopicScan};
use eyebolt_robot::{PackageRoots, Robot};
use std::collections::BTreeSet;

/// Names of the robot's joints: those that the caller tells, else those of the description on topic
/// `description`.
pub(super) fn of_robot(
    options: &BagOptions,
    topics: &[TopicScan],
    description: Option<usize>,
) -> Vec<String> {
    if !options.robot_joints.is_empty() {
        return options.robot_joints.clone();
    }
    let topic = description.and_then(|number| topics.get(number));
    let Some(Content::Text(text)) = topic.map(|topic| &topic.content) else { return Vec::new() };
    // What is wrong with it is told when the arm is made of it.
    let robot = Robot::from_urdf_str(text, None, &PackageRoots::new());
    robot.map_or_else(|_| Vec::new(), |robot| robot.own_joints())
}

/// The topic that tells more of the joints `of_robot` than any other; `None` where two tell as many, or
/// none tells any.
pub(super) fn telling_most(topics: &[TopicScan], of_robot: &[String]) -> Option<usize> {
    let told = |topic: &TopicScan| {
        let names: BTreeSet<&str> =
            topic.tracks().iter().flat_map(|track| track.names()).map(String::as_str).collect();
        of_robot.iter().filter(|name| names.contains(name.as_str())).count()
    };
    let counted = topics.iter().enumerate().filter(|(_, topic)| is_joints(topic));
    let counted: Vec<(usize, usize)> =
        counted.map(|(number, topic)| (told(topic), number)).collect();
    let most = counted.iter().map(|(told, _)| *told).max().filter(|most| *most > 0)?;
    let mut fitting = counted.iter().filter(|(told, _)| *told == most);
    let found = fitting.next().map(|(_, number)| *number);
    found.filter(|_| fitting.next().is_none())
}
