//! The triangles of a leaf against the rays of a packet.
//!
//! A ray from the eye through a triangle is on the same side of the three planes through the eye
//! and an edge. What the planes of its edges say of a ray is also how much of each corner there is
//! in what it hits (Plücker coordinates with the eye as origin). Two triangles with a common edge
//! get the same plane but for its sign, to the last bit: no ray passes between them.

use super::bvh::{LANES, Lanes, Leaf};
use super::eye::Eye;
use super::packet::{Packet, ROUNDING, ROWS, greatest, middle_and_half};

/// The triangles of a leaf as seen from an eye.
pub(super) struct Seen {
    /// `planes[edge][axis][lane]`: normals of the planes through the eye and the edge opposite to
    /// each corner, in the eye's frame.
    planes: [[Lanes; 3]; 3],
    /// z of each corner.
    z: [Lanes; 3],
    /// Least z of the corners.
    nearest: Lanes,
    /// Whether some ray of the packet may hit.
    keep: [bool; LANES],
}

#[inline(always)]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

impl Seen {
    #[inline(always)]
    pub fn new(leaf: &Leaf, eye: &Eye, packet: &Packet, farthest: f32) -> Self {
        let [o0, o1, o2] = eye.origin;
        let [r0, r1, r2] = eye.rotation;
        let (x_middle, x_half) = middle_and_half(packet.x_range);
        let (y_middle, y_half) = middle_and_half(packet.y_range);
        let mut seen = Self {
            planes: [[[0.0; LANES]; 3]; 3],
            z: [[0.0; LANES]; 3],
            nearest: [0.0; LANES],
            keep: [false; LANES],
        };
        for lane in 0..LANES {
            let mut corners = [[0.0_f32; 3]; 3];
            for corner in 0..3 {
                let [x, y, z] = &leaf.corners[corner];
                let (x, y, z) = (x[lane] - o0, y[lane] - o1, z[lane] - o2);
                corners[corner] = [
                    r0[0] * x + r0[1] * y + r0[2] * z,
                    r1[0] * x + r1[1] * y + r1[2] * z,
                    r2[0] * x + r2[1] * y + r2[2] * z,
                ];
                seen.z[corner][lane] = corners[corner][2];
            }
            // Least of the greatest and greatest of the least that the planes say of any ray.
            let (mut inside, mut outside) = (f32::INFINITY, f32::NEG_INFINITY);
            for edge in 0..3 {
                let (a, b) = (corners[(edge + 1) % 3], corners[(edge + 2) % 3]);
                let (d, s) = (
                    [a[0] - b[0], a[1] - b[1], a[2] - b[2]],
                    [a[0] + b[0], a[1] + b[1], a[2] + b[2]],
                );
                let n = [
                    d[1] * s[2] - d[2] * s[1],
                    d[2] * s[0] - d[0] * s[2],
                    d[0] * s[1] - d[1] * s[0],
                ];
                for axis in 0..3 {
                    seen.planes[edge][axis][lane] = n[axis];
                }
                let middle = x_middle * n[0] + y_middle * n[1] + n[2];
                let half = x_half * n[0].abs() + y_half * n[1].abs() + ROUNDING * n[2].abs();
                inside = min(inside, middle + half);
                outside = max(outside, middle - half);
            }
            let near = min(min(corners[0][2], corners[1][2]), corners[2][2]);
            let far = max(max(corners[0][2], corners[1][2]), corners[2][2]);
            seen.nearest[lane] = near;
            seen.keep[lane] =
                ((inside >= 0.0) | (outside <= 0.0)) & (near < farthest) & (far > 0.0);
        }
        seen
    }

    /// Notes in `packet` what is hit of this leaf, whose first triangle has the place `first`.
    /// With `ANY`, a ray that hits something is done.
    #[inline(always)]
    pub fn hit<const ANY: bool>(&self, packet: &mut Packet, first: u32) {
        for lane in set(self.keep) {
            let planes: [[f32; 3]; 3] =
                std::array::from_fn(|e| std::array::from_fn(|axis| self.planes[e][axis][lane]));
            let z: [f32; 3] = std::array::from_fn(|corner| self.z[corner][lane]);
            for row in set(rows(packet, &planes, self.nearest[lane])) {
                hit_row::<ANY>(packet, row, &planes, &z, first + lane as u32);
            }
        }
    }
}

/// The lanes that are true, without a branch for those that are not.
#[inline(always)]
fn set(lanes: [bool; LANES]) -> impl Iterator<Item = usize> {
    let mut bytes = u64::from_le_bytes(lanes.map(u8::from));
    std::iter::from_fn(move || {
        let lane = bytes.trailing_zeros() as usize / 8;
        bytes &= bytes.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    })
}

/// Rows of which some ray may hit.
#[inline(always)]
fn rows(packet: &Packet, planes: &[[f32; 3]; 3], nearest: f32) -> [bool; ROWS] {
    let mut rows = [false; ROWS];
    for row in 0..ROWS {
        let (x, y) = (packet.x_middle[row], packet.y_middle[row]);
        let (x_half, y_half) = (packet.x_half[row], packet.y_half[row]);
        let (mut inside, mut outside) = (f32::INFINITY, f32::NEG_INFINITY);
        for n in planes {
            let middle = x * n[0] + y * n[1] + n[2];
            let half = x_half * n[0].abs() + y_half * n[1].abs() + ROUNDING * n[2].abs();
            inside = min(inside, middle + half);
            outside = max(outside, middle - half);
        }
        rows[row] = ((inside >= 0.0) | (outside <= 0.0)) & (nearest < packet.farthest[row]);
    }
    rows
}

#[inline(always)]
fn hit_row<const ANY: bool>(
    packet: &mut Packet,
    row: usize,
    planes: &[[f32; 3]; 3],
    z: &[f32; 3],
    place: u32,
) {
    let (x, y) = (packet.x[row], packet.y[row]);
    let (before, mut after, mut hit) = (packet.nearest[row], [0.0; LANES], packet.hit[row]);
    let [a, b, c] = planes;
    for lane in 0..LANES {
        let u = x[lane] * a[0] + y[lane] * a[1] + a[2];
        let v = x[lane] * b[0] + y[lane] * b[1] + b[2];
        let w = x[lane] * c[0] + y[lane] * c[1] + c[2];
        let inside = (min(min(u, v), w) >= 0.0) | (max(max(u, v), w) <= 0.0);
        // The hit is a mean of the corners, and so never before or beyond them.
        let at = (u * z[0] + v * z[1] + w * z[2]) / (u + v + w);
        let nearer = inside & (at > 0.0) & (at < before[lane]);
        let found = if ANY { 0.0 } else { at };
        after[lane] = if nearer { found } else { before[lane] };
        hit[lane] = if nearer { place } else { hit[lane] };
    }
    packet.nearest[row] = after;
    packet.hit[row] = hit;
    packet.farthest[row] = greatest(&after);
}
