//! Whatever a frame is called, every consumer reads that name, and nothing runs.

use crate::formats::read;
use crate::poses::{config, placement};
use eyebolt::export::{Format, FrameName};
use eyebolt_geometry::Transform;
use proptest::prelude::*;

/// Names of all that means something to a shell, to Python, XML, YAML or ROS.
fn nasty() -> impl Strategy<Value = String> {
    let part = prop_oneof![
        "[a-z_/]{1,6}",
        "[ '\"\\\\`$&|;<>(){}\\[\\]#!*?~=:%@,.+^-]{1,4}",
        "[äß日\u{1f600}]{1,2}",
        Just("--x".to_owned()),
        Just("]]>".to_owned()),
        Just("&lt;".to_owned()),
        Just("-->".to_owned()),
        Just("\"\"\"".to_owned()),
        Just("coding: utf-7".to_owned()),
    ];
    let name = prop::collection::vec(part, 1..5).prop_map(|parts| parts.concat());
    name.prop_filter("a name", |name| {
        FrameName::new(name).is_ok_and(|checked| checked.as_str() == name)
    })
}

proptest! {
    #![proptest_config(config(512))]

    #[test]
    fn every_consumer_reads_the_names(parent in nasty(), child in nasty()) {
        prop_assume!(parent != child);
        let placement = placement(&parent, &child, Transform::identity());
        for format in Format::ALL {
            let read = read(format, &placement);
            prop_assert_eq!((&read.parent, &read.child), (&parent, &child), "{:?}", format);
        }
    }
}

proptest! {
    #![proptest_config(config(48))]

    /// The shell itself is asked.
    #[cfg(unix)]
    #[test]
    fn a_shell_hands_the_names_on(parent in nasty(), child in nasty()) {
        let placement = placement(&parent, &child, Transform::identity());
        for (format, command, at) in [(Format::Tf2, "ros2", [18, 20]), (Format::Tf2Ros1, "rosrun", [9, 10])] {
            let text = String::from_utf8(format.write(&placement, "")).unwrap();
            let script = format!("{command}() {{ printf '%s\\0' \"$@\"; }}\n{text}");
            let output = std::process::Command::new("sh").args(["-c", &script]).output().unwrap();
            prop_assert!(output.status.success() && output.stderr.is_empty());
            let said = String::from_utf8(output.stdout).unwrap();
            let words: Vec<_> = said.split_terminator('\0').collect();
            prop_assert_eq!(words.len(), at[1] + 1);
            prop_assert_eq!(at.map(|index| words[index]), [&*parent, &*child]);
        }
    }
}

#[test]
fn what_is_no_name_is_refused_with_a_reason() {
    let long = "x".repeat(257);
    let cases = [
        ("", "empty"),
        ("/", "empty"),
        ("a\nb", "control"),
        ("a\u{0}", "control"),
        ("a\u{7f}", "control"),
        ("a\u{85}b", "control"),
        ("a\u{2028}b", "control"),
        ("\u{feff}a", "control"),
        ("-x", "option"),
        ("/--help", "option"),
        ("a:=b", "remapping"),
        ("$(env HOME)", "roslaunch"),
        ("${1 + 1}", "xacro"),
        (&long, "256"),
    ];
    for (name, word) in cases {
        let error = FrameName::new(name).unwrap_err().to_string();
        assert!(error.contains(word) && error.contains("Rename"), "{error}");
        assert!(!error.contains(char::is_control), "{error:?}");
    }
}

#[test]
fn a_slash_of_the_first_tf_is_dropped() {
    assert_eq!(FrameName::new("/camera/link").unwrap().as_str(), "camera/link");
}
