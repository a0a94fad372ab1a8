//! The frames of a recording, as they came.

use super::detector::Rate;
use super::known::Known;
use super::report::ViewReport;
use super::watch::Monitor;
use crate::evenly::evenly;
use crate::observations::Observations;
use crate::record::{Groups, RecordError, RecordOptions, SingleFrames, group_frames};
use eyebolt_recording::FrameSource;
use eyebolt_robot::Arm;

/// What to watch.
#[derive(Clone, Copy)]
pub struct Watched<'a> {
    /// Where the frames come from.
    pub source: &'a dyn FrameSource,
    /// The arm in them.
    pub arm: &'a Arm,
    /// What was made of the source, by `options`.
    pub observations: &'a Observations,
    /// What was read of it.
    pub options: &'a RecordOptions,
    /// How many frames of each rest are looked at.
    pub per_rest: usize,
}

/// Hands the report on each frame that is looked at to `each`, in order of time; says whether there is an alarm.
///
/// # Errors
///
/// A frame that cannot be read, unless it is one of those that may be left out; joints of another robot; what `each`
/// says.
pub fn watch<E: From<RecordError>>(
    watched: &Watched<'_>,
    known: Known,
    rate: &Rate,
    mut each: impl FnMut(ViewReport) -> Result<(), E>,
) -> Result<bool, E> {
    let mut monitor = Monitor::new(watched.arm, watched.observations, known, rate);
    look(watched, &mut monitor, &mut each)?;
    Ok(monitor.alarms())
}

/// As [`watch`], by a `monitor` of the same arm and observations that may have seen other sources before.
///
/// # Errors
///
/// As of [`watch`].
pub fn look<E: From<RecordError>>(
    watched: &Watched<'_>,
    monitor: &mut Monitor<'_>,
    mut each: impl FnMut(ViewReport) -> Result<(), E>,
) -> Result<(), E> {
    let Watched { source, arm, observations, options, per_rest } = *watched;
    let frames = SingleFrames::new(source, observations, options);
    for rest in rests(source, arm)? {
        for index in evenly(&rest, per_rest) {
            let seen = match frames.read(index) {
                Err(RecordError::Recording(error)) if source.may_leave_out(&error) => continue,
                read => read?,
            };
            let name = source.frame_names().get(index).map_or("", String::as_str);
            let report = monitor.see(name, (&seen.depth, seen.mask.as_ref()), &seen.joints);
            let failed = |source| RecordError::Kinematics { frame: name.to_owned(), source };
            each(report.map_err(failed)?)?;
        }
    }
    Ok(())
}

/// Frames one after the other with the arm in one place, in order of time.
fn rests(source: &dyn FrameSource, arm: &Arm) -> Result<Vec<Vec<usize>>, RecordError> {
    let Groups { groups, .. } = group_frames(source, arm, |_, _| ())?;
    let numbered = groups.iter().enumerate();
    let mut frames: Vec<(usize, usize)> =
        numbered.flat_map(|(group, found)| found.frames.iter().map(move |f| (*f, group))).collect();
    frames.sort_unstable();
    let mut rests: Vec<(usize, Vec<usize>)> = Vec::new();
    for (frame, group) in frames {
        match rests.last_mut() {
            Some((last, frames)) if *last == group => frames.push(frame),
            _ => rests.push((group, vec![frame])),
        }
    }
    Ok(rests.into_iter().map(|(_, frames)| frames).collect())
}
