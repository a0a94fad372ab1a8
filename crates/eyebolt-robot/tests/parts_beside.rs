//! What is wrong with a part that the arm does not need never refuses the robot, and is said.
#![allow(clippy::unwrap_used)]

mod common;

use eyebolt_robot::{
    Arm, Input, JointPositions, PackageRoots, Prefer, Robot, RobotError, link_mesh,
};
use proptest::prelude::*;

/// Base, two links and a hand with a finger, each a box, with what is put in for a place.
struct Parts<'p> {
    /// Above the base.
    above: &'p str,
    /// In the robot, beside the arm.
    beside: &'p str,
    /// In the link `a` of the chain.
    in_chain: &'p str,
}

const NOTHING: Parts<'_> = Parts { above: "", beside: "", in_chain: BOX };
const BOX: &str = r#"<visual><geometry><box size="0.1 0.1 0.4"/></geometry></visual>"#;

fn link(name: &str, inside: &str) -> String {
    format!(r#"<link name="{name}">{inside}</link>"#)
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, inside: &str) -> String {
    format!(
        r#"<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>"#
    )
}

fn urdf(parts: &Parts<'_>) -> String {
    let Parts { above, beside, in_chain } = parts;
    let mut text = String::from("<?xml version=\"1.0\"?>\n<!-- <robot> -->\n<robot name=\"r\">\n");
    text += above;
    for (name, inside) in [("base", BOX), ("a", in_chain), ("b", BOX), ("c", BOX)] {
        text += &link(name, inside);
    }
    for (parent, child) in [("base", "a"), ("a", "b"), ("b", "c")] {
        text += &joint(&format!("to_{child}"), "revolute", parent, child, "");
    }
    text + beside + "</robot>"
}

fn arm(parts: &Parts<'_>) -> Result<Arm, RobotError> {
    Robot::from_urdf_str(&urdf(parts), None, &PackageRoots::new())?.arm(None, None)
}

/// The arm is the one without the part, and the words are said of what is left out.
#[track_caller]
fn left_out(parts: &Parts<'_>, words: &[&str]) {
    let arm = arm(parts).unwrap();
    assert_eq!((arm.base_name(), arm.end_effector_name()), ("base", "c"));
    let positions: JointPositions =
        ["to_a", "to_b", "to_c"].map(|name| (name.to_owned(), 0.3)).into_iter().collect();
    let poses = arm.known_link_poses(&positions).unwrap().base_from_links;
    for name in ["base", "a", "b", "c"] {
        assert!(poses[arm.robot().link_index(name).unwrap()].is_some());
    }
    let said: Vec<String> = arm.left_out().iter().map(ToString::to_string).collect();
    assert!(said.iter().any(|said| words.iter().all(|word| said.contains(word))), "{said:?}");
}

/// The part is one that the arm needs: file, element and remedy are named.
#[track_caller]
fn refused(parts: &Parts<'_>, words: &[&str]) {
    let text = arm(parts).unwrap_err().to_string();
    for word in [&["robot description"], words].concat() {
        assert!(text.contains(word), "`{word}` is not in: {text}");
    }
}

const MISSING: &str = r#"<visual><geometry><mesh filename="package://cart_description/cart.dae"/></geometry></visual>"#;
const COLLISION: &str = r#"<collision><geometry><box size="1 1 0.2"/></geometry></collision>"#;
const GIVE: &str = "`package_path` cart_description=FOLDER";

#[test]
fn a_mesh_that_is_missing_above_or_beside_the_arm() {
    let cart = link("cart", MISSING) + &joint("on_cart", "fixed", "cart", "base", "");
    let parts = Parts { above: &cart, ..NOTHING };
    let robot = Robot::from_urdf_str(&urdf(&parts), None, &PackageRoots::new()).unwrap();
    let below = robot.arm(Some("base"), None).unwrap();
    let said = below.left_out()[0].to_string();
    for word in ["the arm does not need it", "link `cart`", GIVE] {
        assert!(said.contains(word), "{said}");
    }
    // Where the cart itself is the base, it is needed.
    let error = robot.arm(None, None).unwrap_err();
    assert_eq!(error.input(), Some(Input::PACKAGE_PATH));
    let table = link("table", MISSING) + &joint("on_table", "fixed", "base", "table", "");
    left_out(&Parts { beside: &table, ..NOTHING }, &["link `table`", GIVE]);
    let head = link("head", MISSING) + &joint("neck", "revolute", "base", "head", "");
    left_out(&Parts { beside: &head, ..NOTHING }, &["link `head`", GIVE]);
}

#[test]
fn a_collision_shape_stands_in_for_a_mesh_that_is_missing() {
    let both = MISSING.to_owned() + COLLISION;
    let parts = Parts { in_chain: &both, ..NOTHING };
    left_out(&parts, &["link `a`", "collision shapes stand for", GIVE]);
    let arm = arm(&parts).unwrap();
    let shown = &arm.robot().links[arm.robot().link_index("a").unwrap()];
    let mesh = link_mesh(shown, Prefer::Visual).unwrap().unwrap();
    let (low, high) = mesh.bounds().unwrap();
    assert!((high - low - nalgebra::Vector3::new(1.0, 1.0, 0.2)).norm() < 1e-6);
    let wrong = BOX.to_owned() + &MISSING.replace("visual", "collision");
    left_out(&Parts { in_chain: &wrong, ..NOTHING }, &["looks like is enough", GIVE]);
    // Half of what is seen is no stand-in, nor is half of a collision shape.
    refused(&Parts { in_chain: MISSING, ..NOTHING }, &["link `a`", "not found", GIVE]);
    refused(&Parts { in_chain: &(BOX.to_owned() + MISSING), ..NOTHING }, &["link `a`", GIVE]);
    let neither = both + &MISSING.replace("visual", "collision");
    refused(&Parts { in_chain: &neither, ..NOTHING }, &["link `a`", GIVE]);
    // A cover that moves with the chain is part of what is seen of the arm.
    let cover = link("cover", MISSING) + &joint("screws", "fixed", "b", "cover", "");
    refused(&Parts { beside: &cover, ..NOTHING }, &["link `cover`", GIVE]);
}

#[test]
fn joints_of_other_kinds_above_and_beside_the_arm() {
    for kind in ["floating", "planar"] {
        let above = link("world", BOX) + &joint("free", kind, "world", "base", "");
        left_out(&Parts { above: &above, ..NOTHING }, &["joint `free`, type", kind]);
        let beside = link("thing", BOX) + &joint("free", kind, "base", "thing", "");
        left_out(&Parts { beside: &beside, ..NOTHING }, &["joint `free`, type", "takes no part"]);
    }
    let broken =
        link("thing", BOX) + &joint("odd", "revolute", "base", "thing", r#"<axis xyz="0 0 0"/>"#);
    left_out(&Parts { beside: &broken, ..NOTHING }, &["joint `odd`, <axis>, xyz: zero"]);
}

#[test]
fn a_joint_that_follows_one_that_is_not_there() {
    let follows = r#"<mimic joint="none"/>"#;
    let finger = link("f", BOX) + &joint("grip", "prismatic", "c", "f", follows);
    left_out(&Parts { beside: &finger, ..NOTHING }, &["joint `grip`, mimic: no joint `none`"]);
    let arm = arm(&Parts { beside: &finger, ..NOTHING }).unwrap();
    // Its own record counts, where there is one.
    let names = ["to_a", "to_b", "to_c", "grip"];
    let all: JointPositions = names.map(|name| (name.to_owned(), 0.1)).into_iter().collect();
    let finger = arm.robot().link_index("f").unwrap();
    assert!(arm.known_link_poses(&all).unwrap().base_from_links[finger].is_some());
    let few: JointPositions =
        all.iter().filter(|(name, _)| *name != "grip").map(|(n, p)| (n.to_owned(), p)).collect();
    let known = arm.known_link_poses(&few).unwrap();
    assert!(known.base_from_links[finger].is_none());
    assert_eq!(known.unplaced_joints, ["grip"]);
}

#[test]
fn shapes_without_extent_are_none() {
    for nothing in [
        r#"<box size="0 0 0"/>"#,
        r#"<sphere radius="0"/>"#,
        r#"<cylinder radius="0" length="0"/>"#,
        r#"<capsule radius="0.0" length="0"/>"#,
    ] {
        let dummy = format!("<visual><geometry>{nothing}</geometry></visual>");
        let above = link("root", &dummy) + &joint("fix", "fixed", "root", "base", "");
        left_out(&Parts { above: &above, ..NOTHING }, &["without extent", "link `root`"]);
        // Beside a shape, in the arm too.
        let both = dummy.clone() + BOX;
        left_out(&Parts { in_chain: &both, ..NOTHING }, &["without extent", "link `a`"]);
    }
    let flat = r#"<visual><geometry><box size="0.1 0.1 0"/></geometry></visual>"#;
    refused(&Parts { in_chain: flat, ..NOTHING }, &["link `a`", "size", "above zero"]);
}

#[test]
fn prefixes_that_nobody_declared() {
    let foreign = r#"<drake:joint name="x"/><link name="d" drake:kind="a"><drake:visual/></link>
        <joint name="d" type="fixed"><parent link="base"/><child link="d"/></joint>"#;
    let arm = arm(&Parts { beside: foreign, ..NOTHING }).unwrap();
    assert_eq!(arm.robot().links.len(), 5);
    assert!(arm.left_out().is_empty());
    // Lines of messages stay those of the file.
    let wrong = format!("{foreign}\n<joint name=\"k\"/>");
    refused(&Parts { beside: &wrong, ..NOTHING }, &["line 6", "joint `k`"]);
    let many: String = (0..40).map(|i| format!("<p{i}:x/>")).collect();
    refused(&Parts { beside: &many, ..NOTHING }, &["not plain XML", "correct the XML"]);
}

/// A chain does not end where its description is wrong: half an arm is none.
#[test]
fn a_joint_of_the_chain_that_is_wrong_is_named_wherever_it_is() {
    let whole = urdf(&NOTHING);
    for name in ["to_a", "to_b", "to_c"] {
        for (wrong, word) in [
            (r#"type="revolute"><axis xyz="0 0 0"/>"#, "<axis>, xyz: zero"),
            (r#"type="revolute"><origin xyz="1 2"/>"#, "<origin>, xyz"),
            (r#"type="screw">"#, "`screw` joints"),
            (">", "type: missing"),
        ] {
            let right = format!(r#"<joint name="{name}" type="revolute">"#);
            assert!(whole.contains(&right));
            let text = whole.replace(&right, &format!(r#"<joint name="{name}" {wrong}"#));
            let robot = Robot::from_urdf_str(&text, None, &PackageRoots::new()).unwrap();
            for end_effector in [None, Some("c")] {
                let error = robot.arm(None, end_effector).unwrap_err().to_string();
                let named = error.contains(&format!("joint `{name}`")) && error.contains(word);
                assert!(named, "{name}, {wrong}: {error}");
            }
        }
    }
}

#[test]
fn what_hangs_on_nothing() {
    let stray = link("stray", BOX) + &link("rod", BOX);
    let stray = stray + &joint("turns", "revolute", "stray", "rod", "");
    let words = ["more than one root: base, stray", "takes no part", "fixed joints"];
    left_out(&Parts { beside: &stray, ..NOTHING }, &words);
    let words = ["more than one root: stray, base", "takes no part", "fixed joints"];
    left_out(&Parts { above: &stray, ..NOTHING }, &words);
    // Whoever means the other one says so.
    let parts = Parts { above: &stray, ..NOTHING };
    let robot = Robot::from_urdf_str(&urdf(&parts), None, &PackageRoots::new()).unwrap();
    let other = robot.arm(Some("stray"), Some("rod")).unwrap();
    assert_eq!(other.required_joints(), ["turns"]);
    // No chain leads from one to the other.
    let error = robot.arm(Some("stray"), Some("c")).unwrap_err().to_string();
    assert!(error.contains("more than one root"), "{error}");
    // Two arms: nobody can say which is the robot.
    let names = ["base", "a", "b", "c"];
    let twin: String = names.map(|name| link(&format!("{name}_2"), BOX)).concat();
    let pairs = [("base", "a"), ("a", "b"), ("b", "c")];
    let twin = twin
        + &pairs
            .map(|(parent, child)| {
                let (parent, child) = (format!("{parent}_2"), format!("{child}_2"));
                joint(&format!("to_{child}"), "revolute", &parent, &child, "")
            })
            .concat();
    refused(&Parts { beside: &twin, ..NOTHING }, &["more than one root: base, base_2"]);
}

#[test]
fn a_link_with_two_parents() {
    let rod = link("rod", BOX)
        + &joint("one_end", "revolute", "base", "rod", "")
        + &joint("other_end", "revolute", "b", "rod", "");
    let words = ["link `rod` is the child of joint `one_end` and of joint `other_end`", "no part"];
    left_out(&Parts { beside: &rod, ..NOTHING }, &words);
    let arm = arm(&Parts { beside: &rod, ..NOTHING }).unwrap();
    let all: JointPositions = ["to_a", "to_b", "to_c", "one_end", "other_end"]
        .map(|name| (name.to_owned(), 0.1))
        .into_iter()
        .collect();
    let rod = arm.robot().link_index("rod").unwrap();
    assert!(arm.known_link_poses(&all).unwrap().base_from_links[rod].is_none());
    // The arm itself must know what it hangs on, whichever of the joints comes first.
    let second = joint("second", "fixed", "base", "b", "");
    let words = ["link `b` is the child of joint", "`second`", "remove one"];
    refused(&Parts { beside: &second, ..NOTHING }, &words);
    refused(&Parts { above: &second, ..NOTHING }, &words);
}

/// Something that may be wrong, and whether it is.
fn part() -> impl Strategy<Value = (String, bool)> {
    let flaws = prop::sample::select(vec![
        (BOX.to_owned(), false),
        (MISSING.to_owned(), true),
        (r#"<visual><geometry><box size="1 -1 1"/></geometry></visual>"#.to_owned(), true),
        (r#"<visual><geometry><cone/></geometry></visual>"#.to_owned(), true),
        (
            r#"<visual><origin xyz="a"/><geometry><sphere radius="1"/></geometry></visual>"#.into(),
            true,
        ),
        ("<visual/>".to_owned(), true),
    ]);
    let joints = prop::sample::select(vec![
        (r#"type="fixed""#, "", false),
        (r#"type="revolute""#, "", false),
        (r#"type="floating""#, "", true),
        (r#"type="screw""#, "", true),
        ("", "", true),
        (r#"type="revolute""#, r#"<limit lower="2" upper="1"/>"#, true),
        (r#"type="revolute""#, r#"<origin rpy="0 0"/>"#, true),
        (r#"type="prismatic""#, r#"<mimic joint="other_limb"/>"#, true),
    ]);
    (flaws, joints).prop_map(|((inside, flawed), (kind, more, broken))| {
        let joint = format!(
            r#"<joint name="limb" {kind}><parent link="base"/><child link="limb"/>{more}</joint>"#
        );
        (link("limb", &inside) + &joint, flawed || broken)
    })
}

proptest! {
    /// Whatever is wrong with a limb beside the arm: the arm is the same, and what is wrong is said
    /// with the file, the element and a remedy.
    #[test]
    fn nothing_beside_the_arm_refuses_it((limb, wrong) in part()) {
        let whole = arm(&NOTHING).unwrap();
        let beside = arm(&Parts { beside: &limb, ..NOTHING }).unwrap();
        prop_assert_eq!(beside.base_name(), whole.base_name());
        prop_assert_eq!(beside.end_effector_name(), whole.end_effector_name());
        prop_assert_eq!(beside.required_joints(), whole.required_joints());
        prop_assert_eq!(!beside.left_out().is_empty(), wrong);
        for part in beside.left_out() {
            let said = part.to_string();
            prop_assert!(said.contains("robot description") && said.contains("limb"), "{said}");
        }
    }
}
