//! A page on many recordings.

use super::template;
use crate::batch::{Ending, Line, Summary};
use minijinja::{Value, context};

/// The page on `lines`, in their order: how many are trusted, and what became of each, with links to files beside the page. It loads
/// nothing.
pub fn batch_page(lines: &[Line]) -> String {
    let summary = Summary::of(lines);
    let tally = |ending: Ending| {
        let of = summary.endings.get(&ending);
        context! {
            name => ending.name(),
            recordings => summary.count(ending),
            median => Value::from_serialize(of.and_then(|of| of.median_expected())),
            worst => Value::from_serialize(of.and_then(|of| of.worst_expected())),
        }
    };
    let tallies = [Ending::Trusted, Ending::Refused, Ending::Failed].map(tally);
    let mut reasons: Vec<(&String, &usize)> = summary.reasons.iter().collect();
    reasons.sort_by(|a, b| b.1.cmp(a.1).then(a.0.cmp(b.0)));
    let reason = |(name, count): (&String, &usize)| {
        context! { name => name.replace('_', " "), count => count }
    };
    let reasons: Vec<Value> = reasons.into_iter().map(reason).collect();
    let lines: Vec<Value> = lines.iter().map(Value::from_serialize).collect();
    template::render(
        "batch.html",
        context! {
            count => summary.recordings(),
            tallies => tallies,
            reasons => reasons,
            lines => lines,
            version => env!("CARGO_PKG_VERSION"),
        },
    )
}

#[cfg(test)]
mod tests {
    use super::batch_page;
    use crate::batch::{Line, listed};

    #[test]
    fn names_and_errors_are_text_and_never_markup() {
        let hostile = "a/<script>alert(1)</script>&\"'.mcap";
        let listed = listed([hostile]).unwrap();
        let line = Line::failed(&listed[0], "<img src=x>".to_owned());
        let page = batch_page(&[line]);
        for markup in ["<script", "<img"] {
            assert!(!page.contains(markup), "{markup} in {page}");
        }
        assert!(page.contains("&lt;script&gt;") && page.contains("&lt;img"), "{page}");
    }
}
