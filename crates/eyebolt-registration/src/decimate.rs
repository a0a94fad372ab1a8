//! Fewer triangles for drawing, by collapsing edges where the surface hardly changes (Garland and
//! Heckbert, *Surface Simplification Using Quadric Error Metrics*, SIGGRAPH 1997).

mod constraints;
mod quadric;
mod surface;
#[cfg(test)]
mod tests;
mod weld;

use constraints::Constraints;
use eyebolt_robot::TriangleMesh;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use surface::Surface;

/// `mesh` with as few triangles as edge collapses leave while no vertex is farther than
/// `tolerance_m` (root mean square over the area that it stands for) or twice that (at most) from
/// the planes that were there. Closed meshes keep their volume.
///
/// Any soup of triangles will do. Vertices at the same place become one, triangles without area
/// and all but the first on the same corners go; open rims and seams of parts stay where they are
/// within the tolerance. The same mesh gives the same bytes.
pub(crate) fn simplified(mesh: &TriangleMesh, tolerance_m: f32) -> TriangleMesh {
    let mut surface = Surface::of(mesh);
    let mut constraints = Constraints::of(&surface, f64::from(tolerance_m));
    let mut stamps = vec![0; surface.points.len()];
    let edges = surface.edges();
    let planned = |[u, v]: [u32; 2]| Collapse::planned(&surface, &constraints, &stamps, u, v);
    let mut queue: BinaryHeap<Collapse> = edges.into_iter().filter_map(planned).collect();
    while let Some(Collapse { ends: [kept, gone], stamps: then, .. }) = queue.pop() {
        if [stamps[kept as usize], stamps[gone as usize]] != then {
            continue;
        }
        // What a neighbour forbids now is tried again only once an end has moved: trying all
        // again at the end finds one collapse in a thousand.
        let Some((target, _)) = constraints.best_target(&surface, [kept, gone]) else { continue };
        if !constraints.keep_near(kept, gone, &target)
            || !surface.stays_sound(kept, gone, constraints.both_on_rims(kept, gone), &target)
        {
            continue;
        }
        surface.collapse(kept, gone, target);
        constraints.merge(kept, gone);
        stamps[kept as usize] += 1;
        stamps[gone as usize] += 1;
        for other in surface.ring(kept) {
            queue.extend(Collapse::planned(&surface, &constraints, &stamps, kept, other));
        }
    }
    surface.into_mesh()
}

/// Cost per metre of length. On a flat face all errors are rounding: the lowest vertex would eat
/// the others one by one and get thousands of neighbours, each asked again every time.
const LENGTH_SHARE: f64 = 1e-4;

/// An edge that may become a point. Where is worked out again at its turn: most never have one,
/// and the queue is the slowest part the larger its entries are.
struct Collapse {
    /// The error and a little of the length, metres: the queue takes the lowest first.
    cost_m: f64,
    /// The vertex that stays, the lower one, and the vertex that goes.
    ends: [u32; 2],
    /// How often each end had changed when this was worked out: if more since, it is void.
    stamps: [u32; 2],
}

impl Collapse {
    /// The collapse of the edge between `u` and `v`, if it stays within the tolerance.
    fn planned(
        surface: &Surface,
        constraints: &Constraints,
        stamps: &[u32],
        u: u32,
        v: u32,
    ) -> Option<Self> {
        let ends = [u.min(v), u.max(v)];
        let (_, error_m) = constraints.best_target(surface, ends)?;
        let [start, end] = ends.map(|end| surface.points[end as usize]);
        let cost_m = error_m + LENGTH_SHARE * (end - start).norm();
        Some(Self { cost_m, ends, stamps: ends.map(|end| stamps[end as usize]) })
    }
}

impl Ord for Collapse {
    /// The greatest leaves a heap first: that of the least cost, then of the lowest ends.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_cost = other.cost_m.total_cmp(&self.cost_m);
        by_cost.then(other.ends.cmp(&self.ends)).then(other.stamps.cmp(&self.stamps))
    }
}

impl PartialOrd for Collapse {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Collapse {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Collapse {}
