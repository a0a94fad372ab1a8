//! A packet of rays through the tree, nearest boxes first.

use super::bvh::{Bvh, Child, LANES, Lanes, Node};
use super::eye::Eye;
use super::packet::{Packet, greatest};
use super::triangles::Seen;

/// What is still to be visited: a box and how near it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Todo {
    near: f32,
    child: Child,
}

/// A plane: `normal . p + offset` of a point in the scene.
struct Plane {
    normal: [f32; 3],
    offset: f32,
    /// Which of the bounds of a box to take for the corner farthest along the normal.
    corner: [usize; 3],
}

/// What rays of a packet can reach.
struct Frustum {
    /// Everything that rays can hit is at or above 0 of these.
    sides: [Plane; 5],
    /// Minus z.
    depth: Plane,
}

/// More than all rounding between a triangle and its box as seen from the eye, relative to how far
/// the farthest point of the scene may be.
const ROUNDING: f32 = 4e-6;

impl Frustum {
    #[inline(always)]
    fn new(eye: &Eye, packet: &Packet) -> Self {
        let [x0, x1] = packet.x_range;
        let [y0, y1] = packet.y_range;
        let plane = |normal| Plane::new(eye, normal);
        let sides = [
            plane([1.0, 0.0, -x0]),
            plane([-1.0, 0.0, x1]),
            plane([0.0, 1.0, -y0]),
            plane([0.0, -1.0, y1]),
            plane([0.0, 0.0, 1.0]),
        ];
        Self { sides, depth: plane([0.0, 0.0, -1.0]) }
    }

    /// How near each child of `node` is; infinite where no ray can hit it.
    #[inline(always)]
    fn near(&self, node: &Node) -> Lanes {
        let mut near = [0.0; LANES];
        for lane in 0..LANES {
            let mut inside = true;
            for side in &self.sides {
                inside &= side.farthest(node, lane) >= 0.0;
            }
            let depth = -self.depth.farthest(node, lane);
            near[lane] = if inside { depth } else { f32::INFINITY };
        }
        near
    }
}

impl Plane {
    /// The plane through the eye with a normal in its frame, moved a hair out.
    #[inline(always)]
    fn new(eye: &Eye, normal: [f32; 3]) -> Self {
        let [r0, r1, r2] = eye.rotation;
        let normal: [f32; 3] = std::array::from_fn(|axis| {
            normal[0] * r0[axis] + normal[1] * r1[axis] + normal[2] * r2[axis]
        });
        let [o0, o1, o2] = eye.origin;
        let along = normal[0] * o0 + normal[1] * o1 + normal[2] * o2;
        let size = 1.0 + o0.abs().max(o1.abs()).max(o2.abs());
        let steep = normal[0].abs() + normal[1].abs() + normal[2].abs();
        let corner = std::array::from_fn(|axis| axis + if normal[axis] < 0.0 { 0 } else { 3 });
        Self { normal, offset: ROUNDING * size * steep - along, corner }
    }

    /// The plane's value of the point of a child's box that is farthest along the normal.
    #[inline(always)]
    fn farthest(&self, node: &Node, lane: usize) -> f32 {
        let [x, y, z] = self.corner;
        let [a, b, c] = self.normal;
        a * node.bounds[x][lane] + b * node.bounds[y][lane] + c * node.bounds[z][lane] + self.offset
    }
}

/// Finds what the rays of `packet` hit nearest; with `ANY`, whether they hit something.
pub(super) fn cast<const ANY: bool>(
    bvh: &Bvh,
    eye: &Eye,
    packet: &mut Packet,
    stack: &mut Vec<Todo>,
) {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has what the function was compiled for.
        #[allow(unsafe_code)]
        unsafe {
            cast_avx2::<ANY>(bvh, eye, packet, stack);
        }
        return;
    }
    cast_here::<ANY>(bvh, eye, packet, stack);
}

/// The same, to the same bits, in registers of eight numbers; without fused multiplication, which
/// rounds otherwise.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn cast_avx2<const ANY: bool>(bvh: &Bvh, eye: &Eye, packet: &mut Packet, stack: &mut Vec<Todo>) {
    cast_here::<ANY>(bvh, eye, packet, stack);
}

#[inline(always)]
fn cast_here<const ANY: bool>(bvh: &Bvh, eye: &Eye, packet: &mut Packet, stack: &mut Vec<Todo>) {
    if bvh.nodes.is_empty() {
        return;
    }
    packet.bound();
    let frustum = Frustum::new(eye, packet);
    let mut farthest = greatest(&packet.farthest);
    let mut rows_bounded = false;
    stack.clear();
    stack.push(Todo { near: f32::NEG_INFINITY, child: Child::node(0) });
    while let Some(Todo { near, child }) = stack.pop() {
        if near >= farthest {
            continue;
        }
        match child.index() {
            Ok(index) => push_children(&bvh.nodes[index], &frustum, farthest, stack),
            Err(index) => {
                if !rows_bounded {
                    packet.bound_rows();
                    rows_bounded = true;
                }
                let seen = Seen::new(&bvh.leaves[index], eye, packet, farthest);
                seen.hit::<ANY>(packet, (index * LANES) as u32);
                farthest = greatest(&packet.farthest);
            }
        }
    }
}

/// Puts the children that rays can reach on the stack, the nearest on top.
#[inline(always)]
fn push_children(node: &Node, frustum: &Frustum, farthest: f32, stack: &mut Vec<Todo>) {
    let near = frustum.near(node);
    let first = stack.len();
    for lane in 0..LANES {
        if near[lane] < farthest {
            let todo = Todo { near: near[lane], child: node.children[lane] };
            stack.push(todo);
            let mut at = stack.len() - 1;
            while at > first && stack[at - 1].near < todo.near {
                stack.swap(at, at - 1);
                at -= 1;
            }
        }
    }
}

#[cfg(test)]
mod tests;
