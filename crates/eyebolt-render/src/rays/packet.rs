//! Rays that go much the same way, as one piece of work.

use super::bvh::{LANES, Lanes};

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
const ROUNDING: f32 = 1e-6;

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

    /// Fills the packet with the rays `[x, y, z up to where hits count]` that `ray` gives for row
    /// and lane; `None` where there is none. False if there is none at all.
    #[inline(always)]
    pub fn fill(&mut self, ray: impl Fn(usize, usize) -> Option<[f32; 3]>) -> bool {
        let mut some = None;
        for row in 0..ROWS {
            for lane in 0..LANES {
                let ray = ray(row, lane);
                some = some.or(ray);
                // A ray that is not there goes beside one that is, and no hit counts.
                let [x, y, z] = ray.unwrap_or([f32::NAN, f32::NAN, 0.0]);
                (self.x[row][lane], self.y[row][lane], self.nearest[row][lane]) = (x, y, z);
            }
        }
        let Some([x, y, _]) = some else { return false };
        for row in 0..ROWS {
            for lane in 0..LANES {
                if self.x[row][lane].is_nan() {
                    (self.x[row][lane], self.y[row][lane]) = (x, y);
                }
            }
        }
        self.hit = [[Self::NOTHING; LANES]; ROWS];
        self.bound();
        true
    }

    #[inline(always)]
    fn bound(&mut self) {
        let mut whole = [[f32::INFINITY, f32::NEG_INFINITY]; 2];
        for row in 0..ROWS {
            let x = range(&self.x[row]);
            let y = range(&self.y[row]);
            (self.x_middle[row], self.x_half[row]) = middle_and_half(x);
            (self.y_middle[row], self.y_half[row]) = middle_and_half(y);
            for (whole, row) in whole.iter_mut().zip([x, y]) {
                *whole = [whole[0].min(row[0]), whole[1].max(row[1])];
            }
            self.farthest[row] = range(&self.nearest[row])[1];
        }
        [self.x_range, self.y_range] = whole;
    }
}

#[inline(always)]
fn range(lanes: &Lanes) -> [f32; 2] {
    let (mut low, mut high) = (lanes[0], lanes[0]);
    for value in lanes {
        low = if *value < low { *value } else { low };
        high = if *value > high { *value } else { high };
    }
    [low, high]
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
