//! Where the keypoints of an end-effector are, by what a network learned of them.

use super::rotation_net::{PoseNetError, view_batch};
use super::view::{EndEffectorView, VIEW_FEATURES};
use eyebolt_net::models::{Architecture, Model};
use eyebolt_net::{Cpu, Executor};
use nalgebra::Point3;

/// Outputs for each keypoint: where it is from the cell on, x, y and z in halves of the view, and the
/// logarithm of how far off that is.
pub const OUTPUTS: [&str; 4] = ["x", "y", "z", "log_scale"];
/// Steps of the weighted median of the votes.
const STEPS: usize = 8;

/// Where a keypoint is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundKeypoint {
    /// Camera frame, metres.
    pub point_in_camera: Point3<f64>,
    /// Standard deviation along each axis by what the votes say of themselves, metres.
    pub sigma_m: f64,
}

/// A network by which every point of an end-effector votes for where each keypoint is, seen or not.
#[derive(Debug)]
pub struct KeypointNet {
    model: Model,
    executor: Cpu,
}

impl KeypointNet {
    /// Of a model.
    ///
    /// # Errors
    ///
    /// It is a model of something else.
    pub fn new(model: Model) -> Result<Self, PoseNetError> {
        let about = &model.description;
        if about.features != VIEW_FEATURES {
            let problem = format!("{:?} are not {VIEW_FEATURES:?}", about.features);
            return Err(PoseNetError::OtherModel { field: "features", problem });
        }
        let votes = matches!(about.architecture, Architecture::Minkunet(_));
        if !votes || !about.classes.len().is_multiple_of(OUTPUTS.len()) {
            let problem = "the network does not vote for keypoints".into();
            return Err(PoseNetError::OtherModel { field: "architecture", problem });
        }
        Ok(Self { model, executor: Cpu::new() })
    }

    /// How many keypoints it knows.
    pub fn count(&self) -> usize {
        self.model.description.classes.len() / OUTPUTS.len()
    }

    /// Where the keypoints are of what is seen in `view`, all of them, in their order.
    ///
    /// # Errors
    ///
    /// No memory.
    pub fn keypoints(
        &mut self,
        view: &EndEffectorView,
    ) -> Result<Vec<FoundKeypoint>, PoseNetError> {
        let Model { graph, parameters, .. } = &self.model;
        let batch = view_batch(graph, &[view])?;
        let outputs = self.executor.infer(graph, parameters, &batch)?;
        let rows: Vec<&[f32]> = (0..outputs[0].rows()).map(|row| outputs[0].row(row)).collect();
        Ok(keypoints_of(view, &rows))
    }
}

/// The keypoints that the votes of the cells of `view` agree on.
pub fn keypoints_of(view: &EndEffectorView, votes: &[&[f32]]) -> Vec<FoundKeypoint> {
    let count = votes.first().map_or(0, |row| row.len() / OUTPUTS.len());
    let half_m = f64::from(view.half_m);
    let keypoint = |index: usize| {
        let vote = |(point, row): (&[f32; 3], &&[f32])| {
            let of = &row[index * OUTPUTS.len()..][..OUTPUTS.len()];
            let at = [0, 1, 2].map(|axis| f64::from(point[axis]) + half_m * f64::from(of[axis]));
            let scale_m = half_m * f64::from(of[3]).exp();
            (Point3::from(at), scale_m.max(1e-4))
        };
        let votes: Vec<_> = view.points_m.iter().zip(votes).map(vote).collect();
        let at = weighted_median(&votes);
        // Votes of one image are not independent: what they say is not divided by their number.
        let best = votes.iter().map(|(_, scale)| *scale).fold(f64::INFINITY, f64::min);
        FoundKeypoint {
            point_in_camera: view.camera_from_view.point(&at),
            sigma_m: std::f64::consts::SQRT_2 * best,
        }
    };
    (0..count).map(keypoint).collect()
}

/// The point of least weighted sum of distances (Weiszfeld, 1937), which is what Laplace distributions
/// ask for.
fn weighted_median(votes: &[(Point3<f64>, f64)]) -> Point3<f64> {
    let mean = |weight: &dyn Fn(&(Point3<f64>, f64)) -> f64| {
        let (mut sum, mut total) = (nalgebra::Vector3::zeros(), 0.0);
        for vote in votes {
            let weight = weight(vote);
            sum += weight * vote.0.coords;
            total += weight;
        }
        Point3::from(sum / total.max(f64::MIN_POSITIVE))
    };
    let mut at = mean(&|(_, scale)| scale.powi(-2));
    for _ in 0..STEPS {
        let here = at;
        at = mean(&|(point, scale)| {
            let off = (point - here).norm();
            1.0 / (scale * scale * (1.0 + off / scale))
        });
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn certain_votes_outvote_many_wrong_ones() {
        let right = Point3::new(0.01, -0.02, 0.03);
        let mut votes = vec![(right, 0.002); 40];
        votes.extend(vec![(Point3::new(0.2, 0.2, 0.2), 0.1); 200]);
        assert!((weighted_median(&votes) - right).norm() < 1e-3);
    }
}
