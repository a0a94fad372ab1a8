//! Messages that were sent and did not come, by their numbers.

use std::collections::BTreeMap;

/// Counts the numbers that are missing, of each sender apart.
#[derive(Clone, Debug)]
pub(super) struct Gaps<S> {
    last: BTreeMap<S, i64>,
}

/// Senders that are kept account of at a time: those that were restarted leave theirs behind.
const MOST_SENDERS: usize = 256;

impl<S> Default for Gaps<S> {
    fn default() -> Self {
        Self { last: BTreeMap::new() }
    }
}

impl<S: Ord> Gaps<S> {
    /// Takes in the number of a message; how many before it are missing. Of a sender that is new, what was
    /// before is not missed.
    pub(super) fn before(&mut self, sender: S, number: i64) -> u64 {
        if self.last.len() >= MOST_SENDERS && !self.last.contains_key(&sender) {
            self.last.clear();
        }
        let Some(last) = self.last.insert(sender, number) else { return 0 };
        u64::try_from(number.saturating_sub(last).saturating_sub(1)).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_came_and_what_is_missing_is_what_was_sent(
            came in proptest::collection::vec(proptest::bool::weighted(0.7), 1..200), first in 0..1_000_000_i64,
        ) {
            let mut gaps = Gaps::default();
            let numbers = (first..).zip(&came).filter(|(_, came)| **came).map(|(number, _)| number);
            let numbers: Vec<i64> = numbers.collect();
            let missing: u64 = numbers.iter().map(|number| gaps.before("a", *number)).sum();
            let span = numbers.last().zip(numbers.first()).map_or(0, |(last, first)| last - first + 1);
            prop_assert_eq!(missing + numbers.len() as u64, span as u64);
        }

        #[test]
        fn senders_do_not_disturb_each_other(order in proptest::collection::vec(0..3_u8, 1..100)) {
            let (mut gaps, mut next) = (Gaps::default(), [5_i64, 90, 7]);
            for sender in order {
                prop_assert_eq!(gaps.before(sender, next[usize::from(sender)]), 0);
                next[usize::from(sender)] += 1;
            }
        }
    }

    #[test]
    fn strange_numbers_are_no_loss() {
        let mut gaps = Gaps::default();
        assert_eq!(
            [gaps.before(0, i64::MAX), gaps.before(0, i64::MIN), gaps.before(0, i64::MIN)],
            [0, 0, 0]
        );
    }
}
