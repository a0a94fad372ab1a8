//! The topics of a bag, for people, and what else a bag tells without being a recording.

use super::choose::Chosen;
use super::options::BagOptions;
use super::scan::{Scan, TopicScan};
use super::track::Track;
use crate::bag::Bag;
use crate::error::RecordingError;
use crate::message::StaticTransform;
use crate::provenance::TopicSummary;
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
            "{} messages cannot be read, the first because of {}: {}",
            topic.unreadable, problem.field, problem.problem
        ));
    }
    if topic.stamps.unset > 0 {
        problems.push(format!(
            "{} messages have no time stamp; the time of recording stands in",
            topic.stamps.unset
        ));
    }
    let (backward, _) = topic.backward();
    if backward > 0 {
        problems.push(format!("{backward} time stamps run backward"));
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
