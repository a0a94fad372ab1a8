//! What each consumer reads, by its own rules and as strictly as the strictest version of it.

use crate::poses::of_quaternion;
use nalgebra::Matrix4;
use serde::Deserialize;

/// What a consumer has read.
#[derive(Debug)]
pub struct Read {
    pub parent: String,
    pub child: String,
    pub matrix: Matrix4<f64>,
}

/// A number as C's `stod`, Python's `float` and YAML's float all take it.
fn number(text: &str) -> f64 {
    let plain = |c: char| c.is_ascii_digit() || c == '-' || c == '.';
    assert!(text.contains('.') && text.chars().all(plain), "not a plain number: {text}");
    text.parse().unwrap()
}

/// Words as a POSIX shell, and `shlex.split`, makes them; comments are left out.
pub fn shell_words(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let (mut word, mut in_word, mut in_quotes) = (String::new(), false, false);
        let mut chars = line.chars();
        while let Some(c) = chars.next() {
            match c {
                '\'' => (in_quotes, in_word) = (!in_quotes, true),
                _ if in_quotes => word.push(c),
                '\\' => (word.push(chars.next().unwrap()), in_word = true).1,
                ' ' if in_word => {
                    words.push(std::mem::take(&mut word));
                    in_word = false;
                }
                ' ' => {}
                _ => {
                    assert!(!"$`\"*?[]{}();&|<>~!#".contains(c), "{c} is not itself in: {line}");
                    word.push(c);
                    in_word = true;
                }
            }
        }
        assert!(!in_quotes, "open quote: {line}");
        if in_word {
            words.push(word);
        }
    }
    words
}

/// `static_transform_publisher` of ROS 2: each option with a value, in any order.
pub fn ros2_publisher(arguments: &[String]) -> Read {
    let get = |option: &str| {
        let at = arguments.iter().step_by(2).position(|argument| argument == option).unwrap();
        arguments[2 * at + 1].clone()
    };
    assert_eq!(arguments.len(), 18, "{arguments:?}");
    let numbers = |options: &[&str]| options.iter().map(|o| number(&get(o))).collect::<Vec<_>>();
    Read {
        parent: get("--frame-id"),
        child: get("--child-frame-id"),
        matrix: of_quaternion(
            numbers(&["--x", "--y", "--z"]).try_into().unwrap(),
            numbers(&["--qx", "--qy", "--qz", "--qw"]).try_into().unwrap(),
        ),
    }
}

/// `static_transform_publisher` of tf2 in ROS 1: nine arguments mean a quaternion.
pub fn ros1_publisher(arguments: &[String]) -> Read {
    let [x, y, z, qx, qy, qz, qw, parent, child] = arguments else { panic!("{arguments:?}") };
    Read {
        parent: parent.clone(),
        child: child.clone(),
        matrix: of_quaternion(
            [x, y, z].map(|text| number(text)),
            [qx, qy, qz, qw].map(|text| number(text)),
        ),
    }
}

/// The arguments of the one node of a Python launch file: string literals up to the bracket.
pub fn python_arguments(text: &str) -> Vec<String> {
    let first_two: Vec<_> = text.lines().take(2).collect();
    assert!(first_two.iter().all(|line| line.starts_with("# ") && !line.contains("coding")));
    let code: Vec<_> = text.lines().skip_while(|line| line.starts_with('#')).collect();
    assert_eq!(
        code[..2],
        ["from launch import LaunchDescription", "from launch_ros.actions import Node"]
    );
    let list = code.iter().skip_while(|line| line.trim() != "arguments=[").skip(1);
    let mut strings = Vec::new();
    for line in list.take_while(|line| line.trim() != "],") {
        let mut rest = line.trim();
        while let Some(inside) = rest.strip_prefix('"') {
            let (string, after) = python_string(inside);
            strings.push(string);
            rest = after.strip_prefix(',').unwrap().trim_start();
        }
        assert_eq!(rest, "", "{line}");
    }
    strings
}

fn python_string(text: &str) -> (String, &str) {
    let mut string = String::new();
    let mut chars = text.chars();
    loop {
        match chars.next().expect("a closing quote") {
            '"' => return (string, chars.as_str()),
            '\\' => string.push(chars.next().filter(|c| "\\\"".contains(*c)).unwrap()),
            c => string.push(c),
        }
    }
}

/// What XML makes of an attribute's text.
pub fn xml_attribute(document: &str, name: &str) -> String {
    let start = document.find(&format!(" {name}=\"")).unwrap() + name.len() + 3;
    let raw = &document[start..start + document[start..].find('"').unwrap()];
    assert!(!raw.contains('<'), "{raw}");
    let entities =
        [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    entities.iter().fold(raw.to_owned(), |text, (entity, c)| text.replace(entity, c))
}

/// `set_message_fields` on `easy_handeye2_msgs/HandeyeCalibration`, then its publisher.
pub fn easy_handeye2(text: &str) -> Read {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        parameters: Parameters,
        transform: Pose,
    }
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "the fields must be there, whatever they say")]
    struct Parameters {
        name: String,
        calibration_type: String,
        robot_base_frame: String,
        robot_effector_frame: String,
        tracking_base_frame: String,
        tracking_marker_frame: String,
        freehand_robot_movement: bool,
        move_group_namespace: String,
        move_group: String,
    }
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Pose {
        translation: Xyz,
        rotation: Xyzw,
    }
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Xyz {
        x: f64,
        y: f64,
        z: f64,
    }
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Xyzw {
        x: f64,
        y: f64,
        z: f64,
        w: f64,
    }
    let file: File = serde_saphyr::from_str(text).unwrap();
    assert_eq!(file.parameters.calibration_type, "eye_on_base");
    assert_eq!(file.parameters.robot_effector_frame, "hand");
    let (t, q) = (file.transform.translation, file.transform.rotation);
    Read {
        parent: file.parameters.robot_base_frame,
        child: file.parameters.tracking_base_frame,
        matrix: of_quaternion([t.x, t.y, t.z], [q.x, q.y, q.z, q.w]),
    }
}

/// `HandeyeCalibration.from_dict` of easy_handeye, whose constructor takes no other names.
pub fn easy_handeye(text: &str) -> Read {
    #[derive(Deserialize)]
    struct File {
        parameters: Parameters,
        transformation: Pose,
    }
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "the fields must be there, whatever they say")]
    struct Parameters {
        namespace: String,
        move_group_namespace: String,
        move_group: String,
        eye_on_hand: bool,
        robot_base_frame: String,
        robot_effector_frame: String,
        tracking_base_frame: String,
        tracking_marker_frame: String,
    }
    #[derive(Deserialize)]
    struct Pose {
        x: f64,
        y: f64,
        z: f64,
        qx: f64,
        qy: f64,
        qz: f64,
        qw: f64,
    }
    let file: File = serde_saphyr::from_str(text).unwrap();
    let Parameters { namespace, eye_on_hand, .. } = &file.parameters;
    assert!(!eye_on_hand && namespace.starts_with('/') && namespace.ends_with('/'));
    let pose = file.transformation;
    Read {
        parent: file.parameters.robot_base_frame,
        child: file.parameters.tracking_base_frame,
        matrix: of_quaternion([pose.x, pose.y, pose.z], [pose.qx, pose.qy, pose.qz, pose.qw]),
    }
}

/// `numpy.loadtxt(file, delimiter=",")`.
pub fn csv(text: &str) -> Matrix4<f64> {
    let rows: Vec<Vec<f64>> =
        text.lines().map(|line| line.split(',').map(number).collect()).collect();
    assert!(rows.len() == 4 && rows.iter().all(|row| row.len() == 4), "{text}");
    Matrix4::from_row_iterator(rows.into_iter().flatten())
}

/// `numpy.load`.
pub fn npy(bytes: &[u8]) -> Matrix4<f64> {
    assert_eq!(bytes[..8], *b"\x93NUMPY\x01\x00");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!((10 + length) % 64, 0);
    let (header, data) = bytes[10..].split_at(length);
    let header = std::str::from_utf8(header).unwrap();
    let dictionary = "{'descr': '<f8', 'fortran_order': False, 'shape': (4, 4), }";
    assert!(header.trim_end() == dictionary && header.ends_with('\n'), "{header}");
    assert_eq!(data.len(), 16 * 8);
    Matrix4::from_row_iterator(
        data.chunks_exact(8).map(|number| f64::from_le_bytes(number.try_into().unwrap())),
    )
}

/// tf2's listener of `/tf_static`, as a player of the file feeds it: the fields of
/// `tf2_msgs/TFMessage` in little-endian CDR.
pub fn static_transform(bytes: &[u8]) -> Read {
    let messages: Vec<_> = mcap::MessageStream::new(bytes).unwrap().map(Result::unwrap).collect();
    let [message] = messages.as_slice() else { panic!("{} messages", messages.len()) };
    let schema = message.channel.schema.as_ref().unwrap();
    assert_eq!(
        (schema.name.as_str(), schema.encoding.as_str()),
        ("tf2_msgs/msg/TFMessage", "ros2msg")
    );
    assert_eq!(
        (&*message.channel.topic, &*message.channel.message_encoding),
        ("/tf_static", "cdr")
    );
    // Who comes late must hear it all the same: durability 1 is transient local.
    assert!(message.channel.metadata["offered_qos_profiles"].contains("durability: 1"));
    let (encapsulation, body) = message.data.split_at(4);
    assert_eq!(encapsulation, [0, 1, 0, 0]);
    let mut at = 0_usize;
    let mut take = |size: usize, align: usize| {
        at = at.next_multiple_of(align);
        at += size;
        &body[at - size..at]
    };
    let count = u32::from_le_bytes(take(4, 4).try_into().unwrap());
    assert_eq!(count, 1);
    take(8, 4);
    let mut text = || {
        let length = u32::from_le_bytes(take(4, 4).try_into().unwrap()) as usize;
        let (text, zero) = take(length, 1).split_at(length - 1);
        assert_eq!(zero, [0]);
        String::from_utf8(text.to_vec()).unwrap()
    };
    let (parent, child) = (text(), text());
    let [x, y, z, qx, qy, qz, qw] =
        std::array::from_fn(|_| f64::from_le_bytes(take(8, 8).try_into().unwrap()));
    assert_eq!(at, body.len());
    Read { parent, child, matrix: of_quaternion([x, y, z], [qx, qy, qz, qw]) }
}
