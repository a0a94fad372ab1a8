//! Messages of `/tf_static` in text: `tf2_msgs/TFMessage` in YAML, of which JSON is a part.

use super::tree::StaticEdge;
use crate::export::error::ExportError;
use crate::export::frame_name::Named;
use eyebolt_geometry::Transform;
use serde::Deserialize;

pub(super) const REMEDY: &str = "Store what `ros2 topic echo --full-length /tf_static` prints";

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

/// The transforms of all messages in `text`: `/tf_static` has one for each publisher.
pub(super) fn edges(file: &str, text: &str) -> Result<Vec<StaticEdge>, ExportError> {
    let messages: Vec<Message> = serde_saphyr::from_multiple(text).map_err(|error| {
        let problem = error.without_snippet().to_string();
        ExportError::invalid(file, "transforms", problem, REMEDY)
    })?;
    let mut edges = Vec::new();
    for message in messages {
        let transforms = message.transforms.ok_or_else(|| missing(file, "transforms"))?;
        for (index, stamped) in transforms.into_iter().enumerate() {
            edges.push(edge(file, index, stamped)?);
        }
    }
    if edges.is_empty() {
        return Err(ExportError::invalid(file, "transforms", "there are none", REMEDY));
    }
    Ok(edges)
}

fn missing(file: &str, field: &str) -> ExportError {
    ExportError::invalid(file, field, "the field is missing", REMEDY)
}

fn edge(file: &str, index: usize, stamped: Stamped) -> Result<StaticEdge, ExportError> {
    let field = |name: &str| format!("transforms[{index}].{name}");
    let absent = |name: &str| missing(file, &field(name));
    let header = stamped.header.ok_or_else(|| absent("header"))?;
    let transform = stamped.transform.ok_or_else(|| absent("transform"))?;
    let t = transform.translation.ok_or_else(|| absent("transform.translation"))?;
    let q = transform.rotation.ok_or_else(|| absent("transform.rotation"))?;
    let parent_from_child =
        pose(file, &format!("transforms[{index}]"), [t.x, t.y, t.z], [q.x, q.y, q.z, q.w])?;
    Ok(StaticEdge {
        parent: header.frame_id.ok_or_else(|| absent("header.frame_id"))?,
        child: stamped.child_frame_id.ok_or_else(|| absent("child_frame_id"))?,
        parent_from_child,
    })
}

/// The pose in `field` of a message, if tf2 would take it.
pub(in crate::export) fn pose(
    file: &str,
    field: &str,
    translation_m: [f64; 3],
    rotation_xyzw: [f64; 4],
) -> Result<Transform<Named, Named>, ExportError> {
    let wrong = |name: &str, problem: &str| {
        let field = format!("{field}.transform.{name}");
        ExportError::invalid(file, field, problem, "Correct what is published")
    };
    if !translation_m.iter().all(|metres| metres.is_finite()) {
        return Err(wrong("translation", "not a number"));
    }
    // tf2 ignores a transform that misses this (QUATERNION_NORMALIZATION_TOLERANCE).
    let squared: f64 = rotation_xyzw.iter().map(|q| q * q).sum();
    let pose = Transform::from_xyzw(translation_m, rotation_xyzw);
    pose.filter(|_| (squared - 1.0).abs() < 1e-2).ok_or_else(|| {
        wrong("rotation", "the quaternion is not of unit length, so tf2 ignores the transform")
    })
}
