//! A table for people.

use eyebolt::study::{LEVELS, Summary, Tally};
use std::fmt::Write;

const HEAD: &str = "\
kind             sessions  right  trusted  false    false    right but  median error      errors within the
                                           accept.  refusal  refused    of trusted        50/90/95 % expected";

/// What became of all sessions.
pub fn text(summary: &Summary) -> String {
    let mut text = format!("{HEAD}\n");
    let [good, spoiled] = [false, true].map(|spoiled| summary.all(spoiled));
    for (of, name, all) in [(false, "good, all", &good), (true, "spoiled, all", &spoiled)] {
        let kinds = summary.kinds.iter().filter(|(kind, _)| kind.is_spoiled() == of);
        kinds.for_each(|(kind, tally)| text += &row(kind.name(), tally));
        text += &row(name, all);
    }
    let mut all = good;
    all.merge(&spoiled);
    text += &row("all", &all);
    let count = (all.sessions + all.unfit).max(1) as f64;
    let _ = write!(
        text,
        "\n{:.2} s to simulate and {:.2} s to calibrate a session, each on one core",
        all.simulate_s / count,
        all.calibrate_s / count
    );
    if all.unfit > 0 {
        let _ = write!(text, "; {} could not be simulated", all.unfit);
    }
    for (name, tally) in [("good", summary.all(false)), ("spoiled", spoiled)] {
        let reasons: Vec<String> =
            tally.refusals.iter().map(|(reason, count)| format!("{reason} {count}")).collect();
        if !reasons.is_empty() {
            let _ = write!(text, "\nwhy {name} ones were refused: {}", reasons.join(", "));
        }
    }
    text
}

fn row(name: &str, tally: &Tally) -> String {
    let error = tally.median_error().map_or(String::new(), |error| {
        format!("{:.1} mm {:.2} deg", 1e3 * error.translation_m, error.rotation_rad.to_degrees())
    });
    let answers = tally.coverage.answers.max(1) as f64;
    let shares = |counts: [u64; 3]| {
        let share = |level: usize| format!("{:.0}", 100.0 * counts[level] as f64 / answers);
        (0..LEVELS.len()).map(share).collect::<Vec<_>>().join("/")
    };
    let coverage = match tally.coverage.answers {
        0 => String::new(),
        _ => format!(
            "{} mm, {} deg",
            shares(tally.coverage.translation),
            shares(tally.coverage.rotation)
        ),
    };
    let line = format!(
        "{name:16} {:8} {:6} {:8} {:8} {:8} {:10}  {error:16}  {coverage}",
        tally.sessions,
        tally.right,
        tally.trusted,
        tally.false_acceptances,
        tally.false_refusals,
        tally.right_but_refused,
    );
    format!("{}\n", line.trim_end())
}
