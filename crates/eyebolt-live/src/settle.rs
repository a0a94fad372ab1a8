//! Whether an arm rests, by its joints and by what the camera sees.

mod depth;
mod joints;

use depth::DepthChange;
use eyebolt_robot::JointPositions;
use joints::JointMotion;

/// How still an arm is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stillness {
    /// Nobody tells where the joints are.
    Unknown,
    /// It moves, or has just stopped.
    Moving,
    /// It rests, since this time, nanoseconds.
    AtRest(i64),
}

/// Tells when an arm rests. Times are nanoseconds of one clock, and none are before those told earlier.
#[derive(Clone, Debug, Default)]
pub struct Settle {
    joints: JointMotion,
    depth: DepthChange,
    images: u32,
}

/// Joints are still for so long before an arm rests: longer than controllers take to settle.
const HOLD_NS: i64 = 400_000_000;
/// Depth that goes on changing is of something else, if the joints are still for so long.
const PATIENCE_NS: i64 = 2_500_000_000;

impl Settle {
    /// Where joints are at a time, radians, metres for prismatic ones.
    pub fn joints(&mut self, at_ns: i64, positions: &JointPositions) {
        self.joints.add(at_ns, positions);
    }

    /// Depth of some pixels at a time, the same ones always; none of clouds.
    pub fn depth(&mut self, at_ns: i64, samples: Vec<f32>) {
        self.depth.add(at_ns, samples);
        self.images = match self.joints.still_since(at_ns) {
            Some(_) => self.images.saturating_add(1),
            None => 0,
        };
    }

    /// How many images there are since the joints are known to be still.
    pub fn images(&self) -> u32 {
        self.images
    }

    /// How still the arm is at a time that is not before what was told last.
    pub fn at(&self, at_ns: i64) -> Stillness {
        let Some(still_since) = self.joints.still_since(at_ns) else {
            return match self.joints.is_told(at_ns) {
                true => Stillness::Moving,
                false => Stillness::Unknown,
            };
        };
        let held_ns = at_ns.saturating_sub(still_since);
        let seen_still = self.depth.is_still() || held_ns >= PATIENCE_NS;
        match held_ns >= HOLD_NS && self.depth.is_told(at_ns) && seen_still {
            true => Stillness::AtRest(still_since),
            false => Stillness::Moving,
        }
    }
}

#[cfg(test)]
mod tests;
