//! Labels as networks number them.

use crate::segment::{ARM, BACKGROUND, END_EFFECTOR, UNKNOWN};
use eyebolt_registration::Label;

/// The class of a pixel with that label.
pub(crate) fn class_of(label: Label) -> u8 {
    match label {
        Label::EndEffector => END_EFFECTOR,
        Label::Arm => ARM,
        Label::Background => BACKGROUND,
        Label::Ignore => UNKNOWN,
    }
}
