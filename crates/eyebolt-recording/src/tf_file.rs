//! Messages of `/tf_static` in text: `tf2_msgs/TFMessage` in YAML, of which JSON is a part.

use crate::error::RecordingError;
use crate::file::read_text;
use crate::message::StaticTransform;
use serde::Deserialize;
use std::fmt::Write;
use std::path::Path;

/// What to do about a file that has none.
const REMEDY: &str = "Store what `ros2 topic echo --full-length /tf_static` prints";

/// The fields of ROS 1 and ROS 2; those that are of no use here are not named.
#[derive(Deserialize)]
struct Message {
    transforms: Option<Vec<Stamped>>,
}

#[derive(Deserialize)]
struct Stamped {
    header: Option<Header>,
    child_frame_id: Option<String>,
    transform: Option<Pose>,
}

#[derive(Deserialize)]
struct Header {
    frame_id: Option<String>,
}

#[derive(Deserialize)]
struct Pose {
    translation: Option<Xyz>,
    rotation: Option<Xyzw>,
}

#[derive(Deserialize)]
struct Xyz {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Deserialize)]
struct Xyzw {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

/// The transforms in the file at `path`, which is `field` to the recording.
pub(crate) fn read(path: &Path, field: &str) -> Result<Vec<StaticTransform>, RecordingError> {
    parse_static_transforms(path, &read_text(path, field)?)
}

/// The transforms of all messages in `text`, as `ros2 topic echo` or `rostopic echo` prints them:
/// `/tf_static` has one for each publisher. `path` is for messages.
///
/// # Errors
///
/// Text that is no such message, one without transforms, or one with a field missing.
pub fn parse_static_transforms(
    path: &Path,
    text: &str,
) -> Result<Vec<StaticTransform>, RecordingError> {
    let messages: Vec<Message> = serde_saphyr::from_multiple(text).map_err(|error| {
        let problem = error.without_snippet().to_string();
        RecordingError::invalid(path, "transforms", problem, REMEDY)
    })?;
    let mut found = Vec::new();
    for message in messages {
        let transforms = message.transforms.ok_or_else(|| missing(path, "transforms"))?;
        for (index, stamped) in transforms.into_iter().enumerate() {
            found.push(transform(path, index, stamped)?);
        }
    }
    if found.is_empty() {
        return Err(RecordingError::invalid(path, "transforms", "there are none", REMEDY));
    }
    Ok(found)
}

fn missing(path: &Path, field: &str) -> RecordingError {
    RecordingError::invalid(path, field, "the field is missing", REMEDY)
}

fn transform(
    path: &Path,
    index: usize,
    stamped: Stamped,
) -> Result<StaticTransform, RecordingError> {
    let absent = |name: &str| missing(path, &format!("transforms[{index}].{name}"));
    let header = stamped.header.ok_or_else(|| absent("header"))?;
    let transform = stamped.transform.ok_or_else(|| absent("transform"))?;
    let t = transform.translation.ok_or_else(|| absent("transform.translation"))?;
    let q = transform.rotation.ok_or_else(|| absent("transform.rotation"))?;
    Ok(StaticTransform {
        parent: header.frame_id.ok_or_else(|| absent("header.frame_id"))?,
        child: stamped.child_frame_id.ok_or_else(|| absent("child_frame_id"))?,
        translation_m: [t.x, t.y, t.z],
        rotation_xyzw: [q.x, q.y, q.z, q.w],
    })
}

/// The text of a file of `transforms`, bit by bit what they are.
pub(crate) fn text(transforms: &[StaticTransform]) -> String {
    let mut text = "transforms:\n".to_owned();
    for transform in transforms {
        let StaticTransform { parent, child, translation_m, rotation_xyzw } = transform;
        // JSON texts are YAML texts.
        let [parent, child] = [parent, child].map(|name| serde_json::Value::from(name.as_str()));
        let [x, y, z] = translation_m;
        let _ = writeln!(text, "- header: {{frame_id: {parent}}}\n  child_frame_id: {child}");
        let _ = writeln!(text, "  transform:\n    translation: {{x: {x:?}, y: {y:?}, z: {z:?}}}");
        let [x, y, z, w] = rotation_xyzw;
        let _ = writeln!(text, "    rotation: {{x: {x:?}, y: {y:?}, z: {z:?}, w: {w:?}}}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_written_is_read(
            all in prop::collection::vec(
                ("\\PC{1,12}", "\\PC{1,12}", prop::array::uniform3(-9.0..9.0_f64),
                 prop::array::uniform4(-1e-3..1.0_f64)), 1..5),
        ) {
            let transforms: Vec<StaticTransform> = all
                .into_iter()
                .map(|(parent, child, translation_m, rotation_xyzw)| {
                    StaticTransform { parent, child, translation_m, rotation_xyzw }
                })
                .collect();
            let read = parse_static_transforms(Path::new("a.yaml"), &text(&transforms)).unwrap();
            prop_assert_eq!(read, transforms);
        }
    }
}
