//! What the time stamps of a topic tell of its clock.

use crate::provenance::ClockOffset;

/// Stamps of one topic, against the times at which its messages were written down.
#[derive(Clone, Debug, Default)]
pub(super) struct Stamps {
    /// Messages whose stamp nobody set.
    pub(super) unset: u64,
    /// Messages stamped before one that came earlier, and the first such pair, nanoseconds.
    pub(super) backward: u64,
    pub(super) first_backward_ns: Option<(i64, i64)>,
    latest_ns: Option<i64>,
    /// Some delays from the stamp to the writing down, nanoseconds; every `stride`-th.
    delays_ns: Vec<i64>,
    stride: u64,
    count: u64,
}

/// Delays that stand for all.
const MOST_DELAYS: usize = 2048;

impl Stamps {
    /// Adds a message; the stamp to go by.
    pub(super) fn add(&mut self, stamp_ns: i64, log_time_ns: i64) -> i64 {
        let stands_in = stamp_ns == 0;
        let stamp_ns = self.add_unordered(stamp_ns, log_time_ns);
        match self.latest_ns {
            Some(latest) if stamp_ns < latest && !stands_in => {
                self.backward += 1;
                self.first_backward_ns.get_or_insert((latest, stamp_ns));
            }
            // The time of recording is of another clock.
            _ if stands_in => {}
            _ => self.latest_ns = Some(stamp_ns),
        }
        stamp_ns
    }

    /// As [`Self::add`], of a topic on which several publish, each in its own order.
    pub(super) fn add_unordered(&mut self, stamp_ns: i64, log_time_ns: i64) -> i64 {
        self.count += 1;
        if stamp_ns == 0 {
            self.unset += 1;
            return log_time_ns;
        }
        if self.count.is_multiple_of(self.stride.max(1)) {
            self.delays_ns.push(log_time_ns.saturating_sub(stamp_ns));
        }
        if self.delays_ns.len() > MOST_DELAYS {
            let mut keep = false;
            self.delays_ns.retain(|_| {
                keep = !keep;
                keep
            });
            self.stride = 2 * self.stride.max(1);
        }
        stamp_ns
    }

    /// Delay that 95 of 100 messages have at least, and that 95 have at most, nanoseconds.
    pub(super) fn delay_ns(&self) -> Option<(i64, i64)> {
        let mut sorted = self.delays_ns.clone();
        sorted.sort_unstable();
        let margin = sorted.len() / 20;
        Some((*sorted.get(margin)?, *sorted.get(sorted.len().checked_sub(1 + margin)?)?))
    }
}

/// Delays differ by so much between two topics of one clock, for want of a better word: transport.
const SAME_CLOCK_S: f64 = 1.0;
/// Where the times of recording stand for stamps, what transport takes is in doubt: filters and
/// networks delay depth by so much.
pub(super) const TRANSPORT_S: f64 = 0.15;

/// The offset between the clock of depth and that of joints.
pub(super) fn clock_offset(depth: &Stamps, joints: &Stamps) -> Option<ClockOffset> {
    let ((depth_low, depth_high), (joints_low, joints_high)) =
        (depth.delay_ns()?, joints.delay_ns()?);
    let seconds = |ns: i64| ns as f64 * 1e-9;
    let spread = |low: i64, high: i64| seconds(high.saturating_sub(low));
    let offset = seconds(depth_low.saturating_sub(joints_low));
    let applied = offset.abs() > SAME_CLOCK_S;
    let spread = spread(depth_low, depth_high).max(spread(joints_low, joints_high));
    // Where nothing is shifted, the offset itself may be one of the clocks or of the transport.
    let uncertainty_s = if applied { spread + TRANSPORT_S } else { offset.abs() };
    Some(ClockOffset { seconds: offset, uncertainty_s, applied, seen: false })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_message_that_came_late_does_not_count() {
        let (mut depth, mut joints) = (Stamps::default(), Stamps::default());
        for i in 1..5000_i64 {
            let late = if i == 77 { 4_000_000_000 } else { 0 };
            depth.add(i * 33_000_000, i * 33_000_000 + 50_000_000 + late);
            joints.add(i * 33_000_000, i * 33_000_000 + 1_000_000);
        }
        let offset = clock_offset(&depth, &joints).unwrap();
        assert!(!offset.applied && (offset.seconds - 0.049).abs() < 1e-9);
        assert!(depth.delays_ns.len() <= MOST_DELAYS);
    }

    #[test]
    fn a_clock_of_its_own_is_shifted() {
        let (mut depth, mut joints) = (Stamps::default(), Stamps::default());
        let start = 1_700_000_000_000_000_000;
        for i in 1..100_i64 {
            let now = i * 33_000_000;
            depth.add(now, start + now + 30_000_000 + 1_000_000 * (i % 3));
            joints.add(start + now, start + now + 2_000_000);
        }
        let offset = clock_offset(&depth, &joints).unwrap();
        assert!(offset.applied && (offset.seconds - (start as f64 * 1e-9 + 0.028)).abs() < 1e-3);
        assert!((offset.uncertainty_s - 0.002 - TRANSPORT_S).abs() < 1e-9);
    }

    #[test]
    fn unset_and_backward_stamps_are_counted() {
        let mut stamps = Stamps::default();
        assert_eq!(stamps.add(0, 7), 7);
        assert_eq!([stamps.add(20, 21), stamps.add(10, 22), stamps.add(30, 31)], [20, 10, 30]);
        assert_eq!((stamps.unset, stamps.backward), (1, 1));
        assert_eq!(stamps.first_backward_ns, Some((20, 10)));
    }
}
