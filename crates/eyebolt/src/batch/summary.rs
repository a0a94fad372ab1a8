//! What became of all recordings.

use super::line::{Ending, ExpectedError, Line};
use std::collections::BTreeMap;

/// What became of all recordings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// How many ended in which way.
    pub endings: BTreeMap<Ending, Tally>,
    /// How often answers were refused for which reason.
    pub reasons: BTreeMap<String, usize>,
}

/// What became of recordings that ended alike.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// How many there are.
    pub recordings: usize,
    translation_mm: Vec<f64>,
    rotation_deg: Vec<f64>,
}

impl Summary {
    /// Of `lines`, in any order.
    pub fn of<'a>(lines: impl IntoIterator<Item = &'a Line>) -> Self {
        let mut summary = Self::default();
        for line in lines {
            let tally = summary.endings.entry(line.ending).or_default();
            tally.recordings += 1;
            if let Some(error) = line.expected_error {
                tally.translation_mm.push(error.translation_mm);
                tally.rotation_deg.push(error.rotation_deg);
            }
            for why in &line.reasons {
                *summary.reasons.entry(why.name.clone()).or_default() += 1;
            }
        }
        for tally in summary.endings.values_mut() {
            tally.translation_mm.sort_by(f64::total_cmp);
            tally.rotation_deg.sort_by(f64::total_cmp);
        }
        summary
    }

    /// How many recordings there are.
    pub fn recordings(&self) -> usize {
        self.endings.values().map(|tally| tally.recordings).sum()
    }

    /// How many ended so.
    pub fn count(&self, ending: Ending) -> usize {
        self.endings.get(&ending).map_or(0, |tally| tally.recordings)
    }
}

impl Tally {
    /// Of the errors to expect, the middle one: half of them are at most as large. `None` where nothing is to be expected.
    pub fn median_expected(&self) -> Option<ExpectedError> {
        let at = |sorted: &[f64]| sorted.get(sorted.len().saturating_sub(1) / 2).copied();
        self.expected(at)
    }

    /// The largest error to expect, translation and rotation apart.
    pub fn worst_expected(&self) -> Option<ExpectedError> {
        self.expected(|sorted| sorted.last().copied())
    }

    fn expected(&self, of: impl Fn(&[f64]) -> Option<f64>) -> Option<ExpectedError> {
        Some(ExpectedError {
            translation_mm: of(&self.translation_mm)?,
            rotation_deg: of(&self.rotation_deg)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Summary;
    use crate::batch::{Ending, ExpectedError, Line, Why, listed};

    /// Recording `number`, trusted with an error of its number or refused.
    fn line(number: usize, ending: Ending) -> Line {
        let path = number.to_string();
        let listed = listed([path.as_str()]).unwrap().remove(0);
        let why = Why { name: "little".to_owned(), text: format!("only {number}") };
        Line {
            ending,
            expected_error: (ending == Ending::Trusted).then_some(ExpectedError {
                translation_mm: number as f64,
                rotation_deg: -(number as f64),
            }),
            reasons: if ending == Ending::Refused { vec![why.clone(), why] } else { Vec::new() },
            error: None,
            ..Line::failed(&listed, String::new())
        }
    }

    #[test]
    fn order_says_nothing_and_everything_is_counted_once() {
        let endings = [Ending::Trusted, Ending::Refused, Ending::Failed, Ending::Trusted];
        let mut lines: Vec<Line> =
            endings.into_iter().cycle().take(12).enumerate().map(|(i, e)| line(i, e)).collect();
        let summary = Summary::of(&lines);
        assert_eq!(summary.recordings(), 12);
        let counts = [Ending::Trusted, Ending::Refused, Ending::Failed].map(|e| summary.count(e));
        assert_eq!(counts, [6, 3, 3]);
        assert_eq!(summary.reasons["little"], 6);
        // Of 0, 3, 4, 7, 8 and 11.
        let trusted = &summary.endings[&Ending::Trusted];
        assert_eq!(trusted.median_expected().unwrap().translation_mm, 4.0);
        assert_eq!(trusted.worst_expected().unwrap().translation_mm, 11.0);
        assert_eq!(trusted.worst_expected().unwrap().rotation_deg, 0.0);
        assert_eq!(summary.endings[&Ending::Failed].median_expected(), None);
        lines.reverse();
        assert_eq!(Summary::of(&lines), summary);
    }

    #[test]
    fn a_line_read_again_is_the_same() {
        for ending in [Ending::Trusted, Ending::Refused, Ending::Failed] {
            let line = line(3, ending);
            let text = line.to_json();
            assert_eq!(text.matches('\n').count(), 1);
            assert_eq!(serde_json::from_str::<Line>(&text).unwrap(), line);
        }
    }
}
