//! Positions of joints over time, in as few numbers as interpolation needs.

/// Positions that one publisher told, as a broken line through some of its samples.
///
/// A sample that lies on the line between others is not kept, so that hours of an arm at rest take
/// no memory: the "swinging door" of E. H. Bristol ("Swinging door trending", 1990). The line is
/// within twice `tolerance` of every sample, or four times where that had to be doubled.
#[derive(Clone, Debug)]
pub(super) struct Track {
    names: Vec<String>,
    /// Nanoseconds, rising.
    stamps_ns: Vec<i64>,
    /// Positions at the stamps, one per name.
    positions: Vec<f64>,
    /// Longest time without a sample on the way to each stamp, nanoseconds.
    gaps_ns: Vec<i64>,
    /// The last sample, which the line need not turn at, and the longest gap on the way there.
    last: Option<(i64, Vec<f64>, i64)>,
    /// Slopes that lead past every sample since the last turn.
    slopes: Vec<(f64, f64)>,
    tolerance: f64,
    count: u64,
    backward: u64,
    first_backward_ns: Option<(i64, i64)>,
}

/// Radians or metres: a fifth of a millimetre at the end of an arm, less than encoders make of rest.
const TOLERANCE: f64 = 1e-4;
/// Longer without a sample, and the line turns before and after, so that the gap stands alone.
const GAP_NS: i64 = 50_000_000;
/// More turns or positions, and the tolerance doubles: most of an hour of motion, or 16 MB.
const MOST_TURNS: usize = 1 << 18;
const MOST_POSITIONS: usize = 1 << 21;

impl Track {
    pub(super) fn new(names: Vec<String>) -> Self {
        let slopes = vec![(f64::NEG_INFINITY, f64::INFINITY); names.len()];
        Self {
            names,
            stamps_ns: Vec::new(),
            positions: Vec::new(),
            gaps_ns: Vec::new(),
            last: None,
            slopes,
            tolerance: TOLERANCE,
            count: 0,
            backward: 0,
            first_backward_ns: None,
        }
    }

    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// How far the line may be from a sample, radians or metres.
    pub(super) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Number of samples.
    pub(super) fn count(&self) -> u64 {
        self.count
    }

    /// Number of samples that were earlier than one before, and so were not used.
    pub(super) fn backward(&self) -> u64 {
        self.backward
    }

    /// The first such pair of stamps, nanoseconds.
    pub(super) fn first_backward_ns(&self) -> Option<(i64, i64)> {
        self.first_backward_ns
    }

    /// First and last stamp, nanoseconds.
    pub(super) fn span_ns(&self) -> Option<(i64, i64)> {
        let last =
            self.last.as_ref().map(|(stamp, ..)| *stamp).or(self.stamps_ns.last().copied())?;
        Some((self.stamps_ns.first().copied()?, last))
    }

    /// Adds a sample of as many positions as there are names.
    pub(super) fn push(&mut self, stamp_ns: i64, positions: &[f64]) {
        self.count += 1;
        match self.span_ns() {
            Some((_, last)) if stamp_ns < last => {
                self.backward += 1;
                self.first_backward_ns.get_or_insert((last, stamp_ns));
            }
            // Told again.
            Some((_, last)) if stamp_ns == last => {}
            Some((_, last)) => self.extend(stamp_ns, positions, stamp_ns.saturating_sub(last)),
            None => self.turn(stamp_ns, positions, 0),
        }
        if self.stamps_ns.len() > MOST_TURNS || self.positions.len() > MOST_POSITIONS {
            self.coarsen();
        }
    }

    /// Ends the line at the last sample.
    pub(super) fn finish(&mut self) {
        if let Some((stamp, positions, gap)) = self.last.take() {
            self.turn(stamp, &positions, gap);
        }
    }

    fn extend(&mut self, stamp_ns: i64, positions: &[f64], gap_ns: i64) {
        if gap_ns > GAP_NS {
            self.finish();
            self.turn(stamp_ns, positions, gap_ns);
        } else if self.passes(stamp_ns, positions) {
            let gap_ns = self.last.as_ref().map_or(gap_ns, |(_, _, longest)| gap_ns.max(*longest));
            let mut kept = self.last.take().map(|(_, kept, _)| kept).unwrap_or_default();
            kept.clear();
            kept.extend_from_slice(positions);
            self.last = Some((stamp_ns, kept, gap_ns));
        } else {
            self.finish();
            // From the new turn, one sample can always be reached.
            self.passes(stamp_ns, positions);
            self.last = Some((stamp_ns, positions.to_vec(), gap_ns));
        }
    }

    /// Narrows the slopes by a sample; whether any are left.
    fn passes(&mut self, stamp_ns: i64, positions: &[f64]) -> bool {
        let count = self.names.len();
        let Some(start_ns) = self.stamps_ns.last() else { return false };
        let start = self.positions.len().saturating_sub(count);
        let start = self.positions.get(start..).unwrap_or_default();
        let time = stamp_ns.saturating_sub(*start_ns) as f64;
        let mut possible = true;
        for ((slopes, from), to) in self.slopes.iter_mut().zip(start).zip(positions) {
            let rise = to - from;
            slopes.0 = slopes.0.max((rise - self.tolerance) / time);
            slopes.1 = slopes.1.min((rise + self.tolerance) / time);
            possible &= slopes.0 <= slopes.1;
        }
        possible
    }

    fn turn(&mut self, stamp_ns: i64, positions: &[f64], gap_ns: i64) {
        self.stamps_ns.push(stamp_ns);
        self.positions.extend_from_slice(positions);
        self.gaps_ns.push(gap_ns);
        self.slopes.fill((f64::NEG_INFINITY, f64::INFINITY));
    }

    /// Doubles the tolerance, which leaves out some turns.
    fn coarsen(&mut self) {
        let mut coarse = Self { tolerance: 2.0 * self.tolerance, ..Self::new(self.names.clone()) };
        for (index, (stamp, gap)) in self.stamps_ns.iter().zip(&self.gaps_ns).enumerate() {
            match coarse.stamps_ns.is_empty() {
                true => coarse.turn(*stamp, self.at_turn(index), 0),
                false => coarse.extend(*stamp, self.at_turn(index), *gap),
            }
        }
        coarse.finish();
        let last = self.last.take();
        *self = Self {
            count: self.count,
            backward: self.backward,
            first_backward_ns: self.first_backward_ns,
            ..coarse
        };
        if let Some((stamp, positions, gap)) = last {
            self.extend(stamp, &positions, gap);
        }
    }

    fn at_turn(&self, index: usize) -> &[f64] {
        let count = self.names.len();
        self.positions.get(index * count..(index + 1) * count).unwrap_or_default()
    }

    /// The part of the line that `stamp_ns` lies on; `None` before its beginning and after its end.
    pub(super) fn piece(&self, stamp_ns: i64) -> Option<Piece<'_>> {
        let after = self.stamps_ns.partition_point(|stamp| *stamp < stamp_ns);
        let end_ns = *self.stamps_ns.get(after)?;
        // At a turn, the line is a point.
        let before = if end_ns == stamp_ns { after } else { after.checked_sub(1)? };
        Some(Piece {
            start_ns: *self.stamps_ns.get(before)?,
            end_ns,
            gap_ns: if before == after { 0 } else { *self.gaps_ns.get(after)? },
            start: self.at_turn(before),
            end: self.at_turn(after),
        })
    }

    /// The sample nearest to `stamp_ns` that the line turns at: its stamp and positions.
    pub(super) fn nearest(&self, stamp_ns: i64) -> Option<(i64, &[f64])> {
        let after = self.stamps_ns.partition_point(|stamp| *stamp < stamp_ns);
        let candidates = [after.checked_sub(1), Some(after)].into_iter().flatten();
        candidates
            .filter_map(|index| Some((*self.stamps_ns.get(index)?, self.at_turn(index))))
            .min_by_key(|(stamp, _)| stamp.abs_diff(stamp_ns))
    }

    /// Whether its samples are mostly further apart than `dense_ns`.
    pub(super) fn is_sparse(&self, dense_ns: i64) -> bool {
        let span_ns = self.span_ns().map_or(0, |(first, last)| last.saturating_sub(first));
        // One sample more than there are steps between them.
        span_ns as f64 >= dense_ns as f64 * self.count.saturating_sub(2) as f64
    }

    /// The turn before `stamp_ns`, else the first one: what was told last.
    pub(super) fn held(&self, stamp_ns: i64) -> Vec<f64> {
        let after = self.stamps_ns.partition_point(|stamp| *stamp <= stamp_ns);
        self.at_turn(after.saturating_sub(1)).to_vec()
    }

    /// How far the one of `joints` that moves most is seen to move between two times, radians or
    /// metres, and which one that is.
    ///
    /// What it did in gaps longer than `gap_ns` nobody knows.
    pub(super) fn motion(
        &self,
        joints: &[usize],
        from_ns: i64,
        to_ns: i64,
        gap_ns: i64,
    ) -> (f64, usize) {
        let mut ranges = vec![(f64::INFINITY, f64::NEG_INFINITY); self.names.len()];
        let mut see = |positions: &[f64]| {
            for (range, position) in ranges.iter_mut().zip(positions) {
                *range = (range.0.min(*position), range.1.max(*position));
            }
        };
        let Some((first, last)) = self.span_ns() else { return (0.0, 0) };
        for stamp in [from_ns, to_ns].map(|stamp| stamp.clamp(first, last)) {
            if let Some(piece) = self.piece(stamp).filter(|piece| piece.gap_ns <= gap_ns) {
                see(&piece.at(stamp));
            }
        }
        let start = self.stamps_ns.partition_point(|stamp| *stamp < from_ns);
        let end = self.stamps_ns.partition_point(|stamp| *stamp <= to_ns);
        (start..end).for_each(|index| see(self.at_turn(index)));
        let moved = joints.iter().filter_map(|joint| Some((*joint, ranges.get(*joint)?)));
        moved.fold((0.0, 0), |most, (joint, (low, high))| match high - low > most.0 {
            true => (high - low, joint),
            false => most,
        })
    }
}

/// A straight part of a track.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece<'a> {
    start_ns: i64,
    end_ns: i64,
    /// Longest time without a sample, nanoseconds.
    pub(super) gap_ns: i64,
    pub(super) start: &'a [f64],
    pub(super) end: &'a [f64],
}

impl Piece<'_> {
    /// Positions at a time within the piece.
    pub(super) fn at(&self, stamp_ns: i64) -> Vec<f64> {
        let since_start = |ns: i64| ns.saturating_sub(self.start_ns) as f64;
        let length = since_start(self.end_ns);
        let share = if length > 0.0 { since_start(stamp_ns) / length } else { 0.0 };
        self.start.iter().zip(self.end).map(|(a, b)| a + share * (b - a)).collect()
    }
}

#[cfg(test)]
mod tests;
