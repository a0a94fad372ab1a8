//! What was wrong with configurations that were drawn.

use eyebolt_robot::Input;
use std::fmt;

/// Why configurations were not fit to be seen, of all that were drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rejected {
    pub(super) drawn: u64,
    pub(super) out_of_view: u64,
    pub(super) bumping: u64,
    pub(super) hidden: u64,
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let share = |count: u64| 100.0 * count as f64 / self.drawn.max(1) as f64;
        write!(
            f,
            "of {} that were drawn at random, the end-effector is out of the camera's view or range in \
             {:.1} %, the arm touches itself or the table that its base stands on in {:.1} %, and the \
             end-effector is hidden or turned away in {:.1} %. ",
            self.drawn,
            share(self.out_of_view),
            share(self.bumping),
            share(self.hidden)
        )?;
        if self.blames_arm() {
            let base = Input::BASE;
            return write!(f, "See to the limits of the joints in the URDF, and to its {base}");
        }
        let [preset, distance] = [Input::PRESET, Input::DISTANCE];
        let [azimuth, elevation] = [Input::AZIMUTH, Input::ELEVATION];
        write!(f, "Move the camera ({preset}, {distance}, {azimuth}, {elevation})")
    }
}

impl Rejected {
    /// The input that would help most.
    pub fn input(&self) -> Input {
        if self.blames_arm() { Input::BASE } else { Input::PRESET }
    }

    /// Whether the arm, rather than where the camera stands, leaves so few.
    fn blames_arm(&self) -> bool {
        self.bumping > self.hidden && self.bumping * 20 > self.drawn
    }
}
