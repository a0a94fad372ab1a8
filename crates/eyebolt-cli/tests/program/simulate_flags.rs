//! What `eyebolt simulate` says to someone who asks for what there is not.

use crate::desk::Desk;
use crate::simulate::simulate;
use eyebolt::simulate::PRESETS;
use eyebolt_render::Sensor;

/// Checks that these flags end with `code` and `words`, and that nothing is left behind.
#[track_caller]
fn assert_refused(flags: &[&str], code: i32, words: &[&str]) {
    let desk = Desk::new();
    let words: Vec<&str> = words.iter().chain(&flags[..1]).copied().collect();
    simulate(&desk.file("a.mcap"), flags).assert_error(code, &words);
    assert!(desk.names().is_empty());
}

#[test]
fn names_that_are_not_known_are_answered_with_those_that_are() {
    let sensors: Vec<&str> = Sensor::names().collect();
    assert_refused(&["--sensor", "kinect-v9"], 2, &[&sensors[..], &["kinect-v9"]].concat());
    let presets: Vec<&str> = PRESETS.iter().map(|preset| preset.name).collect();
    assert_refused(&["--preset", "paper-p9"], 2, &[&presets[..], &["paper-p9"]].concat());
    assert_refused(&["--robot", "no/arm.urdf"], 1, &["no/arm.urdf", "shackle", "cleat", "URDF"]);
    assert_refused(&["--second-arm", "dancing"], 2, &["dancing", "still", "moving"]);
}

#[test]
fn counts_are_whole_and_mostly_above_0() {
    for flag in ["--configurations", "--frames"] {
        for count in ["0", "1.5", "many", "70000"] {
            assert_refused(&[flag, count], 2, &[count]);
        }
    }
    for flag in
        ["--passers-by", "--moving-frames", "--backgrounds", "--clutter", "--seed", "--threads"]
    {
        assert_refused(&[flag, "few"], 2, &["few"]);
    }
}

#[test]
fn ranges_are_of_numbers_that_a_camera_can_have() {
    let broken = ["3,1", "nan", "1,nan", "inf", "-inf,inf", "1,2,3", "far", "1,", "", "1e9"];
    for (flag, limits) in [
        ("--distance-m", "0.2 to 20"),
        ("--azimuth-deg", "-400 to 400"),
        ("--elevation-deg", "-90 to 90"),
    ] {
        for value in broken {
            assert_refused(&[flag, value], 2, &["LOW,HIGH", limits]);
        }
    }
    for value in ["0", "-1", "1,21"] {
        assert_refused(&["--distance-m", value], 2, &[value, "0.2 to 20"]);
    }
    let both = ["--distance-m", "1", "--preset", "paper-test-p1"];
    assert_refused(&both, 2, &["--preset", "cannot be used with"]);
}

#[test]
fn faults_are_numbers_within_reason() {
    let flags = [
        ("--depth-scale", "0.1 to 10"),
        ("--depth-offset-mm", "-1000 to 1000"),
        ("--focal-scale", "0.1 to 10"),
        ("--joint-offset-deg", "0 to 90"),
        ("--backlash-deg", "0 to 90"),
        ("--time-skew-ms", "-900 to 900000"),
        ("--centre-px", "-10000 to 10000"),
        ("--bump", "0 to 10000"),
        ("--one-joint-offset-deg", "0 to 90"),
        ("--link-length-mm", "-100 to 100"),
        ("--occlusion", "0 to 0.9"),
        ("--gloss", "0 to 0.9"),
        ("--wander-mm", "0 to 100"),
        ("--tool-mm", "0 to 1000"),
        ("--other-rooms", "0 to 1"),
        ("--fixed-pattern", "0 to 10"),
    ];
    for (flag, limits) in flags {
        for value in ["nan", "inf", "-inf", "1e9", "-1e9", "much", ""] {
            assert_refused(&[flag, value], 2, &[value, limits]);
        }
    }
    for flag in ["--centre-px", "--bump"] {
        for value in ["1,nan", "1,2,3", "1,", ",1", "1,1e9"] {
            assert_refused(&[flag, value], 2, &[value]);
        }
    }
}

#[test]
fn a_camera_that_sees_nothing_is_told_what_to_do() {
    let far = ["--distance-m", "15", "--configurations", "2"];
    assert_refused(&far, 1, &["0 configurations", "--azimuth-deg"]);
}

#[test]
fn a_base_that_is_not_there_is_answered_with_those_there_are() {
    assert_refused(&["--base", "nosuch"], 1, &["nosuch", "link0"]);
    assert_refused(&["--end-effector", "nosuch"], 1, &["nosuch", "hand"]);
}
