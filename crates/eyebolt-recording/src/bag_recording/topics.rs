//! The topics of a bag, for people, and what else a bag tells without being a recording.

use super::choose::Chosen;
use super::options::BagOptions;
use super::scan::{Scan, TopicScan};
use super::track::Track;
use crate::bag::Bag;
use crate::error::RecordingError;
use crate::message::StaticTransform;
use crate::provenance::TopicSummary;
use crate::words::counted;
use std::path::Path;

/// The topics of the bag at `path`, whether or not they make a recording.
///
/// # Errors
///
/// A file that cannot be read or is damaged (unless `partial` is asked for).
pub fn list_topics(path: &Path, options: &BagOptions) -> Result<Vec<TopicSummary>, RecordingError> {
    let bag = Bag::open(path, options.scratch())?;
    let scan = Scan::new(&bag, options.partial)?;
    Ok(summaries(&scan, None))
}

/// The transforms on `/tf_static` of the bag at `path`, the last for each child.
///
/// # Errors
///
/// A file that cannot be read or is damaged (unless `partial` is asked for).
pub fn static_transforms(
    path: &Path,
    options: &BagOptions,
) -> Result<Vec<StaticTransform>, RecordingError> {
    let bag = Bag::open(path, options.scratch())?;
    Ok(Scan::new(&bag, options.partial)?.static_transforms)
}

/// All topics of a scan, with what those that were `chosen` are to the recording.
pub(super) fn summaries(scan: &Scan, chosen: Option<&Chosen>) -> Vec<TopicSummary> {
    let role = |number| chosen.and_then(|chosen| chosen.role(number));
    let topics = scan.topics.iter().enumerate();
    topics.map(|(number, topic)| summary(topic, role(number))).collect()
}

fn summary(topic: &TopicScan, role: Option<&'static str>) -> TopicSummary {
    let span_s = topic.last_ns.saturating_sub(topic.first_ns) as f64 * 1e-9;
    let rate_hz = topic.count.saturating_sub(1) as f64 / span_s;
    TopicSummary {
        name: topic.name.clone(),
        message_type: topic.message_type.clone(),
        role,
        count: topic.count,
        bytes: topic.bytes,
        rate_hz: Some(rate_hz).filter(|rate| *rate > 0.0 && rate.is_finite()),
        frame_id: topic.frame_id.clone(),
        problems: problems(topic),
    }
}

fn problems(topic: &TopicScan) -> Vec<String> {
    let mut problems = Vec::new();
    if let Some((_, problem)) = &topic.first_problem {
        problems.push(format!(
            "{} cannot be read, the first because of {}: {}",
            counted(topic.unreadable, "message"),
            problem.field,
            problem.problem
        ));
    }
    if topic.stamps.unset > 0 {
        problems.push(format!(
            "{} {} no time stamp; the time of recording stands in",
            counted(topic.stamps.unset, "message"),
            if topic.stamps.unset == 1 { "has" } else { "have" }
        ));
    }
    let (backward, _) = topic.backward();
    if backward > 0 {
        let run = if backward == 1 { "runs" } else { "run" };
        problems.push(format!("{} {run} backward", counted(backward, "time stamp")));
    }
    let untold = topic.untold().into_iter().flat_map(|untold| untold.reasons(topic.count));
    problems.extend(untold.map(|(_, reason)| format!("{reason}: it counts as not told there")));
    let second: u64 = topic.tracks().iter().map(Track::second).sum();
    if second > 0 {
        problems.push(format!(
            "a second publisher tells the same joints and always the same positions: {} of it left \
             out. End it before you record (joint_state_publisher?)",
            counted(second, "message")
        ));
    }
    let coarsest = topic.tracks().iter().map(Track::tolerance).fold(0.0, f64::max);
    if coarsest > COARSE {
        problems.push(format!(
            "so many positions differ that they are kept to {:.1} mrad or mm only",
            1e3 * coarsest
        ));
    }
    let thinning = topic.tracks().iter().map(Track::thinning).max().unwrap_or(1);
    if thinning > 1 {
        problems.push(format!(
            "so many positions differ that one of {thinning} is kept, and others are unknown"
        ));
    }
    problems
}

/// A line through joint positions that is not nearer to them is worth a word, radians or metres.
const COARSE: f64 = 5e-4;
