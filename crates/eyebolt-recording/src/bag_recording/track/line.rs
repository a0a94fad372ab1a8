//! A broken line through positions over time.

/// Turns of a line, in order of time.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// Positions at one time.
    joints: usize,
    /// Nanoseconds, rising.
    stamps_ns: Vec<i64>,
    /// Positions at the stamps; NaN where a joint was not told.
    positions: Vec<f64>,
    /// Longest time without a sample on the way to each stamp, nanoseconds.
    gaps_ns: Vec<i64>,
}

impl Line {
    /// A line of so many joints that has no turns yet.
    pub(super) fn new(joints: usize) -> Self {
        Self { joints, stamps_ns: Vec::new(), positions: Vec::new(), gaps_ns: Vec::new() }
    }

    /// Positions at one time.
    pub(super) fn joints(&self) -> usize {
        self.joints
    }

    /// Goes on to a later stamp.
    pub(super) fn push(&mut self, stamp_ns: i64, positions: &[f64], gap_ns: i64) {
        self.stamps_ns.push(stamp_ns);
        self.positions.extend_from_slice(positions);
        self.gaps_ns.push(gap_ns);
    }

    /// Number of turns.
    pub(super) fn turns(&self) -> usize {
        self.stamps_ns.len()
    }

    /// Whether it has more turns, or more positions in all of them, than these.
    pub(super) fn is_larger_than(&self, turns: usize, positions: usize) -> bool {
        self.stamps_ns.len() > turns || self.positions.len() > positions
    }

    /// Stamp, positions and gap of every turn.
    pub(super) fn iter(&self) -> impl Iterator<Item = (i64, &[f64], i64)> {
        let turns = self.stamps_ns.iter().zip(&self.gaps_ns).enumerate();
        turns.map(|(index, (stamp, gap))| (*stamp, self.at_turn(index), *gap))
    }

    pub(super) fn first_ns(&self) -> Option<i64> {
        self.stamps_ns.first().copied()
    }

    pub(super) fn last_ns(&self) -> Option<i64> {
        self.stamps_ns.last().copied()
    }

    /// Positions at the last turn.
    pub(super) fn end(&self) -> &[f64] {
        self.at_turn(self.turns().saturating_sub(1))
    }

    fn at_turn(&self, index: usize) -> &[f64] {
        let turn = index * self.joints..(index + 1) * self.joints;
        self.positions.get(turn).unwrap_or_default()
    }

    /// Positions at the turns between two times, both included.
    pub(super) fn within(&self, from_ns: i64, to_ns: i64) -> impl Iterator<Item = &[f64]> {
        let start = self.stamps_ns.partition_point(|stamp| *stamp < from_ns);
        let end = self.stamps_ns.partition_point(|stamp| *stamp <= to_ns);
        (start..end).map(|index| self.at_turn(index))
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

    /// Positions at the turn before `stamp_ns`, else at the first one: what was told last, of each
    /// joint.
    pub(super) fn held(&self, stamp_ns: i64) -> Vec<f64> {
        let after = self.stamps_ns.partition_point(|stamp| *stamp <= stamp_ns);
        let mut held = self.at_turn(after.saturating_sub(1)).to_vec();
        for (joint, position) in held.iter_mut().enumerate().filter(|(_, p)| p.is_nan()) {
            let before = self.told(joint, (0..after).rev());
            let told = before.or_else(|| self.told(joint, after..self.turns()));
            *position = told.map_or(f64::NAN, |(_, told)| told);
        }
        held
    }

    /// Where `joint` was told last before `stamp_ns`, and first after it: stamps and positions.
    pub(super) fn told_around(&self, joint: usize, stamp_ns: i64) -> Option<[(i64, f64); 2]> {
        let after = self.stamps_ns.partition_point(|stamp| *stamp < stamp_ns);
        Some([self.told(joint, (0..after).rev())?, self.told(joint, after..self.turns())?])
    }

    /// Stamp and position of `joint` at the first of `turns` that has one.
    fn told(&self, joint: usize, mut turns: impl Iterator<Item = usize>) -> Option<(i64, f64)> {
        turns.find_map(|turn| {
            let position = self.at_turn(turn).get(joint).copied().filter(|p| !p.is_nan())?;
            Some((*self.stamps_ns.get(turn)?, position))
        })
    }

    /// Whether some joint is further than `still` from where it was at the first turn.
    pub(super) fn moves(&self, still: f64) -> bool {
        let first = self.at_turn(0);
        let far = |turn: usize| {
            let steps = first.iter().zip(self.at_turn(turn)).map(|(a, b)| (a - b).abs());
            steps.fold(0.0, f64::max) > still
        };
        (1..self.turns()).any(far)
    }
}

/// A straight part of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece<'a> {
    pub(super) start_ns: i64,
    pub(super) end_ns: i64,
    /// Longest time without a sample, nanoseconds.
    pub(crate) gap_ns: i64,
    pub(crate) start: &'a [f64],
    pub(crate) end: &'a [f64],
}

impl Piece<'_> {
    /// Positions at a time within the piece.
    pub(crate) fn at(&self, stamp_ns: i64) -> Vec<f64> {
        let since_start = |ns: i64| ns.saturating_sub(self.start_ns) as f64;
        let length = since_start(self.end_ns);
        let share = if length > 0.0 { since_start(stamp_ns) / length } else { 0.0 };
        self.start.iter().zip(self.end).map(|(a, b)| a + share * (b - a)).collect()
    }
}
