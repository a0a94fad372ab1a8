//! How good labels are.

use super::classes::UNKNOWN;
use eyebolt_net::Matrix;
use serde::Serialize;
use std::collections::BTreeMap;

/// Points by true and found class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Confusion {
    classes: usize,
    /// `counts[truth * classes + found]`.
    counts: Vec<u64>,
}

/// How good a class is found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ClassScore {
    /// Share of the points found to be of it that are.
    pub precision: f64,
    /// Share of its points that are found.
    pub recall: f64,
    /// Its points found, over all points that are of it or found to be.
    pub iou: f64,
    /// Share of all points of which it is rightly said whether they are of it.
    pub accuracy: f64,
}

impl Confusion {
    /// Of nothing yet.
    pub fn new(classes: usize) -> Self {
        Self { classes, counts: vec![0; classes * classes] }
    }

    /// Counts points, but for those whose truth is [`UNKNOWN`].
    pub fn add(&mut self, truth: &[u8], found: &[u8]) {
        let known = truth.iter().zip(found).filter(|(truth, _)| **truth != UNKNOWN);
        for (truth, found) in known {
            let (truth, found) = (usize::from(*truth), usize::from(*found));
            if truth < self.classes && found < self.classes {
                self.counts[truth * self.classes + found] += 1;
            }
        }
    }

    /// Counts the rows of a network's outputs by their largest logit.
    pub fn add_rows(&mut self, truth: &[u32], logits: &Matrix) {
        let narrow = |labels: &[u32]| labels.iter().map(|label| *label as u8).collect::<Vec<_>>();
        self.add(&narrow(truth), &narrow(&logits.argmax()));
    }

    /// Of one class; 1 where there is nothing to find and nothing was found.
    pub fn class(&self, class: usize) -> ClassScore {
        let at = |truth: usize, found: usize| self.counts[truth * self.classes + found] as f64;
        let hits = at(class, class);
        let found: f64 = (0..self.classes).map(|truth| at(truth, class)).sum();
        let there: f64 = (0..self.classes).map(|found| at(class, found)).sum();
        let share = |of: f64| if of > 0.0 { hits / of } else { 1.0 };
        ClassScore {
            precision: share(found),
            recall: share(there),
            iou: share(found + there - hits),
            accuracy: {
                let all: u64 = self.counts.iter().sum();
                if all > 0 { 1.0 - (found + there - 2.0 * hits) / all as f64 } else { 1.0 }
            },
        }
    }

    /// Counts what `other` counted, of as many classes.
    pub fn merge(&mut self, other: &Self) {
        self.counts.iter_mut().zip(&other.counts).for_each(|(own, other)| *own += other);
    }

    /// Of everything but class 0 taken as one.
    pub fn foreground(&self) -> ClassScore {
        let mut two = Self::new(2);
        for truth in 0..self.classes {
            for found in 0..self.classes {
                let to = usize::from(truth > 0) * 2 + usize::from(found > 0);
                two.counts[to] += self.counts[truth * self.classes + found];
            }
        }
        two.class(1)
    }

    /// Mean intersection over union.
    pub fn mean_iou(&self) -> f64 {
        (0..self.classes).map(|class| self.class(class).iou).sum::<f64>() / self.classes as f64
    }

    /// Precision, recall and IoU of each class, by names such as `arm_recall`.
    pub fn named(&self, names: &[String]) -> BTreeMap<String, f64> {
        let of_class = |(class, name): (usize, &String)| {
            let score = self.class(class);
            [("precision", score.precision), ("recall", score.recall), ("iou", score.iou)]
                .map(|(what, value)| (format!("{name}_{what}"), value))
        };
        let mut named: BTreeMap<_, _> = names.iter().enumerate().flat_map(of_class).collect();
        named.insert("mean_iou".into(), self.mean_iou());
        named
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_by_hand() {
        let mut confusion = Confusion::new(3);
        confusion.add(&[0, 0, 1, 1, 1, 2, 2, UNKNOWN], &[0, 1, 1, 1, 2, 2, 0, 1]);
        let arm = confusion.class(1);
        assert_eq!((arm.precision, arm.recall, arm.iou), (2.0 / 3.0, 2.0 / 3.0, 0.5));
        assert_eq!(arm.accuracy, 5.0 / 7.0);
        let any = confusion.foreground();
        assert_eq!((any.precision, any.recall, any.iou), (4.0 / 5.0, 4.0 / 5.0, 4.0 / 6.0));
        assert_eq!(Confusion::new(2).class(1).recall, 1.0);
    }
}
