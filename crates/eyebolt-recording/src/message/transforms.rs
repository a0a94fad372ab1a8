//! `tf2_msgs/TFMessage`.

use super::header::Header;
use super::wire::{WireProblem, WireReader};
use super::writer::WireWriter;

/// A transform between two named frames that does not change.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticTransform {
    /// The frame that coordinates are mapped to.
    pub parent: String,
    /// The frame that they are mapped from.
    pub child: String,
    /// Origin of the child in the parent, metres.
    pub translation_m: [f64; 3],
    /// Hamilton quaternion from the child to the parent, as stored: not always a unit one.
    pub rotation_xyzw: [f64; 4],
}

/// Bytes of a transform with empty names.
const SMALLEST_TRANSFORM: usize = 60;

/// All transforms of a message.
pub(crate) fn transforms(reader: &mut WireReader<'_>) -> Result<Vec<StaticTransform>, WireProblem> {
    let count = reader.count("transforms", SMALLEST_TRANSFORM)?;
    let mut read = || {
        let header = Header::read(reader)?;
        // ROS 1's first library wrote names with a slash before them.
        let name = |text: &str| text.strip_prefix('/').unwrap_or(text).to_owned();
        Ok(StaticTransform {
            parent: name(header.frame_id),
            child: name(reader.string("transforms.child_frame_id")?),
            translation_m: reader.f64_array("transforms.transform.translation")?,
            rotation_xyzw: reader.f64_array("transforms.transform.rotation")?,
        })
    };
    (0..count).map(|_| read()).collect()
}

/// `transforms` as a `tf2_msgs/TFMessage` in CDR, all of one time.
pub fn write_transforms(transforms: &[StaticTransform], stamp_ns: i64) -> Vec<u8> {
    let mut writer = WireWriter::new();
    writer.count(transforms.len());
    for transform in transforms {
        Header { stamp_ns, frame_id: &transform.parent }.write(&mut writer);
        writer.string(&transform.child);
        writer.f64_array(&transform.translation_m);
        writer.f64_array(&transform.rotation_xyzw);
    }
    writer.finish()
}
