//! Where an end-effector is, by a network that matches its points.

use super::rotation_net::{PoseNetError, view_batch};
use super::view::{EndEffectorView, VIEW_FEATURES};
use eyebolt_geometry::{Camera, Correspondence, EndEffector, Link, Transform, rigid_fit};
use eyebolt_net::models::{Architecture, Model};
use eyebolt_net::{Cpu, Executor};
use nalgebra::Point3;

/// Parts of the surface that a network tells apart, the first of its outputs for each cell.
///
/// They are what it learns from: which part a point is of may be this or that, which a distribution can say
/// and a number cannot (fragments: Hodan, Barath and Matas, *EPOS*, CVPR 2020).
pub const PARTS: usize = 48;
/// Its other outputs for each cell: which point of the end-effector it shows, in the end-effector frame and
/// in halves of the view, and the logarithm of how far off that is.
pub const POINT_OUTPUTS: [&str; 4] = ["x", "y", "z", "log_scale"];

/// Names of all outputs.
pub fn keypoint_outputs() -> Vec<String> {
    let parts = (0..PARTS).map(|part| format!("part_{part}"));
    parts.chain(POINT_OUTPUTS.map(str::to_owned)).collect()
}

/// Steps of the robust fit.
const STEPS: usize = 10;
/// Fewer points that agree are no pose.
const FEWEST: usize = 12;

/// A pose, and how well the points agree with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchedPose {
    /// The pose.
    pub camera_from_end_effector: Transform<Camera, EndEffector>,
    /// Median distance of the points from where the pose has them, metres.
    pub residual_m: f64,
}

/// A network that says of every point of an end-effector which one it is. A rigid fit of all of them gives the
/// pose, and so the keypoints, seen or not.
///
/// The paper matches six keypoints (KPM); here every point is one. A hand seen from one side shows fewer
/// than four corners more often than not, but always hundreds of points.
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
        let matches = matches!(about.architecture, Architecture::Minkunet(_));
        if !matches || about.classes != keypoint_outputs() {
            let problem = "the network does not match points".into();
            return Err(PoseNetError::OtherModel { field: "classes", problem });
        }
        Ok(Self { model, executor: Cpu::new() })
    }

    /// The pose of what is seen in `view`; `None` if its points agree on none.
    ///
    /// # Errors
    ///
    /// No memory.
    pub fn pose(&mut self, view: &EndEffectorView) -> Result<Option<MatchedPose>, PoseNetError> {
        let Model { graph, parameters, .. } = &self.model;
        let batch = view_batch(graph, &[view])?;
        let outputs = self.executor.infer(graph, parameters, &batch)?;
        let rows: Vec<&[f32]> = (0..outputs[0].rows()).map(|row| outputs[0].row(row)).collect();
        Ok(matched_pose(view, &rows).map(|(view_from_end_effector, residual_m)| MatchedPose {
            camera_from_end_effector: view.camera_from_view * view_from_end_effector,
            residual_m,
        }))
    }
}

/// What a network said of a cell.
struct Match {
    /// The point of the end-effector that it shows, end-effector frame, metres.
    of: Point3<f64>,
    /// Where it is, the view's frame, metres.
    seen: Point3<f64>,
    /// Scale of a Laplace distribution about it, metres.
    scale_m: f64,
}

/// The pose `view_from_end_effector` that the cells of `view` agree on, by what the network said of each, and
/// the median distance from it, metres.
///
/// Least squares whose weights fall with what a point says of itself and with how far off it is: the
/// maximum likelihood under Laplace distributions.
pub fn matched_pose(
    view: &EndEffectorView,
    outputs: &[&[f32]],
) -> Option<(Transform<Link, EndEffector>, f64)> {
    let half_m = f64::from(view.half_m);
    let matched = |(point, row): (&[f32; 3], &&[f32])| {
        let row = &row[row.len().saturating_sub(POINT_OUTPUTS.len())..];
        let of = [0, 1, 2].map(|axis| half_m * f64::from(row[axis]));
        Match {
            of: Point3::from(of),
            seen: Point3::from(*point).cast::<f64>(),
            scale_m: (half_m * f64::from(row[3]).exp()).max(1e-3),
        }
    };
    let matches: Vec<Match> = view.points_m.iter().zip(outputs).map(matched).collect();
    if matches.len() < FEWEST {
        return None;
    }
    let fit_by = |weight: &dyn Fn(&Match) -> f64| {
        let pair = |of: &Match| Correspondence { from: of.of, to: of.seen, weight: weight(of) };
        rigid_fit(&matches.iter().map(pair).collect::<Vec<_>>())
    };
    let mut fit = fit_by(&|of| of.scale_m.powi(-2))?;
    for _ in 0..STEPS {
        let here = fit;
        fit = fit_by(&|of| {
            let off = (here * of.of - of.seen).norm();
            1.0 / (of.scale_m * of.scale_m * (1.0 + off / of.scale_m))
        })?;
    }
    let mut off: Vec<f64> = matches.iter().map(|of| (fit * of.of - of.seen).norm()).collect();
    let middle = off.len() / 2;
    let residual_m = *off.select_nth_unstable_by(middle, f64::total_cmp).1;
    Some((Transform::from_isometry(fit), residual_m))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Isometry3, Vector3};

    /// A third of the points are wrong and say that they are not sure.
    #[test]
    fn points_that_know_outweigh_those_that_do_not() {
        let right = Isometry3::new(Vector3::new(0.02, -0.01, 0.03), Vector3::new(0.5, 1.0, -2.0));
        let grid = |n: usize| {
            Point3::new((n % 20) as f64 * 0.01, (n / 20) as f64 * 0.01, (n % 7) as f64 * 0.004)
        };
        let points_m: Vec<[f32; 3]> =
            (0..300).map(|n| (right * grid(n)).cast::<f32>().into()).collect();
        let half_m = 0.16_f32;
        let row = |n: usize| -> [f32; 4] {
            let wrong = n.is_multiple_of(3);
            let p = if wrong { Point3::new(0.1, -0.1, 0.1) } else { grid(n) };
            let [x, y, z] = [0, 1, 2].map(|axis| p[axis] as f32 / half_m);
            [x, y, z, if wrong { 0.0 } else { -3.5 }]
        };
        let rows: Vec<[f32; 4]> = (0..300).map(row).collect();
        let rows: Vec<&[f32]> = rows.iter().map(<[f32; 4]>::as_slice).collect();
        let view = EndEffectorView {
            cells: vec![[0, 0]; 300],
            points_m,
            features: Vec::new(),
            camera_from_view: Transform::identity(),
            half_m,
        };
        let (pose, residual_m) = matched_pose(&view, &rows).unwrap();
        let (off_m, off) = pose.distance_to(&Transform::from_isometry(right));
        assert!(off_m < 1e-3 && off < 0.01, "{off_m} {off}");
        assert!(residual_m < 1e-3);
    }
}
