//! Which robot: by name, by xacro, with parts left out, with joints that nobody recorded.

use crate::desk::{Desk, text};
use crate::program::{CACHE, RECORDING, eyebolt};
use serde_json::Value;
use std::fs;

fn info(more: &[&str]) -> Value {
    let ended = eyebolt(&[&["info", text(&RECORDING), "--json"], more].concat());
    // Another robot than the recorded one may not be ready to be calibrated: the robot is what is asked here.
    assert!(
        matches!(ended.code, Some(0 | 3)) && ended.err.is_empty(),
        "{:?} {}",
        ended.code,
        ended.err
    );
    serde_json::from_str(&ended.out).unwrap()
}

#[test]
fn a_robot_that_comes_with_the_program_is_known_by_its_name_everywhere() {
    let found = info(&["--robot", "shackle"]);
    assert_eq!(found["robot"]["name"], "shackle");
    assert_eq!(found["robot"]["end_effector"], "hand");
    // Its base and end-effector are known, not guessed.
    assert_eq!(found["robot"]["guessed"], serde_json::json!([]));
    let desk = Desk::new();
    let ended = desk.calibrate(&["--robot", "davit"]);
    ended.assert_error(1, &["shoulder_pan", "use the URDF whose joint names match"]);
}

const XACRO: &str = r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="made">
  <xacro:arg name="joints" default="2"/>
  <xacro:macro name="segment" params="number parent">
    <link name="part_${number}"><visual><geometry><box size="0.1 0.1 ${0.1 * number}"/></geometry></visual></link>
    <joint name="joint_${number}" type="revolute">
      <parent link="${parent}"/><child link="part_${number}"/><axis xyz="0 1 0"/>
    </joint>
    <xacro:if value="${number &lt; int('$(arg joints)')}">
      <xacro:segment number="${number + 1}" parent="part_${number}"/>
    </xacro:if>
  </xacro:macro>
  <link name="foot"><visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual></link>
  <xacro:segment number="1" parent="foot"/>
</robot>"#;

#[test]
fn xacro_is_expanded_and_installed_descriptions_are_found() {
    let desk = Desk::new();
    let package = desk.file("share/crane_description/urdf");
    fs::create_dir_all(&package).unwrap();
    fs::write(package.join("crane.urdf.xacro"), XACRO).unwrap();
    let path = package.join("crane.urdf.xacro");
    let found = info(&["--robot", text(&path)]);
    assert_eq!(found["robot"]["end_effector"], "part_2");
    assert_eq!(found["robot"]["guessed"], serde_json::json!(["base", "end_effector"]));
    let found = info(&["--robot", text(&path), "--xacro-arg", "joints:=4"]);
    assert_eq!(found["robot"]["end_effector"], "part_4");
    let share = desk.file("share");
    let found = info(&["--robot", "crane", "--package-path", text(&share)]);
    assert_eq!(found["robot"]["name"], "made");
    let ended = eyebolt(&["info", text(&RECORDING), "--robot", "crane"]);
    ended.assert_error(1, &["--robot crane", "shackle", "installed", "--package-path"]);
    // What is written for others is expanded.
    let output = desk.file("out.mcap");
    let (recording, output) = (text(&RECORDING), text(&output));
    let ended = eyebolt(&["convert", recording, output, "--robot", text(&path)]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let ended = eyebolt(&["info", output, "--json"]);
    let found: Value = serde_json::from_str(&ended.out).unwrap();
    assert_eq!(found["robot"]["end_effector"], "part_2");
}

/// The recording's robot with `more` in it, as a file.
fn with(desk: &Desk, more: &str) -> String {
    let urdf = fs::read_to_string(RECORDING.join("arm.urdf")).unwrap();
    let path = desk.file("more.urdf");
    fs::write(&path, urdf.replace("</robot>", &format!("{more}</robot>"))).unwrap();
    text(&path).to_owned()
}

const FINGER: &str = r#"<link name="grip"><visual><geometry><box size="0.02 0.02 0.08"/></geometry></visual></link>
  <joint name="grip_joint" type="prismatic"><parent link="hand"/><child link="grip"/>
  <axis xyz="0 1 0"/><limit lower="-0.05" upper="0.05" effort="1" velocity="1"/></joint>"#;
const LOST: &str = r#"<link name="stand"><visual><geometry><mesh filename="package://lost/a.dae"/></geometry></visual></link>
  <joint name="beside" type="fixed"><parent link="base"/><child link="stand"/></joint>"#;

#[test]
fn what_is_left_out_is_said_and_the_calibration_goes_on() {
    let desk = Desk::new();
    let urdf = with(&desk, &format!("{FINGER}{LOST}"));
    let ended = desk.calibrate(&["--robot", &urdf]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.out, ended.err);
    for word in ["link `stand`", "--package-path lost=FOLDER", "took no part: grip_joint"] {
        assert!(ended.out.contains(word), "no {word:?} in: {}", ended.out);
    }
    let answer = fs::read_to_string(desk.file("calibration.json")).unwrap();
    let answer: Value = serde_json::from_str(&answer).unwrap();
    assert_eq!(answer["unplaced_joints"], serde_json::json!(["grip_joint"]));
    assert_eq!(answer["left_out"].as_array().unwrap().len(), 1);
}

#[test]
fn joints_that_nobody_recorded_may_be_stated() {
    let desk = Desk::new();
    let urdf = with(&desk, FINGER);
    let found = info(&["--robot", &urdf]);
    assert_eq!(found["robot"]["unplaced_joints"], serde_json::json!(["grip_joint"]));
    let found = info(&["--robot", &urdf, "--joint", "grip_joint=0.01"]);
    assert_eq!(found["robot"]["unplaced_joints"], serde_json::json!([]));
    let cache = text(&CACHE);
    let ended = eyebolt(&["calibrate", text(&RECORDING), "--cache", cache, "--joint", "nobody=1"]);
    ended.assert_error(1, &["--joint nobody", "no such joint", "Name one of"]);
    let ended = eyebolt(&["info", text(&RECORDING), "--joint", "a"]);
    ended.assert_error(2, &["NAME=VALUE"]);
}

#[test]
fn names_with_a_prefix_are_matched_where_it_is_given() {
    let desk = Desk::new();
    let urdf = fs::read_to_string(RECORDING.join("arm.urdf")).unwrap();
    let path = desk.file("prefixed.urdf");
    fs::write(&path, urdf.replace("joint name=\"", "joint name=\"left_")).unwrap();
    let found = info(&["--robot", text(&path)]);
    let advice = found["advice"].to_string();
    assert!(advice.contains("--joint-prefix left_"), "{advice}");
    let found = info(&["--robot", text(&path), "--joint-prefix", "left_"]);
    assert_eq!(found["robot"]["missing_joints"], serde_json::json!([]));
    assert_eq!(found["advice"], serde_json::json!([]));
}
