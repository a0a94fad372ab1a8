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

/// Something of each thing that may have moved.
#[derive(Clone, Debug)]
pub struct Suspects<T> {
    /// Camera or base, which moved by more or by less: one thing.
    pub pose: Vec<T>,
    /// Others, each a thing of its own.
    pub others: Vec<T>,
}

impl<T> Suspects<T> {
    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.pose.iter().chain(&self.others)
    }

    fn iter_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.pose.iter_mut().chain(&mut self.others)
    }
}

/// What is believed of the shifts before anything is seen.
#[derive(Clone, Debug)]
pub struct Beliefs {
    /// If nothing moved: how well what is stored is known.
    pub unmoved: Belief,
    /// If something moved, for each thing that may have, as far as it may have. A view that is spoilt looks like any of them.
    pub suspects: Suspects<Belief>,
}

impl Beliefs {
    /// The suspects, each with the logarithm of how likely it is beforehand: the pose as all others together.
    fn weighed(&self) -> Suspects<(f64, Belief)> {
        let Suspects { pose, others } = &self.suspects;
        let share = if others.is_empty() { 1.0 } else { 0.5 };
        let weighed = |of: &[Belief]| {
            let log = (share / of.len().max(1) as f64).ln();
            of.iter().map(|belief| (log, belief.clone())).collect()
        };
        Suspects { pose: weighed(pose), others: weighed(others) }
    }
}

/// A moment since which something may have moved.
#[derive(Clone, Debug)]
pub(super) struct Moment {
    /// The first view after it, counted from 0 among those that count.
    pub since: usize,
    /// Of each suspect: logarithm of its weight times the likelihood ratio of the views after, and where it has everything.
    pub suspects: Suspects<(f64, Belief)>,
}

impl Moment {
    /// The likeliest belief of those in which camera or base moved, and its number.
    pub fn pose(&self) -> Option<(usize, &Belief)> {
        let pose = self.suspects.pose.iter().enumerate();
        let likeliest = pose.max_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b));
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
        let suspects = self.beliefs.weighed();
        let likelihoods =
            suspects.iter().map(|(log, belief)| log + belief.log_likelihood(evidence));
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
        for (log, belief) in self.moments.iter_mut().flat_map(|moment| moment.suspects.iter_mut()) {
            *log += tell(belief) - if_unmoved;
        }
    }

    /// Counts a view in which the arm is not where it should be, nor anywhere near: if nothing moved, it is spoilt.
    pub fn count_absent(&mut self) {
        self.begin_moment();
        let suspects = self.moments.iter_mut().flat_map(|moment| moment.suspects.iter_mut());
        suspects.for_each(|(log, _)| *log -= SPOILT.ln());
    }

    fn begin_moment(&mut self) {
        if self.moments.len() >= MOST_MOMENTS {
            let ratios = self.moments.iter().map(Moment::log_ratio).enumerate();
            if let Some((least, _)) = ratios.min_by(|(_, a), (_, b)| a.total_cmp(b)) {
                self.moments.remove(least);
            }
        }
        self.moments.push(Moment { since: self.counted, suspects: self.beliefs.weighed() });
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
