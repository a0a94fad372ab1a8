//! The sequential test: when views have said often enough that something moved.
//!
//! For each view since which something may have moved there is a likelihood ratio of what came after: of what the
//! suspects (each weighed by how likely it is beforehand) make of it, every view predicted from those before, against what
//! is stored. Where nothing moved, each is a martingale of mean one, so that their sum (Shiryaev and Roberts: Pollak, Annals of Statistics 1985)
//! reaches `A` no sooner than after `A` views on average (Shin, Ramdas and Rinaldo, "E-detectors", New England Journal
//! of Statistics in Data Science 2024). A view may be spoilt, by whoever stands there: then it says the
//! same whatever is believed, so that no single view raises an alarm.

use super::belief::{Belief, Quadratic, log_sum};

/// How often views come, and how often an alarm may be false.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Resting views an hour.
    pub views_per_hour: f64,
    /// False alarms an hour, on average.
    pub false_alarms_per_hour: f64,
}

impl Default for Rate {
    /// A view every ten seconds, a false alarm in a thousand hours.
    fn default() -> Self {
        Self { views_per_hour: 360.0, false_alarms_per_hour: 1e-3 }
    }
}

impl Rate {
    /// Logarithm of the average number of views to a false alarm.
    fn log_views_to_alarm(&self) -> f64 {
        (self.views_per_hour / self.false_alarms_per_hour).max(1.0).ln()
    }
}

/// How often a view is spoilt: people and things in it that are taken for the arm.
const SPOILT: f64 = 0.01;
/// Moments of change that are kept in mind: forgetting others only lowers the sum.
const MOST_MOMENTS: usize = 32;
/// A moment that is this likely, against nothing having moved, is one to report.
const LIKELY: f64 = 2.3;
/// Otherwise the drift is that of so many last views.
const RECENT: usize = 12;

/// What is believed of the shifts before anything is seen.
#[derive(Clone, Debug)]
pub struct Beliefs {
    /// If nothing moved: how well what is stored is known.
    pub unmoved: Belief,
    /// If something moved, for each thing that may have, as far as it may have. A view that is spoilt looks like any of them.
    pub suspects: Vec<Belief>,
    /// How many of them, the first ones, are the same thing moved by more or by less.
    pub alike: usize,
}

impl Beliefs {
    /// The suspects, each with the logarithm of how likely it is beforehand: those that are alike as all others together.
    fn weighed(&self) -> impl Iterator<Item = (f64, &Belief)> {
        let others = self.suspects.len().saturating_sub(self.alike);
        let share = if others == 0 { 1.0 } else { 0.5 };
        self.suspects.iter().enumerate().map(move |(place, belief)| {
            let of = if place < self.alike { self.alike } else { others };
            let weight: f64 = share / of as f64;
            (weight.ln(), belief)
        })
    }
}

/// A moment since which something may have moved.
#[derive(Clone, Debug)]
pub(super) struct Moment {
    /// The first view after it, counted from 0 among those that count.
    pub since: usize,
    /// How many suspects, the first ones, are the same thing.
    pub alike: usize,
    /// Of each suspect: logarithm of its weight times the likelihood ratio of the views after, and where it has everything.
    pub suspects: Vec<(f64, Belief)>,
}

impl Moment {
    /// The likeliest of the first suspects, which are alike, and its number.
    pub fn first(&self) -> Option<(usize, &Belief)> {
        let alike = self.suspects.iter().take(self.alike).enumerate();
        let likeliest = alike.max_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b));
        likeliest.map(|(number, (_, belief))| (number, belief))
    }

    /// Logarithm of the likelihood ratio of all suspects together.
    fn log_ratio(&self) -> f64 {
        self.suspects.iter().fold(f64::NEG_INFINITY, |sum, (log, _)| log_sum(sum, *log))
    }
}

/// The test; views go in one by one.
#[derive(Clone, Debug)]
pub struct Detector {
    beliefs: Beliefs,
    moments: Vec<Moment>,
    counted: usize,
    log_limit: f64,
}

impl Detector {
    /// A test of whether all is still as stored.
    pub fn new(beliefs: Beliefs, rate: &Rate) -> Self {
        Self { beliefs, moments: Vec::new(), counted: 0, log_limit: rate.log_views_to_alarm() }
    }

    /// Counts a view with this evidence of the shifts.
    pub fn count(&mut self, evidence: &Quadratic) {
        // As good as the best suspect before anything is seen: no first view has a ratio of more than 1 / SPOILT.
        let likelihoods =
            self.beliefs.weighed().map(|(log, belief)| log + belief.log_likelihood(evidence));
        let spoilt = SPOILT.ln() + likelihoods.fold(f64::NEG_INFINITY, log_sum);
        // How likely a belief made the view, and what it learns of it: of one that is rather spoilt, nothing.
        let tell = |belief: &mut Belief| {
            let good = (-SPOILT).ln_1p() + belief.log_likelihood(evidence);
            if let Some(after) = belief.after(evidence).filter(|_| good > spoilt) {
                *belief = after;
            }
            log_sum(good, spoilt)
        };
        let if_unmoved = tell(&mut self.beliefs.unmoved);
        self.begin_moment();
        for (log, belief) in self.moments.iter_mut().flat_map(|moment| &mut moment.suspects) {
            *log += tell(belief) - if_unmoved;
        }
    }

    /// Counts a view in which the arm is not where it should be, nor anywhere near: if nothing moved, it is spoilt.
    pub fn count_absent(&mut self) {
        self.begin_moment();
        let suspects = self.moments.iter_mut().flat_map(|moment| &mut moment.suspects);
        suspects.for_each(|(log, _)| *log -= SPOILT.ln());
    }

    fn begin_moment(&mut self) {
        if self.moments.len() >= MOST_MOMENTS {
            let ratios = self.moments.iter().map(Moment::log_ratio).enumerate();
            if let Some((least, _)) = ratios.min_by(|(_, a), (_, b)| a.total_cmp(b)) {
                self.moments.remove(least);
            }
        }
        let suspects = self.beliefs.weighed().map(|(log, belief)| (log, belief.clone())).collect();
        let alike = self.beliefs.alike;
        self.moments.push(Moment { since: self.counted, alike, suspects });
        self.counted += 1;
    }

    /// Logarithm of the sum over all moments, against the limit: an alarm at zero and above.
    pub fn log_evidence(&self) -> f64 {
        let ratios = self.moments.iter().map(Moment::log_ratio);
        ratios.fold(f64::NEG_INFINITY, log_sum) - self.log_limit
    }

    /// Whether something moved.
    pub fn alarms(&self) -> bool {
        self.log_evidence() >= 0.0
    }

    /// How many views counted.
    pub fn counted(&self) -> usize {
        self.counted
    }

    /// The moment since which something most likely moved; otherwise some views ago.
    pub(super) fn moment(&self) -> Option<&Moment> {
        let ratio = |moment: &&Moment| moment.log_ratio();
        let best = self.moments.iter().max_by(|a, b| ratio(a).total_cmp(&ratio(b)))?;
        let recent = |moment: &&Moment| moment.since + RECENT >= self.counted;
        Some(if best.log_ratio() > LIKELY { best } else { self.moments.iter().find(recent)? })
    }
}

#[cfg(test)]
mod tests;
