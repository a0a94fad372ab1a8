//! What a ray hits, by trying every triangle in double precision (Moeller and Trumbore, 1997).

use nalgebra::{Point3, Vector3};

/// A triangle in double precision.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    pub corners: [Vector3<f64>; 3],
    pub surface: u16,
    pub index: u32,
}

/// The triangles whose corners are finite; the others are never hit.
pub fn facets(meshes: &[Vec<[Vector3<f32>; 3]>]) -> Vec<Facet> {
    let of_mesh = |(mesh, surface): (&Vec<[Vector3<f32>; 3]>, u16)| {
        let facet = move |(corners, index): (&[Vector3<f32>; 3], u32)| Facet {
            corners: corners.map(|c| c.cast()),
            surface,
            index,
        };
        let finite = |f: &Facet| f.corners.iter().flatten().all(|v| v.is_finite());
        mesh.iter().zip(0..).map(facet).filter(finite).collect::<Vec<_>>()
    };
    meshes.iter().zip(0..).flat_map(of_mesh).collect()
}

/// Where a ray meets a triangle, as far as single precision can tell.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    /// How far the ray is inside all edges; negative: outside of one.
    margin: f64,
    /// Rays nearer to an edge than this may be taken to be on its other side.
    doubt: f64,
    /// Multiples of the direction: where it is, and least and greatest that it may be taken for.
    pub t: [f64; 3],
}

impl Meeting {
    pub fn certain(&self) -> bool {
        self.margin > self.doubt && self.t[1] > 0.0
    }

    pub fn possible(&self) -> bool {
        self.margin >= -self.doubt && self.t[2] > 0.0
    }
}

/// A few times the rounding of a single-precision coordinate, relative to the size of the scene.
const ROUNDING: f64 = 3e-6;

/// `size`: how far from the eye anything is.
pub fn meet(facet: &Facet, origin: &Point3<f64>, direction: &Vector3<f64>, size: f64) -> Meeting {
    let length = direction.norm();
    let ray = direction / length;
    let [a, b, c] = facet.corners.map(|corner| corner - origin.coords);
    let normal = (b - a).cross(&(c - a));
    let facing = ray.dot(&normal);
    let doubt = ROUNDING * size;
    let edges = [(a, b), (b, c), (c, a)];
    // Distance of the ray's line from the edge's, times the sine of the angle between them.
    let beside = |(p, q): (Vector3<f64>, Vector3<f64>)| {
        let edge = (q - p).norm();
        if edge > 0.0 { facing.signum() * ray.dot(&p.cross(&(q - p))) / edge } else { 0.0 }
    };
    let margin = edges.into_iter().map(beside).fold(f64::INFINITY, f64::min);
    let along = [a, b, c].map(|corner| ray.dot(&corner));
    let near = along.into_iter().fold(f64::INFINITY, f64::min);
    let far = along.into_iter().fold(f64::NEG_INFINITY, f64::max);
    // A ray beside itself by the doubt meets a slanting triangle, or a sliver, so much nearer or
    // farther.
    let around: f64 = edges.iter().map(|(p, q)| (q - p).norm()).sum();
    let around = doubt * (1.0 + (far - near) * around / facing.abs());
    let t = a.dot(&normal) / facing;
    let [least, most] = [(t - around).max(near - doubt), (t + around).min(far + doubt)];
    let known = least <= most;
    let t = if known { [t, least, most] } else { [near, near - doubt, far + doubt] };
    Meeting { margin, doubt, t: t.map(|t| t / length) }
}

/// Why `seen`, multiple of the direction and surface and triangle, cannot be what is hit first.
pub fn wrong(
    facets: &[Facet],
    (origin, direction): (&Point3<f64>, &Vector3<f64>),
    size: f64,
    seen: Option<(f64, u16, Option<u32>)>,
) -> Option<String> {
    let meetings = facets.iter().map(|facet| (facet, meet(facet, origin, direction, size)));
    let first = meetings
        .clone()
        .filter(|(_, meeting)| meeting.certain())
        .min_by(|(_, a), (_, b)| a.t[2].total_cmp(&b.t[2]));
    let Some((t, surface, index)) = seen else {
        return first.map(|(facet, meeting)| format!("missed {facet:?}: {meeting:?}"));
    };
    if let Some((facet, meeting)) = first.filter(|(_, meeting)| meeting.t[2] < t) {
        return Some(format!("{t}, but nearer is {facet:?}: {meeting:?}"));
    }
    let is_it = |facet: &Facet| facet.surface == surface && index.is_none_or(|i| i == facet.index);
    let mut candidates = meetings.filter(|(facet, _)| is_it(facet));
    let explains = |meeting: &Meeting| meeting.possible() && meeting.t[1] <= t && t <= meeting.t[2];
    let found = candidates.clone().any(|(_, meeting)| explains(&meeting));
    (!found).then(|| format!("{t} on {surface} {index:?} is not there: {:?}", candidates.next()))
}
