//! Messages of `/tf_static` as edges of a tree.

use super::tree::StaticEdge;
use crate::export::error::ExportError;
use crate::export::frame_name::Named;
use eyebolt_geometry::Transform;
use eyebolt_recording::{StaticTransform, parse_static_transforms};
use std::path::Path;

pub(super) const REMEDY: &str = "Store what `ros2 topic echo --full-length /tf_static` prints";

/// The transforms of all messages in `text`: `/tf_static` has one for each publisher.
pub(super) fn edges(file: &str, text: &str) -> Result<Vec<StaticEdge>, ExportError> {
    of_transforms(file, parse_static_transforms(Path::new(file), text)?)
}

/// As edges, if tf2 would take each of them.
pub(super) fn of_transforms(
    file: &str,
    transforms: Vec<StaticTransform>,
) -> Result<Vec<StaticEdge>, ExportError> {
    let edges = transforms.into_iter().enumerate().map(|(index, transform)| {
        let StaticTransform { parent, child, translation_m, rotation_xyzw } = transform;
        let parent_from_child =
            pose(file, &format!("transforms[{index}]"), translation_m, rotation_xyzw)?;
        Ok(StaticEdge { parent, child, parent_from_child })
    });
    edges.collect()
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
