//! Fewer triangles for drawing, by collapsing edges where the surface hardly changes (Garland and
//! Heckbert, *Surface Simplification Using Quadric Error Metrics*, SIGGRAPH 1997).

mod constraints;
mod quadric;
mod surface;
#[cfg(test)]
mod tests;

use constraints::Constraints;
use eyebolt_robot::TriangleMesh;
use nalgebra::Point3;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;
use surface::Surface;

/// A sweep leaves out what a neighbour forbids at its turn; later sweeps find little more.
const SWEEPS: usize = 3;

/// `mesh` with as few triangles as edge collapses leave while no vertex is farther than
/// `tolerance_m` (root mean square over the area that it stands for) from the surface that was
/// there.
///
/// Any soup of triangles will do. Vertices at the same place become one, triangles without area
/// and all but the first on the same corners go; open rims and seams of parts stay where they are
/// within the tolerance. The same mesh gives the same bytes.
pub(crate) fn simplified(mesh: &TriangleMesh, tolerance_m: f32) -> TriangleMesh {
    let mut surface = Surface::welded(mesh);
    let mut constraints = Constraints::of(&surface, f64::from(tolerance_m));
    for _ in 0..SWEEPS {
        if sweep(&mut surface, &mut constraints) == 0 {
            break;
        }
    }
    surface.into_mesh()
}

/// Collapses edges, the least error first, until no edge may; how many there were.
fn sweep(surface: &mut Surface, constraints: &mut Constraints) -> usize {
    let mut stamps = vec![0; surface.points.len()];
    let mut queue = BinaryHeap::new();
    for [u, v] in surface.edges() {
        queue.extend(Collapse::between(surface, constraints, &stamps, u, v).map(Reverse));
    }
    let mut collapses = 0;
    while let Some(Reverse(collapse)) = queue.pop() {
        let Collapse { ends: [kept, gone], stamps: then, target, .. } = collapse;
        if [stamps[kept as usize], stamps[gone as usize]] != then {
            continue;
        }
        let rim = constraints.both_on_rims(kept, gone);
        let sound = surface.stays_sound(kept, gone, rim, &target);
        if !sound || !constraints.stay_near(kept, gone, &target) {
            continue;
        }
        surface.collapse(kept, gone, target);
        constraints.merge(kept, gone);
        stamps[kept as usize] += 1;
        stamps[gone as usize] += 1;
        collapses += 1;
        for neighbour in surface.ring(kept) {
            let next = Collapse::between(surface, constraints, &stamps, kept, neighbour);
            queue.extend(next.map(Reverse));
        }
    }
    collapses
}

/// An edge that may become a point.
struct Collapse {
    error_m: f64,
    /// The vertex that stays, the lower one, and the vertex that goes.
    ends: [u32; 2],
    /// How often each end had changed when this was worked out: if more since, it is void.
    stamps: [u32; 2],
    target: Point3<f64>,
}

impl Collapse {
    /// The collapse of the edge between `u` and `v`, if it stays within the tolerance.
    fn between(
        surface: &Surface,
        constraints: &Constraints,
        stamps: &[u32],
        u: u32,
        v: u32,
    ) -> Option<Self> {
        let ends = [u.min(v), u.max(v)];
        let points = ends.map(|end| surface.points[end as usize]);
        let (target, error_m) = constraints.best_target(ends, &points)?;
        Some(Self { error_m, ends, stamps: ends.map(|end| stamps[end as usize]), target })
    }
}

impl Ord for Collapse {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_error = self.error_m.total_cmp(&other.error_m);
        by_error.then(self.ends.cmp(&other.ends)).then(self.stamps.cmp(&other.stamps))
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
