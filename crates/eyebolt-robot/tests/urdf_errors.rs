//! What is wrong with a URDF is said with the file, the field and the remedy.
#![allow(clippy::unwrap_used)]

mod common;

use eyebolt_robot::{MAX_URDF_BYTES, PackageRoots, Robot};
use proptest::prelude::*;

const TWO: &str = r#"<link name="a"/><link name="b"/>"#;

fn joint(attributes: &str, inside: &str) -> String {
    format!(r#"<joint name="j" {attributes}><parent link="a"/><child link="b"/>{inside}</joint>"#)
}

/// The URDF, or the arm that it makes, is refused and the message has all the words.
#[track_caller]
fn refused(inside: &str, words: &[&str]) {
    message(&format!(r#"<robot name="r">{inside}</robot>"#), words);
}

#[track_caller]
fn message(urdf: &str, words: &[&str]) {
    let arm = common::parse(urdf).and_then(|robot| robot.arm(None, None));
    let text = arm.unwrap_err().to_string();
    for word in [&["robot description"], words].concat() {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
}

#[test]
fn not_xml_or_not_urdf() {
    message("", &["not plain XML"]);
    message("<robot><link></robot>", &["not plain XML", "1:"]);
    message("<sdf/>", &["<sdf>", "give a URDF"]);
    message(r#"<!DOCTYPE robot [<!ENTITY a "b">]><robot/>"#, &["remove the DOCTYPE"]);
    message("<robot name='&lol;'/>", &["lol", "write out the entity"]);
    let xacro = r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arm/></robot>"#;
    message(xacro, &["xacro FILE.xacro > FILE.urdf"]);
    let deep = format!("<robot>{}{}</robot>", "<a>".repeat(200_000), "</a>".repeat(200_000));
    message(&deep, &["no links"]);
}

#[test]
fn links_and_joints_must_form_one_tree() {
    refused("", &["no links"]);
    refused(TWO, &["more than one root: a, b", "fixed joints"]);
    refused(r#"<link name="a"/><link name="a"/>"#, &["two links are called `a`", "rename"]);
    let same = joint(r#"type="fixed""#, "");
    refused(&format!("{TWO}{same}{same}"), &["two joints are called `j`"]);
    refused(&format!(r#"<link name="a"/>{same}"#), &["joint `j`, child", "no link `b`", "add it"]);
    let cycle = r#"<link name="root"/><link name="a"/><link name="b"/>
        <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
        <joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint>"#;
    refused(cycle, &["cycle through links a, b", "remove one joint"]);
    refused(&cycle.replace(r#"<link name="root"/>"#, ""), &["no link is the root", "cycle"]);
    let twice = r#"<link name="a"/><link name="b"/><link name="c"/>
        <joint name="j" type="fixed"><parent link="a"/><child link="c"/></joint>
        <joint name="k" type="fixed"><parent link="b"/><child link="c"/></joint>"#;
    refused(twice, &["link `c` is the child of joint `j` and of joint `k`"]);
}

#[test]
fn joints_must_be_whole() {
    let with = |attributes: &str, inside: &str| format!("{TWO}\n{}", joint(attributes, inside));
    for kind in ["floating", "planar", "spherical", ""] {
        refused(&with(&format!(r#"type="{kind}""#), ""), &["line 2", "joint `j`, type", kind]);
    }
    refused(&with("", ""), &["joint `j`, type: missing"]);
    let revolute = r#"type="revolute""#;
    refused(&with(revolute, r#"<axis xyz="0 0 0"/>"#), &["joint `j`, <axis>, xyz: zero"]);
    refused(&with(revolute, r#"<axis xyz="0 nan 0"/>"#), &["`0 nan 0`", "3 finite numbers"]);
    let long = with(r#"type="prismatic""#, r#"<axis xyz="1 1 0"/>"#);
    refused(&long, &["joint `j`, <axis>, xyz", "1.4142", r#"xyz="0.707107 0.707107 0.000000""#]);
    refused(&with(revolute, r#"<origin xyz="0 x 0 1"/>"#), &["<origin>, xyz", "`0 x 0 1`"]);
    refused(&with(revolute, r#"<origin/><origin/>"#), &["a second <origin>"]);
    refused(&with(revolute, r#"<limit lower="2" upper="1"/>"#), &["lower", "swap"]);
    let itself = r#"<mimic joint="j"/>"#;
    refused(&with(revolute, itself), &["joint `j`, mimic", "follows itself"]);
    refused(&with(revolute, r#"<mimic joint="k"/>"#), &["no joint `k`"]);
    refused(&with(revolute, r#"<mimic joint="j" offset="inf"/>"#), &["<mimic>, offset"]);
    assert!(common::parse(&format!("<robot>{}</robot>", with(revolute, ""))).is_ok());
    let rounded = with(revolute, r#"<axis xyz="0.577 0.577 0.577"/>"#);
    assert!(common::parse(&format!("<robot>{rounded}</robot>")).is_ok());
    let zero_but_fixed = with(r#"type="fixed""#, r#"<axis xyz="0 0 0"/>"#);
    assert!(common::parse(&format!("<robot>{zero_but_fixed}</robot>")).is_ok());
}

#[test]
fn shapes_must_have_sizes() {
    let with = |shape: &str| {
        let link =
            format!(r#"<link name="a"><visual><geometry>{shape}</geometry></visual></link>"#);
        format!(r#"{link}<link name="b"/>{}"#, joint(r#"type="revolute""#, ""))
    };
    refused(&with(""), &["link `a`, <visual>, <geometry>", "empty"]);
    refused(&with("<cone/>"), &["<cone>", "cylinder"]);
    refused(&with(r#"<sphere radius="-1"/>"#), &["radius", "`-1`", "metres"]);
    refused(&with(r#"<cylinder radius="1"/>"#), &["length: missing"]);
    refused(&with(r#"<box size="1 2"/>"#), &["size", "3 finite numbers"]);
    refused(&with(r#"<box size="1 2 0"/>"#), &["size", "above zero"]);
    refused(&with(r#"<mesh filename="a.stl" scale="1 0 1"/>"#), &["scale", "zero"]);
    refused(&with("").replace("<geometry></geometry>", ""), &["no <geometry>"]);
}

#[test]
fn files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.urdf");
    let error = Robot::from_urdf_file(&path, &PackageRoots::new()).unwrap_err().to_string();
    assert!(error.contains("arm.urdf") && error.contains("check the path"), "{error}");
    std::fs::write(&path, "<robot>\n<link/>\n</robot>").unwrap();
    let error = Robot::from_urdf_file(&path, &PackageRoots::new()).unwrap_err().to_string();
    assert!(error.contains("arm.urdf, line 2: <link>, name: missing"), "{error}");
    let large = std::fs::File::create(&path).unwrap();
    large.set_len(MAX_URDF_BYTES + 1).unwrap();
    let error = Robot::from_urdf_file(&path, &PackageRoots::new()).unwrap_err().to_string();
    assert!(error.contains("is this a URDF"), "{error}");
}

#[test]
fn quaternions_count_from_version_1_1_on() {
    let body = r#"<link name="a"><visual><origin quat_xyzw="0 0 2 0"/><geometry>
        <sphere radius="1"/></geometry></visual></link>"#;
    for (version, w) in [("1.0", 1.0), ("1.1", 0.0)] {
        let urdf = format!(r#"<robot version="{version}">{body}</robot>"#);
        let rotation = common::parse(&urdf).unwrap().links[0].visuals[0].link_from_body;
        assert_eq!(rotation.rotation_xyzw()[3], w);
    }
}

#[test]
fn the_hash_is_of_the_text() {
    let hash = |urdf| common::parse(urdf).unwrap().urdf_hash().to_owned();
    let one = hash(r#"<robot><link name="a"/></robot>"#);
    assert_eq!(one.len(), 64);
    assert_eq!(one, hash(r#"<robot><link name="a"/></robot>"#));
    assert_ne!(one, hash(r#"<robot><link name="b"/></robot>"#));
}

proptest! {
    /// Any damage to a URDF gives a robot or an error, never a panic.
    #[test]
    fn damage_never_panics(cut in 0..3600_usize, place in 0..3600_usize, byte in 32..127_u8) {
        let mut text = std::fs::read(common::fixture("small_arm.urdf")).unwrap();
        let place = place % text.len();
        text[place] = byte;
        let text = String::from_utf8_lossy(&text).into_owned();
        let _ = common::parse(&text).map(|robot| robot.arm(None, None).is_ok());
        let cut = cut % text.len();
        let _ = common::parse(&text[..cut]);
        let _ = common::parse(&format!("{}{}", &text[..cut.min(place)], &text[cut.max(place)..]));
    }
}
