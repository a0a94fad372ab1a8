//! What is in honest laboratories, and neither in a description nor in a tidy room.

use serde_json::Value;

/// What is in honest laboratories, and neither in a description nor in a tidy room. The default is
/// nothing.
///
/// None of it spoils a recording: an arm can be found all the same.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lab {
    /// Share of the arm that glosses: there depth fails in patches, which lie elsewhere in each
    /// configuration. They are holes, or matches of something up to three decimetres behind.
    pub gloss: f64,
    /// Whether walls are 4 to 6 metres away instead of 2 to 3.
    pub far_room: bool,
    /// Standard deviation of depth at one metre, metres, which grows with the square of depth, is
    /// smooth over tens of pixels and another in each configuration. Stereo has 0.012 where it finds
    /// little to match: 0.3 m at 5 m.
    pub wander_m: f64,
    /// Length of a tool on the end-effector that the description lacks, metres; 0 for none.
    pub tool_m: f64,
    /// Whether a cable runs along the arm that the description lacks.
    pub cable: bool,
    /// Whether a link has a cover that the description lacks.
    pub cover: bool,
    /// People and boxes that are elsewhere in each configuration.
    pub passers_by: usize,
    /// Share of the configurations with another room behind them.
    pub other_rooms: f64,
    /// Another arm of the same kind beside.
    pub second_arm: SecondArm,
    /// How strong the camera's fixed pattern is: errors of depth in rings and in vertical bands, the
    /// same in every frame. 1 is a Kinect v1.
    pub fixed_pattern: f64,
}

/// Another arm of the same kind beside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SecondArm {
    /// There is none.
    #[default]
    None,
    /// It rests all the time.
    Still,
    /// It rests elsewhere in each configuration.
    Moving,
}

impl Lab {
    /// What is there, by name, with units in the names.
    pub(super) fn named(&self) -> Vec<(String, Value)> {
        let flag = |there: bool| f64::from(u8::from(there));
        let rows = [
            ("gloss", self.gloss),
            ("far_room", flag(self.far_room)),
            ("wander_mm", 1e3 * self.wander_m),
            ("tool_mm", 1e3 * self.tool_m),
            ("cable", flag(self.cable)),
            ("cover", flag(self.cover)),
            ("passers_by", self.passers_by as f64),
            ("other_rooms", self.other_rooms),
            ("second_arm_still", flag(self.second_arm == SecondArm::Still)),
            ("second_arm_moving", flag(self.second_arm == SecondArm::Moving)),
            ("fixed_pattern", self.fixed_pattern),
        ];
        let there = rows.into_iter().filter(|(_, value)| *value != 0.0);
        there.map(|(name, value)| (name.to_owned(), value.into())).collect()
    }
}
