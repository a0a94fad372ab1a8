//! What the sections of a page say.

mod drawings;

pub(super) use drawings::{pictures, plots};

use super::advice::remedies;
use super::spread::Spread;
use crate::answer::Answer;
use crate::calibrate::Verdict;
use crate::export::{Format, Note, Placement, SavedCalibration, Wanted};
use crate::pipeline::Outcome;
use crate::report::leftovers::Leftover;
use eyebolt_geometry::{CoordinateFrame, Transform};
use eyebolt_registration::OUTLINES;
use eyebolt_robot::Input;
use minijinja::{Value, context};

/// Each reason of a refusal with what to do about it, inputs called what `call` calls them.
pub(super) fn reasons(verdict: &Verdict, call: fn(Input) -> String) -> Vec<Value> {
    let Verdict::Refused(reasons) = verdict else { return Vec::new() };
    let told = reasons.iter();
    told.map(|reason| {
        let remedies = remedies(reason).iter().map(|remedy| Input::in_words(remedy, call));
        let text = Input::in_words(&reason.to_string(), call);
        context! { text => text, remedies => remedies.collect::<Vec<_>>() }
    })
    .collect()
}

/// Frames and configurations, and how many of them nothing spoke against.
pub(super) fn counts(answer: &Answer) -> Value {
    let frames = &answer.configurations;
    let configurations = || frames.chunk_by(|a, b| a.configuration == b.configuration);
    let used = |group: &&[_]| group.first().is_some_and(|f: &crate::answer::FrameOutcome| f.used);
    context! {
        frames => frames.len(),
        frames_used => frames.iter().filter(|frame| frame.used).count(),
        frames_left_out => answer.frames_left_out.values().sum::<usize>(),
        configurations => configurations().count(),
        configurations_used => configurations().filter(used).count(),
    }
}

/// `camera_from_base` and the way back, each with its angles; `None` without a pose.
pub(super) fn transforms(outcome: &Outcome) -> Option<Vec<Value>> {
    let pose = outcome.calibration.camera_from_base?;
    let inverse = pose.inverse();
    Some(vec![transform("base_from_camera", &inverse), transform("camera_from_base", &pose)])
}

fn transform<To: CoordinateFrame, From: CoordinateFrame>(
    name: &str,
    pose: &Transform<To, From>,
) -> Value {
    let matrix = pose.matrix();
    let row = |r: usize| [0, 1, 2, 3].map(|c| matrix[(r, c)]).to_vec();
    let (roll, pitch, yaw) = pose.rotation().euler_angles();
    context! {
        name => name,
        matrix => [0, 1, 2, 3].map(row).to_vec(),
        translation_m => Vec::from(<[f64; 3]>::from(pose.translation_m())),
        rotation_xyzw => pose.rotation_xyzw().to_vec(),
        rpy_rad => vec![roll, pitch, yaw],
        rpy_deg => [roll, pitch, yaw].map(f64::to_degrees).to_vec(),
    }
}

/// What the frame of the camera is called where the recording does not say.
const UNNAMED: &str = "camera_depth_optical_frame";

/// The command that publishes a trusted answer, without comments; `None` for a refused one, or
/// where tf could not carry the names.
pub(super) fn command(answer: &Answer) -> Option<Value> {
    let saved = SavedCalibration::parse("the answer", &answer.to_json()).ok()?;
    let optical = answer.frames.camera.as_deref().unwrap_or(UNNAMED);
    let wanted = Wanted { optical: Some(optical), ..Wanted::default() };
    let placement = Placement::of_recording(&saved, &wanted).ok()?;
    let text = String::from_utf8(Format::Tf2.write(&placement, "eyebolt")).ok()?;
    let mut lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('#')).collect();
    let known = !saved.tree().is_empty();
    if !known {
        // It goes where the command is copied to.
        lines
            .insert(0, "# Only if nothing else publishes a parent of the child frame (see below).");
    }
    let note = placement.notes.iter().find(|note| matches!(note, Note::Replaces { .. }));
    Some(context! {
        text => lines.join("\n"),
        unnamed => answer.frames.camera.is_none(),
        known => known,
        root => placement.child.as_str(),
        is_optical => placement.child_is_optical,
        note => note.map(ToString::to_string),
    })
}

/// What became of each configuration.
pub(super) fn configurations(answer: &Answer, leftovers: &[Leftover]) -> Vec<Value> {
    let groups = answer.configurations.chunk_by(|a, b| a.configuration == b.configuration);
    let rows = groups.filter_map(|group| {
        let first = group.first()?;
        let leftover = leftovers.get(first.configuration);
        let outline = leftover.and_then(|leftover| {
            Spread::new(leftover.shown[OUTLINES].iter().map(|(_, px)| px.abs())).quantile(0.5)
        });
        Some(context! {
            name => first.name,
            frames => group.len(),
            used => first.used,
            residual_mm => first.residual_mm,
            outline_px => outline,
            reason => first.reason,
        })
    });
    rows.collect()
}
