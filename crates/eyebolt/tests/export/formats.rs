//! Whatever the pose, every consumer reads the one that was written.

use crate::consumers::{
    Read, csv, easy_handeye, easy_handeye2, npy, python_arguments, ros1_publisher, ros2_publisher,
    shell_words, static_transform, xml_attribute,
};
use crate::poses::{config, of_roll_pitch_yaw, placement, pose};
use eyebolt::export::{Format, Named, Placement};
use eyebolt_geometry::Transform;
use eyebolt_robot::{PackageRoots, Robot};
use nalgebra::{Matrix4, Vector3};
use proptest::prelude::*;

fn text(format: Format, placement: &Placement) -> String {
    let text = String::from_utf8(format.write(placement, "cell-3")).unwrap();
    assert!(text.ends_with('\n') && !text.contains('\r'));
    text
}

/// What the consumer of `format` makes of what is written.
pub fn read(format: Format, placement: &Placement) -> Read {
    let unnamed = |matrix| Read {
        parent: placement.parent.as_str().to_owned(),
        child: placement.child.as_str().to_owned(),
        matrix,
    };
    match format {
        Format::Tf2 => {
            let words = shell_words(&text(format, placement));
            assert_eq!(words[..4], ["ros2", "run", "tf2_ros", "static_transform_publisher"]);
            ros2_publisher(&words[4..])
        }
        Format::Tf2Ros1 => {
            let words = shell_words(&text(format, placement));
            assert_eq!(words[..3], ["rosrun", "tf2_ros", "static_transform_publisher"]);
            ros1_publisher(&words[3..])
        }
        Format::Ros2Launch | Format::Moveit => {
            ros2_publisher(&python_arguments(&text(format, placement)))
        }
        Format::MoveitRos1 => {
            let arguments = xml_attribute(&text(format, placement), "args");
            assert!(!arguments.contains("$("), "roslaunch would replace it: {arguments}");
            ros1_publisher(&shell_words(&arguments))
        }
        Format::EasyHandeye2 => easy_handeye2(&text(format, placement)),
        Format::EasyHandeye => easy_handeye(&text(format, placement)),
        Format::Urdf => urdf(&text(format, placement), placement.parent.as_str()),
        Format::Csv => unnamed(csv(&text(format, placement))),
        Format::Npy => unnamed(npy(&format.write(placement, ""))),
        Format::Mcap => static_transform(&format.write(placement, "")),
        other => panic!("{other:?} has no reader here"),
    }
}

/// The joint in a robot that has the parent's link.
fn urdf(text: &str, parent: &str) -> Read {
    assert_eq!(xml_attribute(text, "link"), parent, "the first link that the joint names");
    let raw = text.split("parent link=\"").nth(1).unwrap().split('"').next().unwrap();
    let whole = text.replacen("<link", &format!("<link name=\"{raw}\"/><link"), 1);
    let robot = Robot::from_urdf_str(&whole, None, &PackageRoots::new()).unwrap();
    let [joint] = &robot.joints[..] else { panic!("{whole}") };
    assert!(!joint.moves());
    let numbers = |name| -> [f64; 3] {
        let words = shell_words(&xml_attribute(text, name));
        let numbers: Vec<f64> = words.iter().map(|word| word.parse().unwrap()).collect();
        numbers.try_into().unwrap()
    };
    let matrix = of_roll_pitch_yaw(numbers("xyz"), numbers("rpy"));
    let by_robot = joint.parent_from_child_at_zero.matrix();
    assert!((matrix - by_robot).amax() < 1e-11, "{matrix} {by_robot}");
    Read {
        parent: robot.links[joint.parent].name.clone(),
        child: robot.links[joint.child].name.clone(),
        matrix,
    }
}

/// Largest difference that the reader's own arithmetic excuses.
fn excused(matrix: &Matrix4<f64>) -> f64 {
    1e-14 * (1.0 + matrix.amax())
}

proptest! {
    #![proptest_config(config(512))]

    #[test]
    fn every_consumer_reads_the_pose_of_the_child_in_the_parent(pose in pose()) {
        let placement = placement("base_link", "camera_optical", pose);
        let truth = placement.parent_from_child.matrix();
        for format in Format::ALL {
            let read = read(format, &placement);
            prop_assert_eq!((&*read.parent, &*read.child), ("base_link", "camera_optical"));
            let off = (read.matrix - truth).amax();
            prop_assert!(off <= excused(&truth), "{format:?}: {off:e}");
        }
    }
}

fn example() -> Placement {
    let pose = Transform::from_xyzw([0.5, -0.25, 2.0], [0.5, -0.5, 0.5, -0.5]).unwrap();
    placement("base_link", "camera_optical", pose)
}

/// A camera 2 m above the base that looks down: what is 1.5 m before it is 0.5 m above the base.
#[test]
fn the_direction_is_that_of_the_pose() {
    let looks_down = Transform::<Named, Named>::from_xyzw([0.0, 0.0, 2.0], [1.0, 0.0, 0.0, 0.0]);
    let placement = placement("base", "camera", looks_down.unwrap());
    for format in Format::ALL {
        let seen_in_base = read(format, &placement).matrix * Vector3::new(0.1, 0.2, 1.5).push(1.0);
        let expected = Vector3::new(0.1, -0.2, 0.5).push(1.0);
        assert!((seen_in_base - expected).amax() < 1e-15, "{format:?}: {seen_in_base}");
    }
}

#[test]
fn commands_are_as_people_write_them() {
    let command = text(Format::Tf2, &example());
    assert_eq!(
        command.lines().last().unwrap(),
        "ros2 run tf2_ros static_transform_publisher --x 0.5 --y -0.25 --z 2.0 --qx -0.5 --qy 0.5 \
         --qz -0.5 --qw 0.5 --frame-id base_link --child-frame-id camera_optical"
    );
    let command = text(Format::Tf2Ros1, &example());
    assert_eq!(
        command.lines().last().unwrap(),
        "rosrun tf2_ros static_transform_publisher 0.5 -0.25 2.0 -0.5 0.5 -0.5 0.5 base_link \
         camera_optical"
    );
}

#[test]
fn the_matrix_is_rows_of_numbers() {
    let rows = "0.0,0.0,1.0,0.5\n-1.0,0.0,0.0,-0.25\n0.0,-1.0,0.0,2.0\n0.0,0.0,0.0,1.0\n";
    assert_eq!(text(Format::Csv, &example()), rows);
}

/// Formats that have no place for a comment.
fn bare(format: Format) -> bool {
    matches!(format, Format::Csv | Format::Npy | Format::Mcap)
}

#[test]
fn comments_tell_the_direction_and_the_axes() {
    for format in Format::ALL.into_iter().filter(|f| !bare(*f)) {
        let mut placement = example();
        let optical = text(format, &placement);
        assert!(optical.contains("depth optical frame: x right, y down, z forward"), "{optical}");
        assert!(optical.contains("maps coordinates in"), "{optical}");
        placement.child_is_optical = false;
        assert!(!text(format, &placement).contains("optical frame"), "{format:?}");
    }
}

#[test]
fn hand_eye_files_are_called_as_ros_allows() {
    let calib = text(Format::EasyHandeye2, &example());
    assert!(calib.contains("name: \"cell_3\""), "{calib}");
    let yaml = text(Format::EasyHandeye, &example());
    assert!(yaml.contains("namespace: \"/cell_3/\""), "{yaml}");
    let digits = Format::EasyHandeye.write(&example(), "3 über");
    assert!(String::from_utf8(digits).unwrap().contains("\"/camera3__ber/\""));
}

#[test]
fn the_catalogue_names_each_format_once() {
    let names: std::collections::BTreeSet<_> = Format::ALL.map(Format::name).into();
    assert_eq!(names.len(), Format::ALL.len());
    let kebab = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    assert!(names.iter().all(|name| name.chars().all(kebab)));
}
