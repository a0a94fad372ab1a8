//! Building the tree: splits by the surface area heuristic, eight boxes to a node.

use super::bounds::{Bounds, Corners};
use super::bvh::{Bvh, Child, LANES, Leaf, Node};
use super::split::{Part, split};

/// The tree over `corners`, all of which are finite.
pub(super) fn build(corners: &[Corners]) -> Bvh {
    let boxes: Vec<Bounds> = corners.iter().map(Bounds::of_triangle).collect();
    let mut order: Vec<u32> = (0..corners.len() as u32).collect();
    let mut builder = Builder { corners, boxes: &boxes, bvh: Bvh::default() };
    if let Some(part) = Part::new(&boxes, &mut order) {
        builder.node(part);
    }
    builder.bvh
}

struct Builder<'a> {
    corners: &'a [Corners],
    boxes: &'a [Bounds],
    bvh: Bvh,
}

impl Builder<'_> {
    /// Adds a node with what is in `part`, and all below it.
    fn node(&mut self, part: Part<'_>) -> Child {
        let at = self.bvh.nodes.len();
        self.bvh.nodes.push(Node::EMPTY);
        for (lane, part) in self.parts(part).into_iter().enumerate() {
            let (low, high) = (part.bounds.low, part.bounds.high);
            let child =
                if part.order.len() <= LANES { self.leaf(part.order) } else { self.node(part) };
            let node = &mut self.bvh.nodes[at];
            for axis in 0..3 {
                node.bounds[axis][lane] = low[axis];
                node.bounds[axis + 3][lane] = high[axis];
            }
            node.children[lane] = child;
        }
        Child::node(at)
    }

    /// `part` in up to eight: always the one with the largest surface is split next.
    fn parts<'p>(&self, part: Part<'p>) -> Vec<Part<'p>> {
        let mut parts = vec![part];
        while parts.len() < LANES {
            let area = |part: &Part<'_>| part.bounds.half_area();
            let candidates = (0..parts.len()).filter(|i| parts[*i].order.len() > LANES);
            let widest = candidates.max_by(|i, j| area(&parts[*i]).total_cmp(&area(&parts[*j])));
            let Some(widest) = widest else { break };
            let [near, far] = split(self.boxes, parts.swap_remove(widest));
            parts.extend([near, far]);
        }
        parts
    }

    fn leaf(&mut self, order: &[u32]) -> Child {
        let mut leaf = Leaf::EMPTY;
        let mut triangles = [0; LANES];
        for (lane, triangle) in order.iter().enumerate() {
            triangles[lane] = *triangle;
            for (corner, point) in self.corners[*triangle as usize].iter().enumerate() {
                for axis in 0..3 {
                    leaf.corners[corner][axis][lane] = point[axis];
                }
            }
        }
        let at = self.bvh.leaves.len();
        self.bvh.leaves.push(leaf);
        self.bvh.triangles.push(triangles);
        Child::leaf(at)
    }
}
