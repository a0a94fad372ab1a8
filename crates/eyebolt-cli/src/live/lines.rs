//! What a person reads while a session goes on.

use super::domain::DomainArguments;
use crate::names;
use crate::output::emphasised;
use eyebolt_live::{Assessment, Event, Goal};
use std::fmt::Write;
use std::path::Path;

/// When all is there.
pub const READY: &str = "all is there: let the arm rest in one place after the other, and wait in each until it is taken";

/// The first lines.
pub fn beginning(domain: &DomainArguments, session: &Path, goal: &Goal) -> String {
    let id = domain.domain().unwrap_or_default();
    let local = if domain.is_local() { " on this machine" } else { "" };
    format!(
        "listening to domain {id}{local}; what comes in is recorded in {}\n\
         Enter takes a configuration now, q ends, and so does an expected error of {goal}",
        session.display()
    )
}

/// What is still missing.
pub fn waiting(missing: &[&str]) -> String {
    format!("waiting for {}", missing.join(", "))
}

/// That messages of a topic got lost.
pub fn lost(topic: &str, count: u64, total: u64) -> String {
    format!("LOST {count} of {topic} ({total} by now)")
}

/// What there is to say of an event, if anything is.
pub fn event(event: &Event) -> Option<String> {
    Some(match event {
        Event::Heard { topic, message_type } => format!("heard {topic} ({message_type})"),
        Event::NoDepth { topic } => format!("{topic} has no depth: not listened to"),
        Event::Unreadable { topic, problem } => format!("{topic} cannot be read: {problem}"),
        Event::Taken { configuration } => {
            format!("configuration {} taken: go on", configuration + 1)
        }
        Event::Known { configuration } => {
            format!(
                "the arm was here before (configuration {}): move it elsewhere",
                configuration + 1
            )
        }
        Event::NotPlaced { problem } => format!("cannot take it: {}", names::in_flags(problem)),
        Event::Silent => "no joint states any more".to_owned(),
        // Summed up once a second.
        Event::Lost { .. }
        | Event::Description(_)
        | Event::AtRest
        | Event::Moves
        | Event::Calibrate
        | Event::GoalMet => return None,
    })
}

/// What is known by now.
pub fn assessment(assessment: &Assessment, goal: &Goal, base: Option<&str>) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write(&mut text, assessment, goal, base.unwrap_or("the base"));
    text
}

fn write(text: &mut String, of: &Assessment, goal: &Goal, base: &str) -> std::fmt::Result {
    let verdict = emphasised(if of.trusted { "trusted" } else { "not trusted yet" }, of.trusted);
    write!(text, "  {} of {} configurations: {verdict}", of.used, of.configurations)?;
    if let Some([mm, deg]) = of.expected_mm_deg {
        write!(text, ", {mm:.1} mm and {deg:.2} deg expected (goal {goal})")?;
    }
    if let Some([mm, deg]) = of.with_another_mm_deg {
        write!(text, "; with another one about {mm:.1} mm, {deg:.2} deg")?;
    }
    if let Some(([x, y, z], [qx, qy, qz, qw])) = of.base_from_camera {
        write!(
            text,
            "\n  camera in {base}: {x:.4} {y:.4} {z:.4} m, {qx:.4} {qy:.4} {qz:.4} {qw:.4} xyzw"
        )?;
    }
    if let (Some((along, mm)), Some((about, deg))) = (of.weakest_direction, of.weakest_axis) {
        write!(
            text,
            "\n  known worst along {} ({mm:.1} mm) and about {} ({deg:.2} deg)",
            direction(along),
            direction(about)
        )?;
    }
    for idle in of.idle_joints.iter().take(3) {
        let (joint, link, deg) = (&idle.joint, &idle.link, idle.range_deg);
        write!(
            text,
            "\n  {joint} turned by {deg:.0} deg only: turn it farther, to see {link} from other sides"
        )?;
    }
    for reason in &of.reasons {
        write!(text, "\n  - {}", names::in_flags(reason))?;
    }
    Ok(())
}

/// An axis where one is near enough, else the numbers.
fn direction(axis: [f64; 3]) -> String {
    let near = axis.iter().zip(["x", "y", "z"]).find(|(part, _)| part.abs() > 0.94);
    match (near, axis) {
        (Some((_, name)), _) => name.to_owned(),
        (None, [x, y, z]) => format!("({x:.1} {y:.1} {z:.1})"),
    }
}
