//! Frames of a folder, or of another source, as messages.

use super::error::WriteError;
use super::recording_writer::{Described, RecordingWriter};
use super::robot::WriteRobot;
use crate::frame::Range;
use crate::own_metadata::SCHEMA;
use crate::progress::Progress;
use crate::recording::{OPTICAL_FRAME, Recording, stamp_ns};
use std::collections::BTreeMap;
use std::io::{Seek, Write};

/// What eyebolt knows of a recording that no message says.
pub(super) fn metadata(recording: &Recording, robot: &WriteRobot) -> BTreeMap<String, String> {
    let mut values =
        recording.bag().map(|bag| bag.copy_source().metadata().clone()).unwrap_or_default();
    values.insert("schema".to_owned(), SCHEMA.to_owned());
    let known = recording.robot();
    let mut add = |key: &str, value: Option<&String>| {
        if let Some(value) = value {
            values.insert(key.to_owned(), value.clone());
        }
    };
    add("base", robot.base.as_ref().or(known.base.as_ref()));
    add("end_effector", robot.end_effector.as_ref().or(known.end_effector.as_ref()));
    if recording.bag().is_none() {
        let names = serde_json::to_string(recording.frame_names());
        add("frame_names", names.ok().as_ref());
    }
    values
}

/// Writes every background and every frame of `recording`, which is no bag, and its truth.
pub(super) fn write(
    recording: &Recording,
    robot: &WriteRobot,
    metadata: BTreeMap<String, String>,
    truth: Option<&str>,
    output: impl Write + Seek,
    progress: &dyn Progress,
) -> Result<(), WriteError> {
    let described = Described {
        camera: recording.camera(),
        camera_frame_id: recording.camera_frame_id().unwrap_or(OPTICAL_FRAME),
        in_millimetres: recording.in_millimetres(),
        static_transforms: recording.static_transforms(),
        urdf: robot.urdf.as_deref(),
        metadata,
    };
    let mut writer = RecordingWriter::described(output, described)?;
    if let Some(json) = truth {
        writer.truth_text(json)?;
    }
    let (backgrounds, frames) = (recording.background_count(), recording.frame_names().len());
    let total = backgrounds + frames;
    for index in 0..backgrounds {
        progress.advance(index, total)?;
        let background = match recording.read_background(index) {
            Err(error) if recording.may_leave_out(&error) => continue,
            read => read?,
        };
        writer.background_in(
            stamp_ns(index),
            &background,
            recording.backgrounds_in_millimetres(),
        )?;
    }
    for index in 0..frames {
        progress.advance(backgrounds + index, total)?;
        one(recording, index, recording.stamp_ns(index), &mut writer)?;
    }
    progress.advance(total, total)?;
    writer.finish()
}

fn one<W: Write + Seek>(
    recording: &Recording,
    index: usize,
    stamp_ns: i64,
    writer: &mut RecordingWriter<W>,
) -> Result<(), WriteError> {
    let frame = recording.read_frame(index)?;
    // Joints first: whoever plays the recording poses the arm before it sees it.
    writer.joints(stamp_ns, &frame.joints)?;
    match &frame.range {
        Range::Depth(depth) => writer.depth(stamp_ns, depth)?,
        Range::Cloud(cloud) => writer.cloud(stamp_ns, cloud)?,
    }
    if let Some(mask) = &frame.mask {
        writer.mask(stamp_ns, mask)?;
    }
    if let Some(color) = recording.read_color(index)? {
        writer.color(stamp_ns, &color)?;
    }
    Ok(())
}
