//! The result for a person to read.

use crate::names;
use crate::output::{self, STDOUT};
use eyebolt::answer::{Answer, FrameOutcome, Pose, Size};
use eyebolt::calibrate::Verdict;
use eyebolt::report::remedies;
use eyebolt_recording::counted;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The summary of `answer`, written to `path`, of which `pictures` and a `report` were made.
pub fn text(
    answer: &Answer,
    reasons: &Verdict,
    path: &Path,
    pictures: &[PathBuf],
    report: Option<&Path>,
) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = verdict(&mut text, answer, reasons);
    let _ = evidence(&mut text, answer);
    for line in answer.configurations.chunk_by(|a, b| a.configuration == b.configuration) {
        let _ = line
            .first()
            .and_then(|first| frame_line(first, line.len()))
            .map_or(Ok(()), |line| writeln!(text, "  {line}"));
    }
    for (reason, count) in &answer.frames_left_out {
        let frames = counted(*count, "frame");
        let _ = writeln!(text, "  {frames} left out: {}", reason.replace('_', " "));
    }
    if answer.spare_configurations > 0 {
        let more = counted(answer.spare_configurations, "more configuration");
        let _ = writeln!(text, "  {more} not needed (--max-configurations)");
    }
    if answer.background == Some("of_another_scene") {
        let _ = writeln!(text, "  frames without the arm show another scene: not used");
    }
    if let Some(seconds) = answer.clock_offset_s {
        let _ =
            writeln!(text, "  stamps of depth and joints are {seconds:.3} s apart: made up for");
    }
    if !answer.unplaced_joints.is_empty() {
        let joints = answer.unplaced_joints.join(", ");
        let _ = writeln!(text, "  not recorded, so that their links took no part: {joints}");
    }
    for (joint, position) in &answer.stated_joints {
        let _ = writeln!(text, "  {joint} stands at {position}, as --joint says");
    }
    for part in &answer.left_out {
        let _ = writeln!(text, "  {}", part);
    }
    for finding in answer.findings() {
        let _ = writeln!(text, "  {finding}");
    }
    for joint in answer.notable_joint_offsets() {
        let _ = writeln!(
            text,
            "  {} seems to stand {:+.2} ± {:.2} degrees from where it says: allowed for",
            joint.joint, joint.offset_deg, joint.sigma_deg
        );
    }
    let any_notable = answer.notable_joint_offsets().next().is_some();
    if let Some(mm) = answer.end_effector_off_by_joints_mm.filter(|_| any_notable) {
        let _ = writeln!(
            text,
            "  unless the joints' zeros are corrected, the end-effector is up to {mm:.1} mm from \
             where they put it"
        );
    }
    if let Some(guessed) = guessed(answer) {
        let _ = writeln!(text, "  {guessed}");
    }
    let _ = match path == Path::new(STDOUT) {
        true => write!(text, "\nwritten to standard output"),
        false => write!(text, "\nwritten to {}", path.display()),
    };
    if let (Some(first), Some(folder)) =
        (pictures.first(), pictures.first().and_then(|p| p.parent()))
    {
        let _ = match pictures.len() {
            1 => write!(text, "\npicture in {}", first.display()),
            count => write!(text, "\n{count} pictures in {}", folder.display()),
        };
    }
    if let Some(report) = report {
        let _ = write!(text, "\nreport in {}", report.display());
    }
    text
}

/// Which links were guessed, and how to name others.
fn guessed(answer: &Answer) -> Option<String> {
    let frames = &answer.frames;
    let link = |name: &&str| match *name {
        "base" => format!("base {} (--base)", frames.base),
        _ => format!("end-effector {} (--end-effector)", frames.end_effector),
    };
    let links: Vec<String> = frames.guessed.iter().map(link).collect();
    (!links.is_empty()).then(|| format!("guessed, since nobody named them: {}", links.join(", ")))
}

fn verdict(text: &mut String, answer: &Answer, reasons: &Verdict) -> std::fmt::Result {
    let frames = &answer.configurations;
    let verdict = output::emphasised(&answer.verdict.to_uppercase(), answer.reasons.is_empty());
    let used = frames.iter().filter(|frame| frame.used).count();
    match frames.len() {
        0 => writeln!(text, "{verdict}")?,
        count => writeln!(text, "{verdict} ({used} of {} used)", counted(count, "frame"))?,
    }
    if let Verdict::Refused(reasons) = reasons {
        for reason in reasons {
            writeln!(text, "  - {}", names::in_flags(&reason.to_string()))?;
            for remedy in remedies(reason) {
                // What a report shows below, a terminal does not.
                writeln!(text, "      {}", names::in_flags(remedy).replace(" below", ""))?;
            }
        }
    }
    let trusted = answer.reasons.is_empty();
    let camera = answer.frames.camera.as_deref().unwrap_or("depth optical frame");
    if let Some(pose) = answer.base_from_camera.as_ref().filter(|_| trusted) {
        writeln!(text, "\nthe camera ({camera}) in {}:", answer.frames.base)?;
        write_pose(text, pose)?;
    }
    Ok(())
}

fn write_pose(text: &mut String, pose: &Pose) -> std::fmt::Result {
    let [x, y, z] = pose.translation_m;
    let [qx, qy, qz, qw] = pose.rotation_xyzw;
    writeln!(text, "  translation_m  {x:>9.5} {y:>9.5} {z:>9.5}")?;
    writeln!(text, "  rotation_xyzw  {qx:>9.6} {qy:>9.6} {qz:>9.6} {qw:>9.6}")
}

fn evidence(text: &mut String, answer: &Answer) -> std::fmt::Result {
    let line = |text: &mut String, name: &str, size: Option<Size>| match size {
        Some(size) => writeln!(
            text,
            "  {name:<28} {:>6.1} mm {:>6.2} degrees",
            size.translation_mm, size.rotation_deg
        ),
        None => Ok(()),
    };
    line(text, "expected error, workspace", answer.expected_error)?;
    if let Some(mm) = answer.camera_position_error_mm {
        writeln!(text, "  {:<28} {mm:>6.1} mm", "the camera's own position")?;
    }
    line(text, "worst when one is left out", answer.leave_one_out.as_ref().map(|l| l.worst))?;
    line(text, "surfaces against outlines", answer.disagreement)?;
    if let Some(iou) = answer.silhouette_iou {
        writeln!(text, "  {:<28} {iou:>6.3}", "silhouette overlap (IoU)")?;
    }
    Ok(())
}

/// What became of a configuration of `count` frames, of which `frame` is the first.
fn frame_line(frame: &FrameOutcome, count: usize) -> Option<String> {
    let residual = frame.residual_mm.map(|mm| format!("residual {mm:.1} mm"));
    let parts: Vec<String> = residual.into_iter().chain(frame.reason.clone()).collect();
    let more = if count > 1 { format!(" (+{})", count - 1) } else { String::new() };
    let name = format!("{}{more}", frame.name);
    (!parts.is_empty()).then(|| format!("frame {name:<12} {}", parts.join(", ")))
}
