//! A folder of files with a `recording.toml`.

mod description;
mod left_out;
mod names;
mod output;

use super::error::WriteError;
use super::png;
use super::robot::WriteRobot;
use crate::error::RecordingError;
use crate::folder::MANIFEST;
use crate::progress::Progress;
use crate::recording::Recording;
use crate::tf_file;
use crate::truth;
use description::{Found, camera_info, manifest};
use left_out::LeftOut;
use names::{CAMERA_INFO, TF_STATIC, URDF};
use output::Output;
use std::collections::BTreeMap;
use std::path::Path;

/// Writes the frames of `recording` that take part to the folder `folder`, which must exist:
/// depth as PNG (whole millimetres) or NPY, clouds as NPY, the positions of the joints as one CSV,
/// the backgrounds, the static transforms, and the truth of a simulated recording as it is.
///
/// # Errors
///
/// What cannot be read, no frame that can be (nothing is written then), or a file that cannot be
/// written.
pub fn write_folder(
    recording: &Recording,
    robot: &WriteRobot,
    folder: &Path,
    progress: &dyn Progress,
) -> Result<(), WriteError> {
    let mut output = Output::new(folder, recording.in_millimetres());
    let mut found = frames(recording, &mut output, progress)?;
    backgrounds(recording, &output, &mut found, progress)?;
    output.finish_joints()?;
    if let Some(camera) = recording.camera() {
        let text = camera_info(camera, recording.camera_frame_id());
        output.file(CAMERA_INFO, text.as_bytes())?;
    }
    if !recording.static_transforms().is_empty() {
        let text = tf_file::text(recording.static_transforms());
        output.file(TF_STATIC, text.as_bytes())?;
    }
    if let Some(urdf) = &robot.urdf {
        output.file(URDF, urdf.as_bytes())?;
    }
    if let Some(json) = truth::text_of(recording)? {
        output.file(truth::FILE, json.as_bytes())?;
    }
    // Last: a folder without it is no recording.
    output.file(MANIFEST, manifest(recording, robot, found).as_bytes())?;
    let total = total(recording);
    progress.advance(total, total)?;
    Ok(())
}

fn total(recording: &Recording) -> usize {
    recording.frame_names().len() + recording.background_count()
}

fn frames(
    recording: &Recording,
    output: &mut Output<'_>,
    progress: &dyn Progress,
) -> Result<Found, WriteError> {
    let (mut found, mut left_out) = (Found::default(), LeftOut::default());
    let told = told_joints(recording)?;
    for (index, name) in recording.frame_names().iter().enumerate() {
        progress.advance(index, total(recording))?;
        let frame = match recording.read_frame(index) {
            Err(error) if recording.may_leave_out(&error) => {
                left_out.add(&error);
                continue;
            }
            read => read?,
        };
        if let Some(untold) = told.iter().find(|name| frame.joints.get(name).is_none()) {
            let problem = format!("the position of {untold} is not told");
            left_out.add(&RecordingError::invalid(
                recording_path(recording),
                "joints",
                problem,
                "",
            ));
            continue;
        }
        output.range(&frame)?;
        output.joint_row(&frame, &told)?;
        if let Some(mask) = &frame.mask {
            let png = png::mask(mask.width(), mask.height(), mask.as_slice());
            output.picture(&format!("mask_{name}.png"), png)?;
        }
        // Colour is for people only, who do without some pictures.
        let color = match recording.read_color(index) {
            Err(error) if recording.may_leave_out(&error) => None,
            read => read?,
        };
        if let Some(color) = &color {
            let png = png::rgb(color.width, color.height, &color.rgb);
            output.picture(&format!("color_{name}.png"), png)?;
        }
        found.add(&frame, color.is_some());
    }
    // A description of no frame would name files that are not there.
    if found.frames == 0 { Err(left_out.none_left()) } else { Ok(found) }
}

fn recording_path<'r>(recording: &'r Recording<'_>) -> &'r Path {
    Path::new(&recording.provenance().name)
}

/// Joints that most frames tell, sorted: a table has a position for each in every row. What is told
/// seldom is of no arm.
fn told_joints(recording: &Recording) -> Result<Vec<String>, WriteError> {
    let count = recording.frame_names().len();
    let mut told: BTreeMap<String, usize> = BTreeMap::new();
    for index in 0..count {
        for (name, _) in recording.read_joints(index)?.iter() {
            *told.entry(name.to_owned()).or_default() += 1;
        }
    }
    Ok(told.into_iter().filter(|(_, frames)| 2 * frames > count).map(|(name, _)| name).collect())
}

fn backgrounds(
    recording: &Recording,
    output: &Output<'_>,
    found: &mut Found,
    progress: &dyn Progress,
) -> Result<(), WriteError> {
    for index in 0..recording.background_count() {
        progress.advance(recording.frame_names().len() + index, total(recording))?;
        let background = match recording.read_background(index) {
            Err(error) if recording.may_leave_out(&error) => continue,
            read => read?,
        };
        let name = format!("background_{index}");
        output.depth(&name, &background, recording.backgrounds_in_millimetres())?;
        found.backgrounds += 1;
    }
    Ok(())
}
