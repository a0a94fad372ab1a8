//! What to do about damage.

use eyebolt_robot::Input;

/// To do `what`, or else to read the bag as one that is damaged, which is good for `gain`.
pub(super) fn or_partial(what: &str, gain: &str) -> String {
    format!("{what}, or give {} {gain}", Input::PARTIAL)
}
