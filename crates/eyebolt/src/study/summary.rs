//! What became of the sessions of a study.

use super::ending::{Answered, Ending};
use super::kind::Kind;
use super::trial::SessionResult;
use crate::calibrate::Deviation;
use std::collections::BTreeMap;

/// Counts by kind, and whether errors are as large as expected.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    told: u64,
    /// One for each kind that there was.
    pub kinds: BTreeMap<Kind, Tally>,
}

/// What became of the sessions of one kind, or of several.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// How many could be simulated.
    pub sessions: u64,
    /// How many could not; they count nowhere else.
    pub unfit: u64,
    /// Answers within 10 mm and 0.6 degrees, trusted or not.
    pub right: u64,
    /// Answers that are trusted.
    pub trusted: u64,
    /// Trusted, and more than 10 mm or 0.6 degrees off.
    pub false_acceptances: u64,
    /// Not trusted although nothing spoiled the session.
    pub false_refusals: u64,
    /// Right, but refused, in spoiled sessions.
    pub right_but_refused: u64,
    /// Of trusted answers.
    pub coverage: Coverage,
    /// Errors of trusted answers.
    pub errors: Vec<Deviation>,
    /// How often each reason was given, by name.
    pub refusals: BTreeMap<String, u64>,
    /// What simulating and calibrating took in all, seconds.
    pub simulate_s: f64,
    /// Likewise.
    pub calibrate_s: f64,
}

/// How many errors are within the quantiles that were expected of them, for each level of
/// [`super::LEVELS`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    /// Answers that tell a covariance.
    pub answers: u64,
    /// Errors of translation within each quantile.
    pub translation: [u64; 3],
    /// Errors of rotation within each quantile.
    pub rotation: [u64; 3],
}

impl Summary {
    /// How many sessions were added.
    pub fn told(&self) -> u64 {
        self.told
    }

    /// Counts `result`.
    pub fn add(&mut self, result: &SessionResult) {
        self.told += 1;
        self.kinds.entry(result.session.kind).or_default().add(result);
    }

    /// All kinds that are spoiled, or that are not, together.
    pub fn all(&self, spoiled: bool) -> Tally {
        let mut all = Tally::default();
        let of_kind = self.kinds.iter().filter(|(kind, _)| kind.is_spoiled() == spoiled);
        of_kind.for_each(|(_, tally)| all.merge(tally));
        all
    }
}

impl Tally {
    fn add(&mut self, result: &SessionResult) {
        self.simulate_s += result.simulate_s;
        self.calibrate_s += result.calibrate_s;
        let ending = &result.ending;
        if matches!(ending, Ending::Unfit(_)) {
            self.unfit += 1;
            return;
        }
        let (right, trusted) = (ending.is_right(), ending.is_trusted());
        let spoiled = result.session.kind.is_spoiled();
        self.sessions += 1;
        self.right += u64::from(right);
        self.trusted += u64::from(trusted);
        self.false_acceptances += u64::from(trusted && !right);
        self.false_refusals += u64::from(!trusted && !spoiled);
        self.right_but_refused += u64::from(!trusted && right && spoiled);
        for refusal in ending.refusals() {
            *self.refusals.entry(refusal.name.clone()).or_default() += 1;
        }
        if let Ending::Answered(answered) = ending
            && trusted
        {
            self.errors.extend(answered.error);
            self.coverage.add(answered);
        }
    }

    /// Adds what `other` counted.
    pub fn merge(&mut self, other: &Self) {
        self.sessions += other.sessions;
        self.unfit += other.unfit;
        self.right += other.right;
        self.trusted += other.trusted;
        self.false_acceptances += other.false_acceptances;
        self.false_refusals += other.false_refusals;
        self.right_but_refused += other.right_but_refused;
        self.coverage.merge(&other.coverage);
        self.errors.extend(&other.errors);
        for (name, count) in &other.refusals {
            *self.refusals.entry(name.clone()).or_default() += count;
        }
        self.simulate_s += other.simulate_s;
        self.calibrate_s += other.calibrate_s;
    }

    /// Median error of trusted answers, each number apart; `None` without any.
    pub fn median_error(&self) -> Option<Deviation> {
        let median = |of: &dyn Fn(&Deviation) -> f64| {
            let mut values: Vec<f64> = self.errors.iter().map(of).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied()
        };
        Some(Deviation {
            translation_m: median(&|error| error.translation_m)?,
            rotation_rad: median(&|error| error.rotation_rad)?,
        })
    }
}

impl Coverage {
    fn add(&mut self, answered: &Answered) {
        let Some((error, quantiles)) = answered.error.zip(answered.quantiles) else { return };
        self.answers += 1;
        for (level, quantile) in quantiles.iter().enumerate() {
            self.translation[level] += u64::from(error.translation_m <= quantile.translation_m);
            self.rotation[level] += u64::from(error.rotation_rad <= quantile.rotation_rad);
        }
    }

    fn merge(&mut self, other: &Self) {
        self.answers += other.answers;
        for level in 0..3 {
            self.translation[level] += other.translation[level];
            self.rotation[level] += other.rotation[level];
        }
    }
}
