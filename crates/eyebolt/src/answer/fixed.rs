//! Frames that never move against each other, as a recording tells them.

use eyebolt_recording::StaticTransform;
use serde::Serialize;
use std::collections::BTreeSet;

/// The pose of a frame in its parent, against which it never moves.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fixed {
    /// tf's `frame_id`.
    pub parent: String,
    /// tf's `child_frame_id`.
    pub child: String,
    /// Origin of the child in the parent.
    pub translation_m: [f64; 3],
    /// As recorded: not always of unit length.
    pub rotation_xyzw: [f64; 4],
}

/// Those of `all` that are connected to one of `frames`, in their order.
pub(crate) fn around(all: &[StaticTransform], frames: &[&str]) -> Vec<Fixed> {
    let mut known: BTreeSet<&str> =
        frames.iter().copied().filter(|name| !name.is_empty()).collect();
    loop {
        let before = known.len();
        for edge in all {
            if known.contains(edge.parent.as_str()) || known.contains(edge.child.as_str()) {
                known.extend([edge.parent.as_str(), edge.child.as_str()]);
            }
        }
        if known.len() == before {
            break;
        }
    }
    // JSON has no NaN, and tf2 no use for one.
    let finite = |edge: &&StaticTransform| {
        edge.translation_m.iter().chain(&edge.rotation_xyzw).all(|number| number.is_finite())
    };
    let near = all.iter().filter(|edge| known.contains(edge.child.as_str())).filter(finite);
    near.map(|edge| Fixed {
        parent: edge.parent.clone(),
        child: edge.child.clone(),
        translation_m: edge.translation_m,
        rotation_xyzw: edge.rotation_xyzw,
    })
    .collect()
}
