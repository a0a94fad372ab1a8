//! How an end-effector is turned, by what a network learned of it.

use super::view::{EndEffectorView, VIEW_FEATURES};
use eyebolt_net::models::{Architecture, Model};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix};
use eyebolt_registration::spread_rotations;
use nalgebra::{Matrix4, Quaternion, SMatrix, SVector, UnitQuaternion};

/// Names of the outputs of networks that regress a quaternion, as in the paper.
pub const QUATERNION: [&str; 4] = ["x", "y", "z", "w"];
/// A mode takes the cells within this angle of its highest, radians: three standard deviations of what the
/// network is taught.
const MODE_RAD: f64 = 0.6;
/// Its peak is found by the cells within this angle, radians.
const FIT_RAD: f64 = 0.9;
/// Modes that are told, and the least probability of one beside the first.
const MOST_MODES: usize = 5;
const LEAST_PROBABILITY: f64 = 0.05;

/// One way in which an end-effector may be turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationMode {
    /// The rotation of `camera_from_end_effector`.
    pub camera_from_end_effector: UnitQuaternion<f64>,
    /// How likely it is, by the network.
    pub probability: f64,
}

/// Why there is no rotation.
#[derive(Debug, thiserror::Error)]
pub enum PoseNetError {
    /// Of the network.
    #[error(transparent)]
    Net(#[from] eyebolt_net::Error),
    /// The network is for something else.
    #[error(
        "model.toml: {field}: {problem}. Name a model of this end-effector that eyebolt train made"
    )]
    OtherModel {
        /// The field.
        field: &'static str,
        /// What is wrong with it.
        problem: String,
    },
}

/// A network that tells rotations.
#[derive(Debug)]
pub struct RotationNet {
    model: Model,
    executor: Cpu,
    decoder: Decoder,
}

/// What the outputs of a network mean.
#[derive(Clone, Debug)]
pub enum Decoder {
    /// A quaternion.
    Quaternion,
    /// Probabilities of rotations spread over SO(3), view from end-effector.
    Grid(Vec<UnitQuaternion<f64>>),
}

impl Decoder {
    /// Of a network with so many outputs.
    pub fn of(outputs: usize) -> Self {
        match outputs {
            4 => Self::Quaternion,
            _ => Self::Grid(spread_rotations(outputs, 0)),
        }
    }

    /// Rotations `view_from_end_effector` of one row of outputs, likeliest first.
    pub fn modes(&self, outputs: &[f32]) -> Vec<(UnitQuaternion<f64>, f64)> {
        match self {
            Self::Quaternion => {
                let [x, y, z, w] = [0, 1, 2, 3].map(|at| f64::from(outputs[at]));
                vec![(UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)), 1.0)]
            }
            Self::Grid(rotations) => modes(rotations, outputs),
        }
    }
}

fn modes(rotations: &[UnitQuaternion<f64>], logits: &[f32]) -> Vec<(UnitQuaternion<f64>, f64)> {
    let largest = logits.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let weights: Vec<f64> = logits.iter().map(|logit| f64::from(logit - largest).exp()).collect();
    let total: f64 = weights.iter().sum();
    let mut left: Vec<usize> = (0..weights.len()).collect();
    let mut found = Vec::new();
    while found.len() < MOST_MODES {
        let highest =
            left.iter().max_by(|a, b| weights[**a].total_cmp(&weights[**b]).then(b.cmp(a)));
        let Some(&top) = highest else { break };
        let near = |at: &usize| rotations[*at].angle_to(&rotations[top]) < MODE_RAD;
        let (of_mode, others): (Vec<usize>, Vec<usize>) = left.into_iter().partition(near);
        left = others;
        let probability = of_mode.iter().map(|at| weights[*at]).sum::<f64>() / total;
        let around =
            (0..weights.len()).filter(|at| rotations[*at].angle_to(&rotations[top]) < FIT_RAD);
        let around: Vec<_> = around.map(|at| (rotations[at], weights[at])).collect();
        let peak = peak(&around).filter(|peak| peak.angle_to(&rotations[top]) < MODE_RAD);
        found.push((peak.unwrap_or(rotations[top]), probability));
    }
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    let first = found.first().copied();
    let likely =
        found.into_iter().skip(1).filter(|(_, probability)| *probability >= LEAST_PROBABILITY);
    first.into_iter().chain(likely).collect()
}

/// Where a Bingham distribution peaks that has these densities: their logarithms are a quadratic form of the
/// quaternion, found by least squares weighted by the densities; its largest eigenvector is the peak.
///
/// Targets are of this form exactly, as the cosine of an angle between rotations is one; a mean over the cells of a
/// coarse grid would be drawn to where they lie denser.
fn peak(cells: &[(UnitQuaternion<f64>, f64)]) -> Option<UnitQuaternion<f64>> {
    const LEAST_WEIGHT: f64 = 1e-12;
    let mut normal = SMatrix::<f64, 10, 10>::identity() * 1e-9;
    let mut right = SVector::<f64, 10>::zeros();
    for (cell, weight) in cells.iter().filter(|(_, weight)| *weight > LEAST_WEIGHT) {
        let q = cell.coords;
        let form = PAIRS.map(|(i, j)| q[i] * q[j]);
        let form = SVector::<f64, 10>::from(form);
        normal += *weight * form * form.transpose();
        right += *weight * weight.ln() * form;
    }
    let found = normal.cholesky()?.solve(&right);
    let mut form = Matrix4::zeros();
    for ((i, j), value) in PAIRS.into_iter().zip(found.iter()) {
        form[(i, j)] += 0.5 * value;
        form[(j, i)] += 0.5 * value;
    }
    let eigen = form.symmetric_eigen();
    let vector = eigen.eigenvectors.column(eigen.eigenvalues.imax());
    let [x, y, z, w] = [0, 1, 2, 3].map(|axis| vector[axis]);
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9)
}

/// Products of a quadratic form of four numbers.
const PAIRS: [(usize, usize); 10] =
    [(0, 0), (1, 1), (2, 2), (3, 3), (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];

impl RotationNet {
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
        if !matches!(about.architecture, Architecture::MinkunetRegression(_)) {
            let problem = "the network tells no rotation".into();
            return Err(PoseNetError::OtherModel { field: "architecture", problem });
        }
        let decoder = Decoder::of(about.classes.len());
        Ok(Self { model, executor: Cpu::new(), decoder })
    }

    /// How what is seen in `view` may be turned, likeliest first.
    ///
    /// # Errors
    ///
    /// No memory.
    pub fn rotations(&mut self, view: &EndEffectorView) -> Result<Vec<RotationMode>, PoseNetError> {
        let Model { graph, parameters, .. } = &self.model;
        let batch = view_batch(graph, &[view])?;
        let outputs = self.executor.infer(graph, parameters, &batch)?;
        let camera_from_view = view.camera_from_view.rotation();
        let mode = |(rotation, probability)| RotationMode {
            camera_from_end_effector: camera_from_view * rotation,
            probability,
        };
        Ok(self.decoder.modes(outputs[0].row(0)).into_iter().map(mode).collect())
    }
}

/// Views as a network takes them.
pub fn view_batch(graph: &Graph, views: &[&EndEffectorView]) -> Result<Batch, eyebolt_net::Error> {
    let values: Vec<f32> = views.iter().flat_map(|view| &view.features).copied().collect();
    let rows = views.iter().map(|view| view.cells.len()).sum();
    let cells: Vec<&[[u32; 2]]> = views.iter().map(|view| view.cells.as_slice()).collect();
    Batch::from_images(graph, &cells, &Matrix::new(rows, VIEW_FEATURES.len(), values)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_between_cells_is_found_there_and_its_twin_second() {
        let grid = spread_rotations(1152, 0);
        let right = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.9);
        let twin = right * UnitQuaternion::from_euler_angles(0.0, 0.0, std::f64::consts::PI);
        let peak = |cell: &UnitQuaternion<f64>, of: &UnitQuaternion<f64>| {
            30.0 * (cell.angle_to(of).cos() - 1.0)
        };
        let logits: Vec<f32> = grid
            .iter()
            .map(|cell| ((peak(cell, &right)).exp() + 0.5 * peak(cell, &twin).exp()).ln() as f32)
            .collect();
        let found = Decoder::of(1152).modes(&logits);
        assert_eq!(found.len(), 2);
        assert!(
            found[0].0.angle_to(&right).to_degrees() < 1.0,
            "{:?}",
            found[0].0.angle_to(&right).to_degrees()
        );
        assert!(found[1].0.angle_to(&twin).to_degrees() < 1.0);
        assert!((found[0].1 / found[1].1 - 2.0).abs() < 0.6, "{found:?}");
    }
}
