//! `eyebolt calibrate --marker`.

use crate::ending::Ending;
use crate::inputs::marker;
use crate::names;
use crate::output::{self, Destination, STDOUT};
use crate::progress::Bar;
use anyhow::{Result, bail};
use eyebolt::answer::Size;
use eyebolt::marker_answer::{Answered, MarkerAnswer, MarkerFrame, Markerless};
use eyebolt::markers::{
    EyeInHand, EyeToHand, MarkerCalibration, MarkerFailure, MarkerRequest, calibrate, follow,
    observe,
};
use eyebolt::pipeline::{Failure, Request};
use eyebolt::progress::Step;
use eyebolt::record::RecordError;
use eyebolt_markers::Target;
use eyebolt_recording::counted;
use std::fmt::Write;
use std::path::Path;

const MARKERS: &str = "Markers";

/// How a marker is asked for.
#[derive(Debug, Default, clap::Args)]
pub struct MarkerArguments {
    /// Calibrate by a marker in the colour pictures, then by the arm's own shape from there on. One of
    /// aruco:DICTIONARY:SIZE_M[:ID] (aruco:4x4_50:0.05), apriltag:FAMILY:SIZE_M[:ID] (apriltag:36h11:0.08),
    /// grid:DICTIONARY:COLUMNSxROWS:SIZE_M:GAP_M[:FIRST_ID] or
    /// charuco:DICTIONARY:COLUMNSxROWS:SQUARE_M:MARKER_M[:FIRST_ID]; sizes are sides of black squares
    #[arg(long, help_heading = MARKERS, value_name = "MARKER", value_parser = marker, conflicts_with_all = ["save_overlay", "report", "viewer_mcap", "model"])]
    pub(super) marker: Option<Target>,
    /// The camera is on the hand and the marker stands still; otherwise the marker is on the hand
    #[arg(long, help_heading = MARKERS, requires = "marker")]
    eye_in_hand: bool,
    /// Leave the arm's own shape out of it
    #[arg(long, help_heading = MARKERS, requires = "marker")]
    marker_only: bool,
}

/// Calibrates what `request` asks for, of the recording at `path`, by the marker `target`.
pub(super) fn run(
    arguments: &MarkerArguments,
    target: &Target,
    request: &Request<'_>,
    path: &Path,
    destination: &Destination,
    bar: &Bar,
) -> Result<Ending> {
    let marker = MarkerRequest {
        source: request.source,
        arm: request.arm,
        target: target.clone(),
        limits: request.limits,
        most_configurations: request.options.most_configurations,
    };
    let answer = if arguments.eye_in_hand {
        answered::<EyeInHand>(&marker, path, bar)?.0
    } else {
        let (mut answer, calibration) = answered::<EyeToHand>(&marker, path, bar)?;
        if !arguments.marker_only {
            answer.markerless = markerless(request, &calibration, bar)?;
        }
        answer
    };
    Step::Report.begin(bar)?;
    bar.finish();
    let trusted = answer.reasons.is_empty();
    let written = destination.write(trusted, answer.to_json().as_bytes())?;
    let text = summary(&answer, &written);
    // Standard output has the calibration, if that was asked for.
    if written == Path::new(STDOUT) {
        output::complain(&text)
    } else {
        output::say(&text)
    }
    Ok(if trusted { Ending::Done } else { Ending::Refused })
}

fn answered<A: Answered>(
    request: &MarkerRequest<'_>,
    recording: &Path,
    bar: &Bar,
) -> Result<(MarkerAnswer, MarkerCalibration<A>)> {
    Step::Record.begin(bar)?;
    let observations = observe(request, bar).map_err(|error| named(error, recording))?;
    Step::Calibrate.begin(bar)?;
    let calibration = calibrate::<A>(&observations, &request.limits);
    Ok((MarkerAnswer::new(request, &observations, &calibration), calibration))
}

/// The error, with the recording where it names no file.
fn named(error: MarkerFailure, recording: &Path) -> anyhow::Error {
    match error {
        MarkerFailure::Record(RecordError::Recording(_)) | MarkerFailure::Cancelled(_) => {
            error.into()
        }
        _ => anyhow::Error::new(error).context(recording.display().to_string()),
    }
}

/// What the arm's own shape says, if depth was recorded and the marker told a pose to begin with.
fn markerless(
    request: &Request<'_>,
    calibration: &MarkerCalibration<EyeToHand>,
    bar: &Bar,
) -> Result<Option<Markerless>> {
    let Some(pose) = &calibration.camera_from_root else { return Ok(None) };
    match follow(request, pose, bar) {
        Ok(outcome) => Ok(Some(Markerless::new(&outcome, calibration))),
        Err(error @ Failure::Cancelled(_)) => bail!(error),
        // What cannot be told without the marker must not cost the marker's answer.
        Err(error) => Ok(Some(Markerless::failed(names::in_flags(&error.to_string())))),
    }
}

/// The result for a person to read.
fn summary(answer: &MarkerAnswer, path: &Path) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = verdict(&mut text, answer);
    let _ = evidence(&mut text, answer);
    for frames in answer.configurations.chunk_by(|a, b| a.configuration == b.configuration) {
        let Some(first) = frames.first() else { continue };
        let _ = writeln!(text, "  {}", frame_line(first, frames.len()));
    }
    for (reason, count) in &answer.frames_left_out {
        let frames = counted(*count, "frame");
        let _ = writeln!(text, "  {frames} left out: {}", reason.replace('_', " "));
    }
    if answer.spare_configurations > 0 {
        let more = counted(answer.spare_configurations, "more configuration");
        let _ = writeln!(text, "  {more} not needed (--max-configurations)");
    }
    if let Some(other) = &answer.markerless {
        let _ = without_marker(&mut text, other);
    }
    let _ = match path == Path::new(STDOUT) {
        true => write!(text, "\nwritten to standard output"),
        false => write!(text, "\nwritten to {}", path.display()),
    };
    text
}

fn verdict(text: &mut String, answer: &MarkerAnswer) -> std::fmt::Result {
    let trusted = answer.reasons.is_empty();
    let used = answer.configurations.iter().filter(|frame| frame.used).count();
    let verdict = output::emphasised(&answer.verdict.to_uppercase(), trusted);
    let frames = counted(answer.configurations.len(), "frame");
    writeln!(text, "{verdict} by {} ({used} of {frames} used)", answer.marker.target)?;
    for reason in &answer.reasons {
        writeln!(text, "  - {}", names::in_flags(reason))?;
    }
    let (pose, place) = match &answer.end_effector_from_camera {
        Some(pose) => (Some(pose), &answer.frames.end_effector),
        None => (answer.base_from_camera.as_ref(), &answer.frames.base),
    };
    if let Some(pose) = pose.filter(|_| trusted) {
        let camera = answer.frames.camera.as_deref().unwrap_or("depth optical frame");
        let ([x, y, z], [qx, qy, qz, qw]) = (pose.translation_m, pose.rotation_xyzw);
        writeln!(text, "\nthe camera ({camera}) in {place}:")?;
        writeln!(text, "  translation_m  {x:>9.5} {y:>9.5} {z:>9.5}")?;
        writeln!(text, "  rotation_xyzw  {qx:>9.6} {qy:>9.6} {qz:>9.6} {qw:>9.6}")?;
    }
    Ok(())
}

fn size_line(text: &mut String, name: &str, size: Option<Size>) -> std::fmt::Result {
    let Some(size) = size else { return Ok(()) };
    let Size { translation_mm, rotation_deg } = size;
    writeln!(text, "  {name:<28} {translation_mm:>6.1} mm {rotation_deg:>6.2} degrees")
}

fn evidence(text: &mut String, answer: &MarkerAnswer) -> std::fmt::Result {
    size_line(text, "expected error, workspace", answer.expected_error)?;
    if let Some(mm) = answer.camera_position_error_mm {
        writeln!(text, "  {:<28} {mm:>6.1} mm", "the camera's own position")?;
    }
    size_line(text, "worst when one is left out", answer.leave_one_out.as_ref().map(|l| l.worst))?;
    for (name, solver) in &answer.marker.solvers {
        size_line(text, &format!("{name}, unrefined"), solver.from_refined)?;
    }
    if let (Some(percent), Some(px)) = (answer.marker.size_error_percent, answer.marker.sigma_px) {
        writeln!(text, "  the marker is {percent:+.2} % larger than said, seen to {px:.2} px")?;
    }
    Ok(())
}

fn frame_line(frame: &MarkerFrame, count: usize) -> String {
    let residual = frame.residual_px.map(|px| format!("residual {px:.2} px"));
    let parts: Vec<String> = residual.into_iter().chain(frame.reason.clone()).collect();
    let more = if count > 1 { format!(" (+{})", count - 1) } else { String::new() };
    format!("frame {:<12} {}", format!("{}{more}", frame.name), parts.join(", "))
}

fn without_marker(text: &mut String, other: &Markerless) -> std::fmt::Result {
    writeln!(text, "\nby the arm's own shape from there on: {}", other.verdict)?;
    for reason in &other.reasons {
        writeln!(text, "  - {}", names::in_flags(reason))?;
    }
    size_line(text, "expected error, workspace", other.expected_error)?;
    size_line(text, "from the marker's answer", other.difference)
}
