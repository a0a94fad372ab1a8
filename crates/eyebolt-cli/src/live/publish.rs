//! The calibration on `/tf_static`.

use super::domain::now_ns;
use super::keyboard::{Key, Keyboard};
use crate::names;
use crate::output;
use crate::progress::Interrupt;
use anyhow::Result;
use eyebolt::export::{Placement, SavedCalibration, Wanted};
use eyebolt_live::{Bus, Outgoing};
use eyebolt_recording::{StaticTransform, static_transforms_message};
use std::path::Path;
use std::time::Duration;

/// How often it is looked whether somebody ended it.
const WAIT: Duration = Duration::from_millis(100);

/// Publishes the calibration at `path` until somebody ends it, unless the child has a parent already.
pub fn until_ended(
    bus: &Bus,
    path: &Path,
    keyboard: &Keyboard,
    interrupt: &Interrupt,
) -> Result<()> {
    let calibration = SavedCalibration::read(path)?;
    let placement = Placement::of_recording(&calibration, &Wanted::default())?;
    for note in &placement.notes {
        output::complain(&format!("note: {}", names::in_flags(&note.to_string())));
    }
    let (parent, child) = (&placement.parent, &placement.child);
    if let Some(other) = calibration.tree().parent(child) {
        output::complain(&format!(
            "not published: somebody publishes {child} below {other} on /tf_static, and a frame has one parent. End \
             that publisher (an earlier calibration?), then publish by eyebolt export --as ros2-launch"
        ));
        return Ok(());
    }
    let transform = StaticTransform {
        parent: parent.as_str().to_owned(),
        child: child.as_str().to_owned(),
        translation_m: placement.parent_from_child.translation_m().into(),
        rotation_xyzw: placement.parent_from_child.rotation_xyzw(),
    };
    bus.publish(Outgoing::StaticTransforms, static_transforms_message(&[transform], now_ns()));
    output::say(&format!(
        "{child} is published below {parent} on /tf_static until you end this (q or Ctrl-C)"
    ));
    while interrupt.check().is_ok() && keyboard.typed() != Some(Key::End) {
        // What still comes in is not needed.
        drop(bus.next(WAIT));
    }
    Ok(())
}
