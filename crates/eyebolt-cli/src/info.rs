//! `eyebolt info`.

use crate::ending::{Ending, causes};
use crate::inputs::{RecordingArguments, RobotArguments};
use crate::names;
use crate::output;
use crate::progress::Waiting;
use anyhow::Result;
use eyebolt::info::{Info, NO_ROBOT};
use eyebolt_recording::{TopicSummary, list_topics};
use eyebolt_robot::{ResolveError, RobotError};
use std::fmt::{self, Write};

/// Options of `eyebolt info`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    recording: RecordingArguments,
    #[command(flatten)]
    robot: RobotArguments,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Ending> {
    let waiting = Waiting::new("reading the recording");
    let recording = match arguments.recording.open_any_depth(&arguments.robot) {
        Ok(recording) => recording,
        Err(error) => {
            // Which topics there are is what one wants to know now.
            let path = &arguments.recording.recording;
            if let Ok(topics) = list_topics(path, &arguments.recording.bag.options())
                && !arguments.json
                && !topics.is_empty()
            {
                drop(waiting);
                output::say(&names::in_flags(&table(&topics)));
            }
            return Err(error);
        }
    };
    // A recording without a robot can be looked at all the same.
    let (arm, problem) = match arguments.robot.arm_if_known(&recording) {
        Ok(arm) => (arm, None),
        // Shapes are of no use here, and often elsewhere.
        Err(error) if lacks_mesh(&error) => {
            (None, Some(format!("the robot description cannot be used: {}", causes(&error))))
        }
        Err(error) => return Err(error),
    };
    let recording = match &arm {
        Some(arm) => arguments.robot.noted(recording, arm)?,
        None => recording,
    };
    let mut info = Info::new(recording.source(), arm.as_ref())?;
    if let Some(problem) = problem {
        // Instead of the advice to give one.
        info.advice.retain(|line| !line.starts_with(NO_ROBOT));
        info.advice.insert(0, problem);
        info.ready = false;
    }
    // What is damaged and what to do is said in the libraries' words.
    let left_out = info.robot.iter_mut().flat_map(|robot| &mut robot.left_out);
    for line in info.advice.iter_mut().chain(&mut info.damage).chain(left_out) {
        *line = names::in_flags(line);
    }
    drop(waiting);
    let text = if arguments.json { info.to_json() } else { text(&info) };
    output::say(text.trim_end());
    Ok(if info.ready { Ending::Done } else { Ending::Refused })
}

fn lacks_mesh(error: &anyhow::Error) -> bool {
    let mesh = error.downcast_ref::<RobotError>();
    matches!(
        mesh,
        Some(RobotError::Mesh {
            source: ResolveError::NotFound { .. } | ResolveError::Outside { .. },
            ..
        })
    )
}

fn text(info: &Info) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = overview(&mut text, info);
    let _ = robot(&mut text, info);
    if !info.topics.is_empty() {
        let _ = writeln!(text, "\n{}", table(&info.topics).trim_end());
    }
    for damage in info.damage.iter().take(5) {
        let _ = writeln!(text, "\ndamaged: {damage}");
    }
    let _ = info.advice.iter().try_for_each(|line| write!(text, "\n- {line}"));
    let _ = match (info.ready, info.advice.is_empty()) {
        (true, true) => writeln!(text, "\nready to calibrate"),
        (true, false) => writeln!(text, "\n\nready to calibrate all the same"),
        (false, _) => writeln!(text, "\n\nnot ready to calibrate"),
    };
    text
}

fn overview(text: &mut String, info: &Info) -> fmt::Result {
    let depth = &info.depth;
    let mut line = |name: &str, value: String| writeln!(text, "{name:<15} {value}");
    line("recording", info.kind.to_owned())?;
    let size = depth.size.map_or("points without order".to_owned(), |(w, h)| format!("{w} x {h}"));
    let frame = depth.frame_id.as_deref().unwrap_or("a frame without a name");
    line("depth", format!("{size}, in {frame}"))?;
    if let Some([fx, fy, cx, cy]) = depth.intrinsics_px {
        line("camera", format!("fx {fx:.2}, fy {fy:.2}, cx {cx:.2}, cy {cy:.2} px"))?;
    }
    let valid = format!("{:.0} % of the pixels have depth", 100.0 * depth.share_valid);
    let range = depth.range_m.map(|[near, middle, far]| {
        format!(", {near:.2} to {far:.2} m, half of them within {middle:.2} m")
    });
    line("", valid + &range.unwrap_or_default())?;
    let masks = if depth.masks { ", with masks" } else { "" };
    line("frames", format!("{} take part{masks}", info.frames.used))?;
    for (reason, count) in &info.frames.dropped {
        let first = info.frames.dropped_frames.iter().find(|frame| frame.kind == *reason);
        let why = first.map(|f| format!(" (frame {}: {})", f.frame, f.reason)).unwrap_or_default();
        line("", format!("{count} are left out: {}{why}", reason.replace('_', " ")))?;
    }
    let configurations = &info.configurations;
    let counts: Vec<_> = configurations.iter().take(30).map(|c| c.frames.to_string()).collect();
    let more = if configurations.len() > 30 { "..." } else { "" };
    let frames = if counts.is_empty() {
        String::new()
    } else {
        format!(" (frames: {}{more})", counts.join(" "))
    };
    line("configurations", format!("{}{frames}", configurations.len()))?;
    line("joints", info.joints.join(" "))?;
    if let Some(clock) = info.clock {
        let how = if clock.seen_in_motion { "motion in both" } else { "times of recording" };
        line(
            "clocks",
            match clock.applied {
                true => format!(
                    "stamps of depth shifted by {:+.3} s (to {:.3} s), by the {how}",
                    clock.offset_s, clock.uncertainty_s
                ),
                false => format!("one; depth arrives {:.3} s later than joints", clock.offset_s),
            },
        )?;
    }
    Ok(())
}

fn robot(text: &mut String, info: &Info) -> fmt::Result {
    let Some(robot) = &info.robot else { return Ok(()) };
    let guessed = |name: &str| match robot.guessed.contains(&name) {
        true => format!(" (guessed: --{})", name.replace('_', "-")),
        false => String::new(),
    };
    let (base, hand) = (guessed("base"), guessed("end_effector"));
    let (from, to) = (&robot.base, &robot.end_effector);
    writeln!(text, "{:<15} {}: {from}{base} to {to}{hand}", "robot", robot.name)?;
    for part in &robot.left_out {
        writeln!(text, "{:<15} {part}", "")?;
    }
    if !robot.unknown_joints.is_empty() {
        writeln!(text, "{:<15} not of this robot: {}", "", robot.unknown_joints.join(" "))?;
    }
    Ok(())
}

fn table(topics: &[TopicSummary]) -> String {
    let mut text = String::new();
    let width = topics.iter().map(|topic| topic.name.len()).max().unwrap_or(0);
    for topic in topics {
        let role = topic.role.unwrap_or("");
        let rate = topic.rate_hz.map(|rate| format!("{rate:.1} Hz")).unwrap_or_default();
        let _ = writeln!(
            text,
            "{role:<10} {:<width$}  {:>8} x  {:>10}  {}",
            topic.name, topic.count, rate, topic.message_type
        );
        for problem in &topic.problems {
            let _ = writeln!(text, "{:<10} {problem}", "");
        }
    }
    text
}
