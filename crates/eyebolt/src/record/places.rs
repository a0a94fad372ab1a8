//! Where an arm was before.

use eyebolt_robot::{Arm, JointPositions, KinematicsError, LinkPoses};

/// Frames whose links are this near to each other show the same configuration: more than encoders
/// at rest make of it, less than anyone moves an arm on purpose.
const SAME_M: f64 = 5e-3;
const SAME_RAD: f64 = 1e-2;

/// Whether two frames have the arm in the same place; both are of the same robot.
///
/// The links decide, not the joints: a recording may hold joints of other things.
pub(super) fn same_place(a: &LinkPoses, b: &LinkPoses) -> bool {
    a.iter().zip(b).all(|pair| match pair {
        (Some(a), Some(b)) => {
            let (metres, radians) = a.distance_to(b);
            metres <= SAME_M && radians <= SAME_RAD
        }
        (None, None) => true,
        _ => false,
    })
}

/// The places where an arm was, by the rule that makes configurations of frames.
#[derive(Clone, Debug, Default)]
pub struct Places(Vec<LinkPoses>);

impl Places {
    /// Adds where `joints` put the links of `arm`: the number of that place, from 0, and whether it is new.
    ///
    /// # Errors
    ///
    /// Joints of the arm that are not told.
    pub fn add(
        &mut self,
        arm: &Arm,
        joints: &JointPositions,
    ) -> Result<(usize, bool), KinematicsError> {
        let poses = arm.known_link_poses(joints)?.base_from_links;
        if let Some(known) = self.0.iter().rposition(|place| same_place(place, &poses)) {
            return Ok((known, false));
        }
        self.0.push(poses);
        Ok((self.0.len() - 1, true))
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}
