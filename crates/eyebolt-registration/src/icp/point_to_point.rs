//! The paper's refinement, to measure against.

use super::kd_tree::KdTree;
use eyebolt_geometry::{Correspondence, rigid_fit};
use nalgebra::{Isometry3, Point3};

/// As Open3D's defaults, with the paper's limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointToPointOptions {
    /// Points farther apart are no pair, metres.
    pub limit_m: f32,
    /// Iterations at most.
    pub most_iterations: usize,
    /// Ends when both the share of paired points and their root mean square distance change by less than
    /// this part.
    pub relative: f64,
}

impl Default for PointToPointOptions {
    fn default() -> Self {
        Self { limit_m: 0.1, most_iterations: 30, relative: 1e-6 }
    }
}

/// What a fit comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointToPoint {
    /// The motion that takes the source to the target.
    pub target_from_source: Isometry3<f64>,
    /// Share of the source's points that have a partner.
    pub fitness: f64,
    /// Root mean square distance of the pairs, metres.
    pub inlier_rmse_m: f64,
    /// Iterations done.
    pub iterations: usize,
}

/// Iterated closest points (Besl and McKay, PAMI 14, 1992): each point of `source` with the nearest of
/// `target`, all with the same weight.
pub fn point_to_point(
    source: &[Point3<f32>],
    target: &KdTree,
    start: &Isometry3<f64>,
    options: &PointToPointOptions,
) -> PointToPoint {
    let mut found = PointToPoint {
        target_from_source: *start,
        fitness: 0.0,
        inlier_rmse_m: 0.0,
        iterations: 0,
    };
    let mut pairs = Vec::with_capacity(source.len());
    let mut last: Option<(f64, f64)> = None;
    loop {
        pairs.clear();
        let pose = found.target_from_source.cast::<f32>();
        let mut sum = 0.0;
        for point in source {
            let Some((to, apart)) = target.nearest(&(pose * point), options.limit_m) else {
                continue;
            };
            sum += f64::from(apart);
            pairs.push(Correspondence { from: point.cast(), to: to.cast(), weight: 1.0 });
        }
        found.fitness = pairs.len() as f64 / source.len().max(1) as f64;
        found.inlier_rmse_m = (sum / pairs.len().max(1) as f64).sqrt();
        let near = |a: f64, b: f64| (a - b).abs() < options.relative;
        let settled = last.is_some_and(|(fitness, rmse)| {
            near(fitness, found.fitness) && near(rmse, found.inlier_rmse_m)
        });
        if settled || found.iterations >= options.most_iterations {
            return found;
        }
        last = Some((found.fitness, found.inlier_rmse_m));
        let Some(fit) = rigid_fit(&pairs) else { return found };
        found.target_from_source = fit;
        found.iterations += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// A cloud and itself moved by less than half the distance of its points.
    #[test]
    fn a_moved_cloud_is_moved_back() {
        let at = |n: usize| {
            let n = n as f32;
            Point3::new((0.7 * n).sin() * 0.2, (1.3 * n).cos() * 0.15, (0.37 * n).sin() * 0.1)
        };
        let source: Vec<Point3<f32>> = (0..400).map(at).collect();
        let motion =
            Isometry3::new(Vector3::new(0.004, -0.003, 0.002), Vector3::new(0.01, 0.0, -0.02));
        let target = source.iter().map(|point| motion.cast::<f32>() * point).collect();
        let options = PointToPointOptions::default();
        let found = point_to_point(&source, &KdTree::new(target), &Isometry3::identity(), &options);
        let off = found.target_from_source.inverse() * motion;
        assert!(off.translation.vector.norm() < 1e-5 && off.rotation.angle() < 1e-4, "{off}");
        assert!(found.fitness == 1.0 && found.inlier_rmse_m < 1e-5);
    }
}
