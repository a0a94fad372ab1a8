//! Labels as numbers in files.

use eyebolt_registration::Label;

/// The number of a label: 0 background, 1 arm, 2 end-effector as in the paper, 255 ignore.
pub const fn code(label: Label) -> u8 {
    match label {
        Label::Background => 0,
        Label::Arm => 1,
        Label::EndEffector => 2,
        Label::Ignore => 255,
    }
}

/// The label of a number; `None` if it is the number of none.
pub fn label(code: u8) -> Option<Label> {
    [Label::Background, Label::Arm, Label::EndEffector, Label::Ignore]
        .into_iter()
        .find(|label| self::code(*label) == code)
}
