//! What is written of a plan, as others read it.

use crate::stage::{ARM, PLAN, camera, request};
use eyebolt::plan::{PlanDocument, SCHEMA, moveit, trajectory};
use serde::Deserialize;
use std::collections::BTreeMap;

/// `trajectory_msgs/msg/JointTrajectory`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Trajectory {
    header: Header,
    joint_names: Vec<String>,
    points: Vec<Point>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    stamp: Duration,
    frame_id: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Point {
    positions: Vec<f64>,
    velocities: Vec<f64>,
    accelerations: Vec<f64>,
    effort: Vec<f64>,
    time_from_start: Duration,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Duration {
    sec: i32,
    nanosec: u32,
}

impl Duration {
    fn seconds(&self) -> f64 {
        f64::from(self.sec) + 1e-9 * f64::from(self.nanosec)
    }
}

/// `moveit_msgs/msg/RobotState`, as far as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RobotState {
    joint_state: JointState,
    is_diff: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct JointState {
    name: Vec<String>,
    position: Vec<f64>,
}

fn names() -> Vec<String> {
    ARM.joints().iter().map(|joint| joint.name.clone()).collect()
}

fn assert_near(written: &[f64], planned: &[f64]) {
    assert_eq!(written.len(), planned.len());
    assert!(written.iter().zip(planned).all(|(a, b)| (a - b).abs() < 1e-6));
}

#[test]
fn the_trajectory_is_the_message_of_ros() {
    let message: Trajectory = serde_saphyr::from_str(&trajectory(&ARM, &PLAN)).unwrap();
    assert_eq!(message.joint_names, names());
    assert_eq!((message.header.frame_id.as_str(), message.header.stamp.seconds()), ("", 0.0));
    assert_eq!(message.points.len(), PLAN.trajectory.len());
    for (written, planned) in message.points.iter().zip(&PLAN.trajectory) {
        assert_near(&written.positions, &planned.positions);
        assert_near(&written.velocities, &planned.velocities);
        assert!((written.time_from_start.seconds() - planned.at_s).abs() < 2e-9);
        assert!(written.accelerations.is_empty() && written.effort.is_empty());
    }
    // Controllers want times that grow, and an end at rest.
    let times: Vec<f64> = message.points.iter().map(|p| p.time_from_start.seconds()).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(message.points.last().unwrap().velocities.iter().all(|velocity| *velocity == 0.0));
}

/// Where velocities are told, controllers follow a cubic between two points: it must be the straight way.
#[test]
fn a_cubic_through_the_points_is_straight() {
    for pair in PLAN.trajectory.windows(2) {
        let seconds = pair[1].at_s - pair[0].at_s;
        let at = |along: f64, joint: usize| {
            let (p, q) = (pair[0].positions[joint], pair[1].positions[joint]);
            let (v, w) = (seconds * pair[0].velocities[joint], seconds * pair[1].velocities[joint]);
            let (t, t2, t3) = (along, along * along, along.powi(3));
            (2.0 * t3 - 3.0 * t2 + 1.0) * p
                + (t3 - 2.0 * t2 + t) * v
                + (3.0 * t2 - 2.0 * t3) * q
                + (t3 - t2) * w
        };
        for along in [0.2, 0.5, 0.9] {
            let parts: Vec<f64> = (0..pair[0].positions.len())
                .filter(|joint| {
                    (pair[1].positions[*joint] - pair[0].positions[*joint]).abs() > 1e-6
                })
                .map(|joint| {
                    let (p, q) = (pair[0].positions[joint], pair[1].positions[joint]);
                    (at(along, joint) - p) / (q - p)
                })
                .collect();
            let [low, high] =
                [f64::min, f64::max].map(|of| parts.iter().copied().reduce(of).unwrap_or_default());
            assert!(high - low < 1e-6, "{parts:?}");
        }
    }
}

#[test]
fn targets_of_moveit_are_by_name() {
    let states: BTreeMap<String, RobotState> =
        serde_saphyr::from_str(&moveit(&ARM, &PLAN)).unwrap();
    assert_eq!(states.len(), 6);
    for (index, planned) in PLAN.configurations.iter().enumerate() {
        let state = &states[&format!("eyebolt_{}", index + 1)];
        assert_eq!(state.joint_state.name, names());
        assert_near(&state.joint_state.position, &planned.positions);
        assert!(state.is_diff);
    }
}

#[test]
fn json_has_units_and_the_gain_of_each() {
    let cameras = [camera()];
    let text = PlanDocument::new(&request(&cameras), &PLAN).to_json();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["schema"], SCHEMA);
    assert_eq!(json["asked"], 6);
    assert_eq!(json.get("why_fewer"), None);
    let configurations = json["configurations"].as_array().unwrap();
    for (written, planned) in configurations.iter().zip(&PLAN.configurations) {
        let joints = written["joints"].as_array().unwrap();
        let positions: Vec<f64> =
            joints.iter().map(|joint| joint["position_rad"].as_f64().unwrap()).collect();
        assert_near(&positions, &planned.positions);
        let error = written["expected_error_after"]["translation_mm"].as_f64().unwrap();
        assert!((error - 1e3 * planned.expected.translation_m).abs() < 1e-9);
    }
    assert_eq!(json["held_joints"][0]["position_m"], 0.0);
    assert!(json["rules"][0].as_str().unwrap().contains("eyebolt moves nothing"));
}
