//! Nearest neighbours.

use nalgebra::Point3;

/// Points in a tree that is split at medians, without pointers: a node is the middle of its range.
#[derive(Clone, Debug)]
pub struct KdTree {
    points: Vec<Point3<f32>>,
}

impl KdTree {
    /// Of these points; those with a number that is not finite are left out.
    pub fn new(mut points: Vec<Point3<f32>>) -> Self {
        points.retain(|point| point.iter().all(|value| value.is_finite()));
        split(&mut points, 0);
        Self { points }
    }

    /// The point nearest to `to`, and the square of its distance, if that is below `limit_m` squared.
    pub fn nearest(&self, to: &Point3<f32>, limit_m: f32) -> Option<(Point3<f32>, f32)> {
        let mut best = (None, limit_m * limit_m);
        visit(&self.points, 0, to, &mut best);
        best.0.map(|point| (point, best.1))
    }
}

fn split(points: &mut [Point3<f32>], axis: usize) {
    if points.len() < 2 {
        return;
    }
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
    let (before, after) = points.split_at_mut(middle);
    split(before, (axis + 1) % 3);
    split(&mut after[1..], (axis + 1) % 3);
}

fn visit(
    points: &[Point3<f32>],
    axis: usize,
    to: &Point3<f32>,
    best: &mut (Option<Point3<f32>>, f32),
) {
    if points.is_empty() {
        return;
    }
    let middle = points.len() / 2;
    let here = points[middle];
    let apart = (here - to).norm_squared();
    if apart < best.1 {
        *best = (Some(here), apart);
    }
    let off = to[axis] - here[axis];
    let (before, after) = (&points[..middle], &points[middle + 1..]);
    let (near, far) = if off < 0.0 { (before, after) } else { (after, before) };
    visit(near, (axis + 1) % 3, to, best);
    if off * off < best.1 {
        visit(far, (axis + 1) % 3, to, best);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_nearest_is_that_of_all(
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f32), 0..200),
            to in prop::array::uniform3(-1.5..1.5_f32), limit in 0.0..2.0_f32,
        ) {
            let points: Vec<_> = points.into_iter().map(Point3::from).collect();
            let to = Point3::from(to);
            let distances = points.iter().map(|point| (point - to).norm_squared());
            let nearest = distances.min_by(f32::total_cmp).filter(|it| *it < limit * limit);
            let found = KdTree::new(points.clone()).nearest(&to, limit);
            prop_assert_eq!(found.map(|(_, apart)| apart), nearest);
            if let Some((point, apart)) = found {
                prop_assert_eq!((point - to).norm_squared(), apart);
            }
        }
    }
}
