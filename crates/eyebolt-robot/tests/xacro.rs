//! Xacro files: expanded as PyPI's xacro does, or told what is wrong.
#![allow(clippy::unwrap_used)]

mod common;

use eyebolt_robot::{Description, Input, PackageRoots, Robot, RobotError, XacroArguments};
use proptest::prelude::*;
use std::path::{Path, PathBuf};

fn arguments(pairs: &[(&str, &str)]) -> XacroArguments {
    pairs.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect()
}

fn packages() -> PackageRoots {
    PackageRoots::new().with_directory(common::fixture("xacro"))
}

/// Elements with their attributes in the order of names, and text, one line each.
fn outline(text: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(text).unwrap();
    let mut lines = Vec::new();
    for node in document.root_element().descendants() {
        let depth = node.ancestors().count();
        if node.is_element() {
            let mut attributes: Vec<String> =
                node.attributes().map(|a| format!("{}={:?}", a.name(), a.value())).collect();
            attributes.sort();
            lines.push(format!("{depth} {} {}", node.tag_name().name(), attributes.join(" ")));
        } else if node.is_text() && !node.text().unwrap().trim().is_empty() {
            lines.push(format!("{depth} {:?}", node.text().unwrap().trim()));
        }
    }
    lines
}

#[track_caller]
fn as_pypi_has_it(file: &str, expanded: &str, given: &[(&str, &str)]) {
    let path = common::fixture("xacro").join(file);
    let found = Description::read(&path, &packages(), &arguments(given)).unwrap().text;
    let here = common::fixture("xacro").display().to_string();
    let expected = std::fs::read_to_string(common::fixture("xacro").join(expanded)).unwrap();
    let (found, expected) = (outline(&found.replace(&here, "HERE")), outline(&expected));
    for (found, expected) in found.iter().zip(&expected) {
        assert_eq!(found, expected);
    }
    assert_eq!(found.len(), expected.len());
}

#[test]
fn the_language_is_that_of_pypi() {
    as_pypi_has_it("language.xacro", "language.expanded.urdf", &[("name", "given")]);
}

#[test]
fn an_arm_in_the_manner_of_makers_is_expanded() {
    let given = [("prefix", "left_"), ("gripper", "true")];
    as_pypi_has_it("arm.urdf.xacro", "arm.expanded.urdf", &given);
    let path = common::fixture("xacro/arm.urdf.xacro");
    let description = Description::read(&path, &packages(), &arguments(&given)).unwrap();
    let robot = description.robot(&packages()).unwrap();
    assert_eq!(robot.name, "zoo_arm");
    let arm = robot.arm(None, None).unwrap();
    assert_eq!(arm.required_joints(), ["left_shoulder", "left_elbow"]);
    // Without arguments, by the defaults; as a plain file, too.
    let plain = Robot::from_urdf_file(&path, &packages()).unwrap();
    assert_eq!(plain.arm(None, None).unwrap().required_joints(), ["shoulder", "elbow"]);
}

/// A file with `inside` in its root, expanded.
fn expanded(inside: &str, given: &[(&str, &str)]) -> Result<String, RobotError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.xacro");
    let root = r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro">"#;
    std::fs::write(&path, format!("{root}\n{inside}</robot>")).unwrap();
    let read = Description::read(&path, &PackageRoots::new(), &arguments(given));
    read.map(|description| description.text)
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    let refused = |inside: &str, words: &[&str]| {
        let error = expanded(inside, &[]).unwrap_err();
        assert_eq!(error.input(), Some(Input::ROBOT));
        let text = error.to_string();
        for word in [&["r.xacro", "line 2"], words].concat() {
            assert!(text.contains(word), "`{word}` is not in: {text}");
        }
    };
    refused(r#"<a b="${nobody + 1}"/>"#, &["`${nobody + 1}`", "`nobody`", "<xacro:property>"]);
    refused(r#"<a b="${1 +}"/>"#, &["`${1 +}`", "missing at the end"]);
    refused(r#"<a b="${1 / 0}"/>"#, &["divides by zero"]);
    refused(r#"<a b="${'a' - 1}"/>"#, &["str `a`", "makes no sense"]);
    refused(r#"<a b="${open"/>"#, &["`${` has no `}`"]);
    refused(r#"<a b="$(arg ur_type)"/>"#, &["`xacro_argument` ur_type=VALUE"]);
    refused(r#"<a b="$(env HOME)"/>"#, &["`xacro_argument` env:HOME=VALUE"]);
    refused(
        r#"<a b="$(find my_arm)/x"/>"#,
        &["no package `my_arm`", "`package_path` my_arm=FOLDER"],
    );
    refused(r#"<xacro:include filename="none.xacro"/>"#, &["none.xacro", "correct the path"]);
    refused("<xacro:my_arm/>", &["no macro `my_arm`", "include the file"]);
    let macro_a = r#"<xacro:macro name="a" params="x *b"><c/></xacro:macro>"#;
    refused(&format!("{macro_a}<xacro:a/>"), &["macro `a` needs `x`"]);
    refused(&format!(r#"{macro_a}<xacro:a x="1"/>"#), &["block `*b` is missing"]);
    refused(&format!(r#"{macro_a}<xacro:a x="1"><d/><e/></xacro:a>"#), &["takes no block <e>"]);
    refused(&format!(r#"{macro_a}<xacro:a y="1"/>"#), &["no parameter `y`"]);
    refused(r#"<xacro:if value="maybe"/>"#, &["the condition `maybe`", "true, false"]);
    refused(r#"<xacro:property name="p" value="${p}"/><a b="${p}"/>"#, &["defined by itself"]);
    let endless = r#"<xacro:macro name="m" params=""><xacro:m/></xacro:macro><xacro:m/>"#;
    refused(endless, &["nested too deep"]);
    let wide = r#"<xacro:macro name="m" params="n"><xacro:if value="${n}"><xacro:m n="${n - 1}"/><xacro:m n="${n - 1}"/></xacro:if></xacro:macro><xacro:m n="90"/>"#;
    refused(wide, &["too many elements"]);
    let deep = format!(r#"<a b="${{{}1{}}}"/>"#, "(".repeat(5000), ")".repeat(5000));
    refused(&deep, &["nested too deep"]);
    refused(&format!(r#"<a b="${{{}1}}"/>"#, "-".repeat(5000)), &["nested too deep"]);
    refused(r#"<a b="${xacro.fatal('no', 7)}"/>"#, &["the file says: no 7"]);
}

/// As on a command line: files that a package includes lie in it, and not beside the file that includes them.
#[test]
fn packages_may_be_named_from_where_one_stands() {
    // Tests run in the folder of their crate.
    let packages = PackageRoots::new().with_directory("tests/fixtures/xacro");
    let path = Path::new("tests/fixtures/xacro/arm.urdf.xacro");
    let from_here = Description::read(path, &packages, &arguments(&[])).unwrap();
    let path = common::fixture("xacro").join("arm.urdf.xacro");
    let from_anywhere = Description::read(&path, &self::packages(), &arguments(&[])).unwrap();
    assert_eq!(outline(&from_here.text), outline(&from_anywhere.text));
}

#[test]
fn the_environment_is_not_read_but_may_be_stated() {
    let found = expanded(r#"<a b="$(env HOME)"/>"#, &[("env:HOME", "/there")]).unwrap();
    assert!(found.contains(r#"b="/there""#), "{found}");
}

#[test]
fn a_description_of_a_recording_is_not_expanded() {
    let text = std::fs::read_to_string(common::fixture("xacro/arm.urdf.xacro")).unwrap();
    let error = Robot::from_urdf_str(&text, None, &packages()).unwrap_err();
    assert!(error.to_string().contains("xacro FILE.xacro > FILE.urdf"), "{error}");
}

/// Python's own answers to expressions of numbers, by another implementation of the same rules.
fn number() -> impl Strategy<Value = (String, f64)> {
    let leaf = (-50_i64..50).prop_map(|n| (format!("({n})"), n as f64));
    leaf.prop_recursive(4, 32, 2, |inner| {
        (inner.clone(), inner, 0..4_usize).prop_map(|((a, x), (b, y), kind)| match kind {
            0 => (format!("({a} + {b})"), x + y),
            1 => (format!("({a} - {b})"), x - y),
            2 => (format!("{a} * {b}"), x * y),
            _ => (format!("({a} if {a} > {b} else {b})"), x.max(y)),
        })
    })
}

proptest! {
    #[test]
    fn sums_and_products((text, value) in number()) {
        prop_assume!(value.abs() < 1e15);
        let found = expanded(&format!(r#"<a b="${{float({})}}"/>"#, text.replace('>', "&gt;")), &[]);
        let found = found.unwrap();
        let document = roxmltree::Document::parse(&found).unwrap();
        let shown = document.descendants().find_map(|node| node.attribute("b")).unwrap();
        prop_assert_eq!(shown.parse::<f64>().unwrap(), value);
    }

    /// Any damage to a file gives a description or an error, never a panic.
    #[test]
    fn damage_never_panics(
        changes in prop::collection::vec((0..12_000_usize, 32..127_u8), 1..6),
        cut in prop::option::of(0..12_000_usize),
    ) {
        let mut bytes = std::fs::read(common::fixture("xacro/language.xacro")).unwrap();
        for (place, byte) in changes {
            let place = place % bytes.len();
            bytes[place] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut % bytes.len());
        }
        let folder = tempfile::tempdir().unwrap();
        let path: PathBuf = folder.path().join("r.xacro");
        std::fs::write(&path, bytes).unwrap();
        let given = XacroArguments::default();
        let _ = Description::read(Path::new(&path), &PackageRoots::new(), &given);
    }
}
