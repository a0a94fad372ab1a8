//! Where frames are that never move against each other.

use crate::message::StaticTransform;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use std::collections::{BTreeMap, VecDeque};

/// The pose of `from` in `to`, if `transforms` connect them.
pub(super) fn between(
    transforms: &[StaticTransform],
    to: &str,
    from: &str,
) -> Option<Isometry3<f64>> {
    let mut reached = BTreeMap::from([(to, Isometry3::identity())]);
    let mut queue = VecDeque::from([to]);
    while let Some(frame) = queue.pop_front() {
        let to_from_frame = *reached.get(frame)?;
        for transform in transforms {
            let (parent, child) = (transform.parent.as_str(), transform.child.as_str());
            let (next, frame_from_next) = if parent == frame {
                (child, isometry(transform)?)
            } else if child == frame {
                (parent, isometry(transform)?.inverse())
            } else {
                continue;
            };
            if !reached.contains_key(next) {
                reached.insert(next, to_from_frame * frame_from_next);
                queue.push_back(next);
            }
        }
    }
    reached.get(from).copied()
}

/// `None` where the numbers make no pose.
fn isometry(transform: &StaticTransform) -> Option<Isometry3<f64>> {
    let [x, y, z] = transform.translation_m;
    let [i, j, k, w] = transform.rotation_xyzw;
    let rotation = UnitQuaternion::try_new(Quaternion::new(w, i, j, k), 1e-3)?;
    let pose = Isometry3::from_parts(Translation3::new(x, y, z), rotation);
    pose.to_homogeneous().iter().all(|number| number.is_finite()).then_some(pose)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(parent: &str, child: &str, translation_m: [f64; 3]) -> StaticTransform {
        let rotation_xyzw = [0.0, 0.0, 0.6, 0.8];
        let (parent, child) = (parent.to_owned(), child.to_owned());
        StaticTransform { parent, child, translation_m, rotation_xyzw }
    }

    #[test]
    fn frames_are_connected_over_their_parents() {
        let tree = [
            edge("link", "depth", [0.1, 0.0, 0.0]),
            edge("link", "color", [0.0, 0.2, 0.0]),
            edge("other", "lost", [0.0; 3]),
        ];
        let there = between(&tree, "color", "depth").unwrap();
        let back = between(&tree, "depth", "color").unwrap();
        assert!((there * back).translation.vector.norm() < 1e-12);
        // Both are turned alike against the link.
        assert!(there.rotation.angle() < 1e-12);
        assert!((there.translation.vector.norm() - 0.1_f64.hypot(0.2)).abs() < 1e-12);
        assert!(between(&tree, "color", "lost").is_none());
        assert!(between(&tree, "color", "nowhere").is_none());
    }
}
