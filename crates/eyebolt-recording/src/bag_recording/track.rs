//! Positions of joints over time, in as few numbers as interpolation needs.

mod line;
mod second_publisher;

use line::{Line, Piece};
use second_publisher::of_one_publisher;

/// Positions that one publisher told, as a broken line through some of its samples.
///
/// A sample that lies on the line between others is not kept, so that hours of an arm at rest take
/// no memory: the "swinging door" of E. H. Bristol ("Swinging door trending", 1990). The line is
/// within twice `tolerance` of every sample, or four times where that had to be made coarser.
///
/// A message need not tell every joint: NaN stands for what it does not tell, and the line turns
/// wherever a joint begins or ends to be told.
///
/// However much there is to tell, a track is of bounded size: should the line turn too often, it is
/// made coarser, and if even that is of no help, every other turn is forgotten.
#[derive(Clone, Debug)]
pub(super) struct Track {
    names: Vec<String>,
    /// Of one position per name.
    line: Line,
    /// The last sample, which the line need not turn at, and the longest gap on the way there.
    last: Option<(i64, Vec<f64>, i64)>,
    /// Slopes that lead past every sample since the last turn.
    slopes: Vec<(f64, f64)>,
    tolerance: f64,
    /// How often every other turn was forgotten.
    thinned: u32,
    count: u64,
    backward: u64,
    first_backward_ns: Option<(i64, i64)>,
    /// Messages of a second publisher that were taken out.
    second: u64,
    /// Turns that were gone through again, to make the line coarser.
    #[cfg(test)]
    gone_through: usize,
}

/// Radians or metres: a fifth of a millimetre at the end of an arm, less than encoders make of rest.
const TOLERANCE: f64 = 1e-4;
/// No line is made coarser than this, radians or metres: ten times what counts as motion.
const COARSEST: f64 = 512.0 * TOLERANCE;
/// More turns or positions, and the line is made coarser: most of an hour of motion, or 16 MB.
const MOST_TURNS: usize = 1 << 18;
const MOST_POSITIONS: usize = 1 << 21;

/// Between samples that are nearer to each other than this, positions are interpolated, nanoseconds.
pub(super) const DENSE_NS: i64 = 200_000_000;
/// And than this, if nothing moved between them: by so much, radians or metres.
pub(super) const SPARSE_NS: i64 = 1_500_000_000;
pub(super) const STILL: f64 = 5e-4;

impl Track {
    pub(super) fn new(names: Vec<String>) -> Self {
        let slopes = vec![(f64::NEG_INFINITY, f64::INFINITY); names.len()];
        Self {
            line: Line::new(names.len()),
            names,
            last: None,
            slopes,
            tolerance: TOLERANCE,
            thinned: 0,
            count: 0,
            backward: 0,
            first_backward_ns: None,
            second: 0,
            #[cfg(test)]
            gone_through: 0,
        }
    }

    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// How far the line may be from a sample, radians or metres.
    pub(super) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// One of how many turns of the line is left.
    pub(super) fn thinning(&self) -> u64 {
        2_u64.saturating_pow(self.thinned)
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

    /// Number of places where a second publisher, which always told the same, was taken out.
    pub(super) fn second(&self) -> u64 {
        self.second
    }

    /// Whether some joint is seen to move.
    pub(super) fn moves(&self) -> bool {
        self.line.moves(STILL)
    }

    /// First and last stamp, nanoseconds.
    pub(super) fn span_ns(&self) -> Option<(i64, i64)> {
        let last = self.last.as_ref().map(|(stamp, ..)| *stamp).or(self.line.last_ns())?;
        Some((self.line.first_ns()?, last))
    }

    /// Adds a sample of as many positions as there are names; NaN for joints that it does not tell.
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
        if self.line.is_larger_than(MOST_TURNS, MOST_POSITIONS) {
            self.shrink();
        }
    }

    /// Ends the line, of which no more samples come.
    pub(super) fn finish(&mut self) {
        self.end();
        if let Some((line, second)) = of_one_publisher(&self.line, STILL) {
            (self.line, self.second) = (line, second);
            self.count = self.count.saturating_sub(second);
        }
    }

    /// Ends the line at the last sample.
    fn end(&mut self) {
        if let Some((stamp, positions, gap)) = self.last.take() {
            self.turn(stamp, &positions, gap);
        }
    }

    fn extend(&mut self, stamp_ns: i64, positions: &[f64], gap_ns: i64) {
        let longest_ns = self.last.as_ref().map_or(gap_ns, |(_, _, longest)| gap_ns.max(*longest));
        if self.is_known(positions, longest_ns) && self.passes(stamp_ns, positions) {
            let mut kept = self.last.take().map(|(_, kept, _)| kept).unwrap_or_default();
            kept.clear();
            kept.extend_from_slice(positions);
            self.last = Some((stamp_ns, kept, longest_ns));
            return;
        }
        self.end();
        if self.is_known(positions, gap_ns) {
            // From the new turn, one sample can always be reached.
            self.passes(stamp_ns, positions);
            self.last = Some((stamp_ns, positions.to_vec(), gap_ns));
        } else {
            self.turn(stamp_ns, positions, gap_ns);
        }
    }

    /// Whether it is known where the joints are on the way from the last turn to `positions`, if
    /// samples are up to `gap_ns` apart on that way. Where it is not, a gap stands alone, so that
    /// nothing is taken for unknown that is not.
    fn is_known(&self, positions: &[f64], gap_ns: i64) -> bool {
        let mut told = self.line.end().iter().zip(positions);
        if told.any(|(a, b)| a.is_nan() != b.is_nan()) {
            return false;
        }
        let steps = self.line.end().iter().zip(positions).map(|(a, b)| (a - b).abs());
        gap_ns <= DENSE_NS || (gap_ns <= SPARSE_NS && steps.fold(0.0, f64::max) <= STILL)
    }

    /// Narrows the slopes by a sample; whether any are left.
    fn passes(&mut self, stamp_ns: i64, positions: &[f64]) -> bool {
        let Some(start_ns) = self.line.last_ns() else { return false };
        let time = stamp_ns.saturating_sub(start_ns) as f64;
        let mut possible = true;
        for ((slopes, from), to) in self.slopes.iter_mut().zip(self.line.end()).zip(positions) {
            let rise = to - from;
            slopes.0 = slopes.0.max((rise - self.tolerance) / time);
            slopes.1 = slopes.1.min((rise + self.tolerance) / time);
            possible &= slopes.0 <= slopes.1;
        }
        possible
    }

    fn turn(&mut self, stamp_ns: i64, positions: &[f64], gap_ns: i64) {
        self.line.push(stamp_ns, positions, gap_ns);
        self.slopes.fill((f64::NEG_INFINITY, f64::INFINITY));
    }

    /// Halves the line at least, so that a sample seldom makes this necessary, however many come.
    fn shrink(&mut self) {
        let last = self.last.take();
        let mut tolerance = 2.0 * self.tolerance;
        let smaller = loop {
            if tolerance > COARSEST {
                break self.thinner();
            }
            let coarser = self.coarser(tolerance);
            if !coarser.line.is_larger_than(MOST_TURNS / 2, MOST_POSITIONS / 2) {
                break coarser;
            }
            tolerance *= 2.0;
            #[cfg(test)]
            {
                self.gone_through += self.line.turns();
            }
        };
        let (end_ns, kept_end_ns) = (self.line.last_ns(), smaller.line.last_ns());
        *self = Self {
            count: self.count,
            backward: self.backward,
            first_backward_ns: self.first_backward_ns,
            second: self.second,
            #[cfg(test)]
            gone_through: self.gone_through + self.line.turns(),
            ..smaller
        };
        if let Some((stamp, positions, gap)) = last {
            // The last turn may be one of those that were forgotten.
            let forgotten = kept_end_ns.filter(|_| kept_end_ns != end_ns);
            let gap = forgotten.map_or(gap, |end_ns| stamp.saturating_sub(end_ns));
            self.extend(stamp, &positions, gap);
        }
    }

    /// The line with another tolerance, through some of its turns.
    fn coarser(&self, tolerance: f64) -> Self {
        let thinned = self.thinned;
        let mut coarse = Self { tolerance, thinned, ..Self::new(self.names.clone()) };
        for (stamp_ns, positions, gap_ns) in self.line.iter() {
            match coarse.line.turns() {
                0 => coarse.turn(stamp_ns, positions, 0),
                _ => coarse.extend(stamp_ns, positions, gap_ns),
            }
        }
        coarse.end();
        coarse
    }

    /// The line through every other of its turns. Between these nobody knows the way any more.
    fn thinner(&self) -> Self {
        let (tolerance, thinned) = (self.tolerance, self.thinned.saturating_add(1));
        let mut thin = Self { tolerance, thinned, ..Self::new(self.names.clone()) };
        for (stamp_ns, positions, _) in self.line.iter().step_by(2) {
            let before_ns = thin.line.last_ns().unwrap_or(stamp_ns);
            thin.turn(stamp_ns, positions, stamp_ns.saturating_sub(before_ns));
        }
        thin
    }

    /// The part of the line that `stamp_ns` lies on; `None` before its beginning and after its end.
    pub(super) fn piece(&self, stamp_ns: i64) -> Option<Piece<'_>> {
        self.line.piece(stamp_ns)
    }

    /// The sample nearest to `stamp_ns` that the line turns at: its stamp and positions.
    pub(super) fn nearest(&self, stamp_ns: i64) -> Option<(i64, &[f64])> {
        self.line.nearest(stamp_ns)
    }

    /// The turn before `stamp_ns`, else the first one: what was told last, of each joint.
    pub(super) fn held(&self, stamp_ns: i64) -> Vec<f64> {
        self.line.held(stamp_ns)
    }

    /// Where `joint` was at `stamp_ns`, if messages that do not tell it stand between others that
    /// do, near enough to interpolate.
    pub(super) fn across(&self, joint: usize, stamp_ns: i64) -> Option<f64> {
        let [(start_ns, start), (end_ns, end)] = self.line.told_around(joint, stamp_ns)?;
        let gap_ns = end_ns.saturating_sub(start_ns);
        let near = gap_ns <= DENSE_NS || (gap_ns <= SPARSE_NS && (end - start).abs() <= STILL);
        let share = stamp_ns.saturating_sub(start_ns) as f64 / gap_ns.max(1) as f64;
        near.then_some(start + share * (end - start))
    }

    /// Whether its samples are mostly further apart than `dense_ns`.
    pub(super) fn is_sparse(&self, dense_ns: i64) -> bool {
        let span_ns = self.span_ns().map_or(0, |(first, last)| last.saturating_sub(first));
        // One sample more than there are steps between them.
        span_ns as f64 >= dense_ns as f64 * self.count.saturating_sub(2) as f64
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
        self.line.within(from_ns, to_ns).for_each(see);
        let moved = joints.iter().filter_map(|joint| Some((*joint, ranges.get(*joint)?)));
        moved.fold((0.0, 0), |most, (joint, (low, high))| match high - low > most.0 {
            true => (high - low, joint),
            false => most,
        })
    }
}

#[cfg(test)]
mod tests;
