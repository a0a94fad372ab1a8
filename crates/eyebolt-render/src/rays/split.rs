//! Where a set of boxes is cut in two.
//!
//! The surface area heuristic in bins (Wald, *On fast construction of SAH-based bounding volume
//! hierarchies*, 2007): of all planes between bins along all axes, the one with the least
//! `area * triangles` left plus right.

use super::bounds::Bounds;
use super::bvh::LANES;

/// Some of the boxes.
pub(super) struct Part<'a> {
    /// Around all of them.
    pub bounds: Bounds,
    /// Which ones.
    pub order: &'a mut [u32],
}

impl<'a> Part<'a> {
    /// The part of the boxes `order`, if there are any.
    pub fn new(boxes: &[Bounds], order: &'a mut [u32]) -> Option<Self> {
        let bounds = order.iter().map(|i| boxes[*i as usize]).reduce(Bounds::union)?;
        Some(Self { bounds, order })
    }
}

const BINS: usize = 16;

/// Middles of boxes along one axis in bins of equal width.
struct Binning {
    axis: usize,
    low: f32,
    bins_per_unit: f32,
}

impl Binning {
    /// `None` where all middles are in one place.
    fn new(middles: &Bounds, axis: usize) -> Option<Self> {
        let bins_per_unit = BINS as f32 / (middles.high[axis] - middles.low[axis]);
        let usable = bins_per_unit.is_finite();
        usable.then_some(Self { axis, low: middles.low[axis], bins_per_unit })
    }

    fn bin(&self, bounds: &Bounds) -> usize {
        let bin = (bounds.middle(self.axis) - self.low) * self.bins_per_unit;
        (bin as usize).min(BINS - 1)
    }
}

/// A part of at least two boxes in two, none of them empty.
pub(super) fn split<'a>(boxes: &[Bounds], part: Part<'a>) -> [Part<'a>; 2] {
    let order = part.order;
    let middle = |i: &u32| -> [f32; 3] { [0, 1, 2].map(|axis| boxes[*i as usize].middle(axis)) };
    let middles = order.iter().map(|i| Bounds { low: middle(i), high: middle(i) });
    let middles = middles.fold(Bounds::EMPTY, Bounds::union);
    let binnings = (0..3).filter_map(|axis| Binning::new(&middles, axis));
    let cuts = binnings.filter_map(|binning| {
        let (cost, bin) = best_cut(boxes, order, &binning)?;
        Some((cost, bin, binning))
    });
    let best = cuts.min_by(|a, b| a.0.total_cmp(&b.0));
    // Boxes that share one middle are as well split anywhere.
    let count = match best {
        Some((_, bin, binning)) => partition(order, |i| binning.bin(&boxes[i as usize]) < bin),
        None => order.len() / 2,
    };
    let (near, far) = order.split_at_mut(count);
    [near, far].map(|order| Part::new(boxes, order).expect("a cut leaves boxes on both sides"))
}

/// Cost of the best cut and the first bin beyond it; `None` if all boxes are in one bin.
fn best_cut(boxes: &[Bounds], order: &[u32], binning: &Binning) -> Option<(f32, usize)> {
    let mut bins = [(Bounds::EMPTY, 0_u32); BINS];
    for i in order {
        let bounds = boxes[*i as usize];
        let (around, count) = &mut bins[binning.bin(&bounds)];
        (*around, *count) = (around.union(bounds), *count + 1);
    }
    let join = |a: (Bounds, u32), b: (Bounds, u32)| (a.0.union(b.0), a.1 + b.1);
    let mut beyond = [(Bounds::EMPTY, 0_u32); BINS + 1];
    for bin in (0..BINS).rev() {
        beyond[bin] = join(beyond[bin + 1], bins[bin]);
    }
    let mut before = (Bounds::EMPTY, 0);
    let mut best: Option<(f32, usize)> = None;
    for bin in 1..BINS {
        before = join(before, bins[bin - 1]);
        if before.1 == 0 || beyond[bin].1 == 0 {
            continue;
        }
        let cost = cost(before) + cost(beyond[bin]);
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, bin));
        }
    }
    best
}

/// Leaves are tested whole, so that triangles count by the leaves they fill.
fn cost((bounds, count): (Bounds, u32)) -> f32 {
    bounds.half_area() * count.div_ceil(LANES as u32) as f32
}

/// Moves those that `first` holds for to the front; how many they are.
fn partition(order: &mut [u32], first: impl Fn(u32) -> bool) -> usize {
    let mut count = 0;
    for at in 0..order.len() {
        if first(order[at]) {
            order.swap(at, count);
            count += 1;
        }
    }
    count
}
