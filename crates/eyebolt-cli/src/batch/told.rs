//! What is said of a batch.

use super::folder::Folder;
use crate::{names, output};
use eyebolt::batch::{Ending, ExpectedError, Line, Summary};
use std::fmt::Write;

fn size(error: Option<ExpectedError>) -> String {
    error.map_or(String::new(), |error| {
        format!("{:.2} mm {:.3} deg", error.translation_mm, error.rotation_deg)
    })
}

/// What became of one recording.
pub fn line(line: &Line) -> String {
    let word = line.ending.name().to_uppercase();
    let word = output::emphasised(&word, line.ending == Ending::Trusted);
    let why = match (&line.error, line.reasons.first()) {
        (Some(error), _) => error.clone(),
        (None, Some(why)) => names::in_flags(&why.text),
        (None, None) => format!("expected error {}", size(line.expected_error)),
    };
    // Errors begin with the path where that is to blame.
    match why.starts_with(&line.recording) {
        true => format!("{word}  {why}"),
        false => format!("{word}  {}: {why}", line.recording),
    }
}

/// Failures that are told one by one.
const MOST_FAILURES: usize = 10;

/// What became of all recordings, whose files are in `folder`.
pub fn summary(lines: &[(Line, String)], folder: &Folder) -> String {
    let summary = Summary::of(lines.iter().map(|(line, _)| line));
    let mut text =
        format!("{:12} {:>10}  {:24}  worst\n", "", "recordings", "expected error, median");
    for ending in [Ending::Trusted, Ending::Refused, Ending::Failed] {
        let tally = summary.endings.get(&ending);
        let median = size(tally.and_then(|tally| tally.median_expected()));
        let worst = size(tally.and_then(|tally| tally.worst_expected()));
        let row =
            format!("{:12} {:>10}  {median:24}  {worst}", ending.name(), summary.count(ending));
        let _ = writeln!(text, "{}", row.trim_end());
    }
    let _ = writeln!(text, "{:12} {:>10}", "all", summary.recordings());
    let reasons: Vec<String> =
        summary.reasons.iter().map(|(reason, count)| format!("{reason} {count}")).collect();
    if !reasons.is_empty() {
        let _ = writeln!(text, "why answers were refused: {}", reasons.join(", "));
    }
    let failed = lines.iter().filter(|(line, _)| line.ending == Ending::Failed);
    for (failed, _) in failed.take(MOST_FAILURES) {
        let _ = writeln!(text, "{}", line(failed));
    }
    let more = summary.count(Ending::Failed).saturating_sub(MOST_FAILURES);
    if more > 0 {
        let _ = writeln!(text, "and {more} more that failed");
    }
    let path = folder.path();
    let _ = write!(
        text,
        "lines in {}, page in {}",
        path.join("batch.jsonl").display(),
        path.join("index.html").display()
    );
    text
}
