//! Robot descriptions that are none, or that attack.

use crate::desk::text;
use crate::folder::Recorded;
use crate::outcome::assert_unusable;
use crate::run::eyebolt;

/// A recording whose description of the robot has `from` replaced by `to`.
#[track_caller]
fn spoilt(from: &str, to: &str) -> Recorded {
    let recorded = Recorded::two();
    recorded.replace("arm.urdf", from, to);
    recorded
}

#[test]
fn an_axis_that_is_no_unit_vector() {
    let recorded = spoilt("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"1 1 0\"/>");
    let words =
        ["arm.urdf, line", "joint `lift`", "<axis>, xyz", "1.4142", "0.707107 0.707107 0.0"];
    assert_unusable(recorded.path(), &words);
}

#[test]
fn an_axis_of_no_length() {
    let recorded = spoilt("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 0 0\"/>");
    assert_unusable(recorded.path(), &["arm.urdf, line", "joint `lift`", "zero", "write the dir"]);
}

#[test]
fn links_in_a_circle() {
    let recorded = spoilt("<parent link=\"base\"/>", "<parent link=\"hand\"/>");
    assert_unusable(recorded.path(), &["arm.urdf", "cycle", "hand", "remove one joint"]);
}

#[test]
fn a_circle_without_a_root() {
    let closing = "<joint name=\"closing\" type=\"fixed\"><parent link=\"hand\"/>\
                   <child link=\"base\"/></joint></robot>";
    let recorded = spoilt("</robot>", closing);
    assert_unusable(recorded.path(), &["arm.urdf", "no link is the root", "cycle"]);
}

#[test]
fn two_roots() {
    let recorded = spoilt("</robot>", "<link name=\"stray\"/></robot>");
    let said = eyebolt(&["info", text(recorded.path())]).out;
    for words in ["left out", "arm.urdf", "more than one root", "stray", "fixed joints"] {
        assert!(said.contains(words), "no {words:?} in: {said}");
    }
}

/// A billion laughs: ten entities, each of ten of the one before.
#[test]
fn entities_that_grow() {
    let mut doctype = String::from("<!DOCTYPE robot [<!ENTITY e0 \"laugh\">");
    for level in 1..10 {
        let ten = format!("&e{};", level - 1).repeat(10);
        doctype += &format!("<!ENTITY e{level} \"{ten}\">");
    }
    let recorded =
        spoilt("<robot name=\"newcomer\">", &format!("{doctype}]><robot name=\"&e9;\">"));
    assert_unusable(recorded.path(), &["arm.urdf", "not plain XML", "remove the DOCTYPE"]);
}

#[test]
fn an_entity_that_is_a_file() {
    let doctype =
        "<!DOCTYPE robot [<!ENTITY e SYSTEM \"file:///etc/passwd\">]><robot name=\"&e;\">";
    let recorded = spoilt("<robot name=\"newcomer\">", doctype);
    assert_unusable(recorded.path(), &["arm.urdf", "not plain XML", "remove the DOCTYPE"]);
}
