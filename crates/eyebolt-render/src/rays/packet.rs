//! Rays that go much the same way, as one piece of work.

use super::bvh::{LANES, Lanes};
use std::iter::zip;

/// Rows of rays in a packet.
pub(super) const ROWS: usize = 8;

/// Rays in a packet.
pub(super) const RAYS: usize = ROWS * LANES;

/// 64 rays from one eye: directions `[x, y, 1]` in its frame.
#[derive(Clone, Debug)]
#[repr(align(32))]
pub(super) struct Packet {
    pub x: [Lanes; ROWS],
    pub y: [Lanes; ROWS],
    /// z of the nearest hit, or up to where hits count; nothing is nearer than 0.
    pub nearest: [Lanes; ROWS],
    /// Place of the triangle that was hit: leaf times eight, plus lane; [`Packet::NOTHING`].
    pub hit: [[u32; LANES]; ROWS],
    /// Middle and half the width of the rays of each row.
    pub x_middle: Lanes,
    pub x_half: Lanes,
    pub y_middle: Lanes,
    pub y_half: Lanes,
    /// Greatest of `nearest` of each row.
    pub farthest: Lanes,
    /// Least and greatest x and y of all rays.
    pub x_range: [f32; 2],
    pub y_range: [f32; 2],
}

/// More than the rounding of `x * a + y * b + c`, relative to its terms.
pub(super) const ROUNDING: f32 = 1e-6;

impl Packet {
    /// No triangle was hit.
    pub const NOTHING: u32 = u32::MAX;

    /// A packet of rays of no length.
    pub fn new() -> Self {
        Self {
            x: [[0.0; LANES]; ROWS],
            y: [[0.0; LANES]; ROWS],
            nearest: [[0.0; LANES]; ROWS],
            hit: [[Self::NOTHING; LANES]; ROWS],
            x_middle: [0.0; LANES],
            x_half: [0.0; LANES],
            y_middle: [0.0; LANES],
            y_half: [0.0; LANES],
            farthest: [0.0; LANES],
            x_range: [0.0; 2],
            y_range: [0.0; 2],
        }
    }

    /// Makes the packet ready for its rays, which the caller wrote to `x`, `y` and `nearest`: NaN
    /// where there is none. False if there is none at all.
    #[inline(always)]
    pub fn settle(&mut self) -> bool {
        self.hit = [[Self::NOTHING; LANES]; ROWS];
        let exists = |(x, y): (&f32, &f32)| x.is_finite() & y.is_finite();
        let all = (0..ROWS)
            .all(|row| zip(&self.x[row], &self.y[row]).fold(true, |all, ray| all & exists(ray)));
        all || self.stand_in()
    }

    /// Puts rays that are not there beside one that is, and lets no hit of them count. False if
    /// there is none at all.
    fn stand_in(&mut self) -> bool {
        let finite = |(x, y): &(f32, f32)| x.is_finite() && y.is_finite();
        let (xs, ys) = (self.x.as_flattened_mut(), self.y.as_flattened_mut());
        let ray = zip(&*xs, &*ys).map(|(x, y)| (*x, *y)).find(finite);
        let Some((some_x, some_y)) = ray else { return false };
        for ((x, y), nearest) in zip(xs, ys).zip(self.nearest.as_flattened_mut()) {
            if !finite(&(*x, *y)) {
                (*x, *y, *nearest) = (some_x, some_y, 0.0);
            }
        }
        true
    }

    /// Sets what is known of all rays together.
    #[inline(always)]
    pub fn bound(&mut self) {
        self.x_range = range(&self.x);
        self.y_range = range(&self.y);
        let mut farthest = [0; LANES];
        for row in &self.nearest {
            farthest = std::array::from_fn(|lane| row[lane].to_bits().max(farthest[lane]));
        }
        self.farthest = [greatest(&farthest.map(f32::from_bits)); ROWS];
    }

    /// Sets what is known of the rays of each row, which only packets near a triangle need.
    #[inline(always)]
    pub fn bound_rows(&mut self) {
        for row in 0..ROWS {
            let (x, y) = (range(&[self.x[row]]), range(&[self.y[row]]));
            (self.x_middle[row], self.x_half[row]) = middle_and_half(x);
            (self.y_middle[row], self.y_half[row]) = middle_and_half(y);
            self.farthest[row] = greatest(&self.nearest[row]);
        }
    }
}

/// Least and greatest.
#[inline(always)]
fn range<const COUNT: usize>(rows: &[Lanes; COUNT]) -> [f32; 2] {
    let (mut low, mut high) = (rows[0], rows[0]);
    for row in rows {
        for lane in 0..LANES {
            low[lane] = if row[lane] < low[lane] { row[lane] } else { low[lane] };
            high[lane] = if row[lane] > high[lane] { row[lane] } else { high[lane] };
        }
    }
    // Halves against each other, so that few comparisons wait for others.
    for half in [4, 2, 1] {
        for lane in 0..half {
            let (l, h) = (low[lane + half], high[lane + half]);
            low[lane] = if l < low[lane] { l } else { low[lane] };
            high[lane] = if h > high[lane] { h } else { high[lane] };
        }
    }
    [low[0], high[0]]
}

/// The half width is a hair more than it is, so that what is found to be outside is.
#[inline(always)]
pub(super) fn middle_and_half([low, high]: [f32; 2]) -> (f32, f32) {
    let middle = 0.5 * (low + high);
    let half = 0.5 * (high - low);
    (middle, half + ROUNDING * (middle.abs() + half))
}

/// The greatest of numbers that are not negative, which order like their bits; the order of these
/// comparisons is free, so that they are made side by side.
#[inline(always)]
pub(super) fn greatest(lanes: &Lanes) -> f32 {
    f32::from_bits(lanes.iter().fold(0, |greatest, value| value.to_bits().max(greatest)))
}
