//! `/tf_static` in an MCAP file.

use super::placement::Placement;
use eyebolt_recording::{StaticTransform, write_static_transforms};
use std::io::Cursor;

/// Transforms that never change are as good at any time.
const STAMP_NS: i64 = 0;

/// A file with one message of one transform.
pub(super) fn write(placement: &Placement) -> Vec<u8> {
    let transform = StaticTransform {
        parent: placement.parent.as_str().to_owned(),
        child: placement.child.as_str().to_owned(),
        translation_m: placement.parent_from_child.translation_m().into(),
        rotation_xyzw: placement.parent_from_child.rotation_xyzw(),
    };
    let mut bytes = Vec::new();
    write_static_transforms(&[transform], STAMP_NS, Cursor::new(&mut bytes))
        .expect("memory takes what is written to it");
    bytes
}
