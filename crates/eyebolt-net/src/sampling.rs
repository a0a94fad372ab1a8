//! Choosing points and finding their neighbours, as PointNet++ does (Qi et al., NeurIPS 2017).

use crate::random::Random;
use rayon::prelude::*;

/// Coordinates apart, so that loops over points fill registers.
struct Axes {
    x: Vec<f32>,
    y: Vec<f32>,
    z: Vec<f32>,
}

impl Axes {
    fn new(points: &[[f32; 3]]) -> Self {
        let axis = |axis: usize| points.iter().map(|point| point[axis]).collect();
        Self { x: axis(0), y: axis(1), z: axis(2) }
    }

    /// Squared distance of a point from every one of these.
    fn distances(&self, [x, y, z]: [f32; 3], out: &mut Vec<f32>) {
        out.clear();
        out.extend(self.x.iter().zip(&self.y).zip(&self.z).map(|((a, b), c)| {
            let (a, b, c) = (a - x, b - y, c - z);
            a * a + b * b + c * c
        }));
    }
}

/// `count` points, each the farthest from those before it; the first is point 0. Of fewer points
/// than that some come again.
///
/// # Panics
/// If there are no points.
#[doc(alias = "FPS")]
#[doc(alias = "furthest_point_sample")]
pub fn farthest_points(points: &[[f32; 3]], count: usize) -> Vec<u32> {
    assert!(!points.is_empty(), "there must be a point to sample");
    let axes = Axes::new(points);
    let mut nearest = vec![f32::INFINITY; points.len()];
    let mut fresh = Vec::with_capacity(points.len());
    let mut chosen = Vec::with_capacity(count);
    let mut next = 0;
    for _ in 0..count {
        chosen.push(next as u32);
        axes.distances(points[next], &mut fresh);
        for (nearest, fresh) in nearest.iter_mut().zip(&fresh) {
            *nearest = if *fresh < *nearest { *fresh } else { *nearest };
        }
        next = place_of_largest(&nearest);
    }
    chosen
}

/// The first of the largest values, none of them NaN.
fn place_of_largest(values: &[f32]) -> usize {
    const LANES: usize = 16;
    let (chunks, rest) = values.as_chunks::<LANES>();
    let mut lanes = [f32::NEG_INFINITY; LANES];
    for chunk in chunks {
        for (lane, &value) in lanes.iter_mut().zip(chunk) {
            *lane = if value > *lane { value } else { *lane };
        }
    }
    let largest = lanes.iter().chain(rest).copied().fold(f32::NEG_INFINITY, f32::max);
    values.iter().position(|&value| value == largest).unwrap_or(0)
}

/// `count` different points without preference (Knuth's algorithm S of *The Art of Computer
/// Programming* 2, 3.4.2), in order. Of fewer points than that some come again.
///
/// # Panics
/// If there are no points.
pub fn uniform_points(points: usize, count: usize, seed: u64) -> Vec<u32> {
    uniform_points_by(Random::new(seed), points, count)
}

/// The same from a stream.
pub(crate) fn uniform_points_by(mut random: Random, points: usize, count: usize) -> Vec<u32> {
    assert!(points > 0, "there must be a point to sample");
    let mut chosen = Vec::with_capacity(count);
    for point in 0..points {
        let (left, wanted) = (points - point, count.saturating_sub(chosen.len()));
        if random.below(left) < wanted {
            chosen.push(point as u32);
        }
    }
    let found = chosen.len();
    (found..count).for_each(|place| chosen.push(chosen[place % found]));
    chosen
}

/// For each centre the first `count` points within `radius`, in order; of fewer the first is
/// repeated, and where there is none the nearest is taken.
///
/// # Panics
/// If there are no points.
#[doc(alias = "query_ball_point")]
pub fn ball_query(
    points: &[[f32; 3]],
    centres: &[[f32; 3]],
    radius: f32,
    count: usize,
) -> Vec<u32> {
    assert!(!points.is_empty(), "there must be a point to find");
    let axes = Axes::new(points);
    let limit = radius * radius;
    let groups: Vec<Vec<u32>> = centres
        .par_iter()
        .with_min_len(16)
        .map_init(Vec::new, |distances, &centre| {
            axes.distances(centre, distances);
            let inside = distances.iter().enumerate().filter(|(_, distance)| **distance <= limit);
            let mut group: Vec<u32> = inside.map(|(at, _)| at as u32).take(count).collect();
            let first = group.first().copied().unwrap_or_else(|| nearest::<1>(distances)[0]);
            group.resize(count, first);
            group
        })
        .collect();
    groups.concat()
}

/// For each target the three nearest sources and their weights, by inverse squared distance and
/// with sum 1; of fewer sources, those that there are, the others with weight 0.
///
/// # Panics
/// If there are no sources.
#[doc(alias = "three_nn")]
pub fn three_nearest(sources: &[[f32; 3]], targets: &[[f32; 3]]) -> Vec<([u32; 3], [f32; 3])> {
    assert!(!sources.is_empty(), "there must be a point to find");
    // As the published code: where a target is a source, that one has nearly all the weight.
    const SMALLEST: f32 = 1e-8;
    let axes = Axes::new(sources);
    targets
        .par_iter()
        .with_min_len(16)
        .map_init(Vec::new, |distances, &target| {
            axes.distances(target, distances);
            let found = nearest::<3>(distances);
            let mut weights = found.map(|at| 1.0 / (distances[at as usize] + SMALLEST));
            // What was not found is the first source, a second time.
            weights.iter_mut().skip(sources.len()).for_each(|weight| *weight = 0.0);
            let sum: f32 = weights.iter().sum();
            (found, weights.map(|weight| weight / sum))
        })
        .collect()
}

/// Places of the smallest distances, nearest first; of equals the first.
fn nearest<const N: usize>(distances: &[f32]) -> [u32; N] {
    let mut best = [(f32::INFINITY, 0_u32); N];
    for (at, &distance) in distances.iter().enumerate() {
        if distance >= best[N - 1].0 {
            continue;
        }
        best[N - 1] = (distance, at as u32);
        for place in (1..N).rev() {
            if best[place].0 < best[place - 1].0 {
                best.swap(place, place - 1);
            }
        }
    }
    best.map(|(_, at)| at)
}
