//! Learning where the keypoints of an end-effector are.

use super::error::TrainError;
use super::hand::{Hand, HandView, HeldOut};
use super::lesson::Lesson;
use crate::pose::{KEYPOINT_OUTPUTS, VIEW_FEATURES, keypoints_of, view_batch};
use eyebolt_net::losses::{Loss, laplace};
use eyebolt_net::models::{Architecture, MinkUNet, ModelDescription};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix, Parameters};
use nalgebra::Point3;
use std::collections::BTreeMap;

/// Networks by which every point of an end-effector votes for where its keypoints are.
pub struct KeypointLesson {
    /// Whose.
    pub hand: Hand,
    /// Views of a step.
    pub views: u64,
    /// Views of a validation.
    pub validation: u64,
    /// Said of the model.
    pub trained_on: String,
    held_out: HeldOut,
    net: MinkUNet,
    graph: Graph,
    /// Which keypoint each looks like after turns that cannot be seen, the identity first.
    permutations: Vec<Vec<usize>>,
}

/// Where keypoints may be in a batch.
pub struct KeypointTarget {
    /// Of each item: its rows, and for every permutation the offsets of the keypoints from each row, in halves
    /// of the view.
    items: Vec<(usize, Vec<Matrix>)>,
}

const LEARN: u64 = 5;
const VALIDATE: u64 = 6;
/// A keypoint counts as found if the votes say it is known this well, metres.
const FOUND_M: f64 = 0.012;

impl KeypointLesson {
    /// By a network with four outputs for each keypoint of the end-effector.
    ///
    /// # Errors
    ///
    /// The network is none.
    pub fn new(hand: Hand, net: MinkUNet) -> Result<Self, TrainError> {
        let graph = net.graph()?;
        let mut permutations = hand.end_effector.keypoint_permutations();
        permutations.dedup();
        let (views, validation, trained_on) = (12, 128, String::new());
        let held_out = HeldOut::default();
        Ok(Self { hand, views, validation, trained_on, held_out, net, graph, permutations })
    }

    /// Outputs of a network for `hand`.
    pub fn outputs(hand: &Hand) -> usize {
        hand.end_effector.fixed_keypoints().len() * KEYPOINT_OUTPUTS.len()
    }

    /// The keypoints in the view's frame, metres.
    fn truth(&self, view: &HandView) -> Vec<Point3<f64>> {
        let keypoints = self.hand.end_effector.keypoints(&view.joints);
        keypoints.iter().map(|point| view.view_from_end_effector.point(point)).collect()
    }

    fn offsets(&self, view: &HandView) -> Result<Vec<Matrix>, TrainError> {
        let (truth, seen) = (self.truth(view), &view.view);
        let of = |permutation: &Vec<usize>| {
            let row = |point: &[f32; 3]| {
                let offset = |keypoint: &usize| {
                    let at: [f32; 3] = truth[*keypoint].cast::<f32>().into();
                    [0, 1, 2].map(|axis| (at[axis] - point[axis]) / seen.half_m)
                };
                permutation.iter().flat_map(offset).collect::<Vec<f32>>()
            };
            let values = seen.points_m.iter().flat_map(row).collect();
            Ok(Matrix::new(seen.points_m.len(), 3 * truth.len(), values)?)
        };
        self.permutations.iter().map(of).collect()
    }
}

impl Lesson for KeypointLesson {
    type Target = KeypointTarget;

    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn description(&self) -> ModelDescription {
        let keypoints = 0..self.hand.end_effector.fixed_keypoints().len();
        let names =
            keypoints.flat_map(|at| KEYPOINT_OUTPUTS.map(|what| format!("keypoint_{at}_{what}")));
        ModelDescription {
            voxel_m: None,
            image_columns: Some(crate::pose::CELLS as u32),
            features: VIEW_FEATURES.map(str::to_owned).to_vec(),
            classes: names.collect(),
            frame: "view of the end-effector".into(),
            trained_on: self.trained_on.clone(),
            commit: String::new(),
            metrics: BTreeMap::new(),
            architecture: Architecture::Minkunet(self.net.clone()),
        }
    }

    fn batch(&self, step: u64) -> Result<(Batch, KeypointTarget), TrainError> {
        let views =
            (0..self.views).map(|view| self.hand.view(LEARN, step * self.views + view, false));
        let views = views.collect::<Result<Vec<_>, _>>()?;
        let item = |view: &HandView| Ok((view.view.cells.len(), self.offsets(view)?));
        let items = views.iter().map(item).collect::<Result<_, TrainError>>()?;
        let images: Vec<_> = views.iter().map(|view| &view.view).collect();
        Ok((view_batch(&self.graph, &images)?, KeypointTarget { items }))
    }

    /// Of each item, that permutation counts which the votes are nearest to.
    fn loss(
        &self,
        outputs: &[Matrix],
        target: &KeypointTarget,
    ) -> Result<Vec<Loss>, eyebolt_net::Error> {
        let (channels, count) = (outputs[0].channels(), target.items.len() as f64);
        let mut gradient = Matrix::zeros(outputs[0].rows(), channels);
        let (mut start, mut value) = (0, 0.0);
        for (rows, permutations) in &target.items {
            let range = start * channels..(start + rows) * channels;
            let part = Matrix::new(*rows, channels, outputs[0].values()[range.clone()].to_vec())?;
            let losses = permutations.iter().map(|offsets| laplace(&part, offsets, 3));
            let losses = losses.collect::<Result<Vec<_>, _>>()?;
            let best = losses.iter().min_by(|a, b| a.value.total_cmp(&b.value));
            let Some(best) = best else { continue };
            value += best.value / count;
            let to = gradient.values_mut()[range].iter_mut().zip(best.gradient.values());
            to.for_each(|(to, slope)| *to = slope / count as f32);
            start += rows;
        }
        Ok(vec![Loss { value, gradient }])
    }

    fn validate(
        &self,
        parameters: &Parameters,
        executor: &mut Cpu,
    ) -> Result<(BTreeMap<String, f64>, f64), TrainError> {
        let held_out = self.held_out.views(&self.hand, VALIDATE, self.validation)?;
        let mut scores = BTreeMap::new();
        let mut value = 0.0;
        for (name, true_labels) in [("true_labels", true), ("found_labels", false)] {
            let (mut distances, mut four) = (Vec::new(), 0_u64);
            for view in held_out[usize::from(!true_labels)].iter() {
                let batch = view_batch(&self.graph, &[&view.view])?;
                let outputs = executor.infer(&self.graph, parameters, &batch)?;
                let rows: Vec<&[f32]> =
                    (0..outputs[0].rows()).map(|row| outputs[0].row(row)).collect();
                let found = keypoints_of(&view.view, &rows);
                let truth = self.truth(view);
                let view_from_camera = view.view.camera_from_view.inverse();
                let off = |permutation: &Vec<usize>| {
                    let pairs = found.iter().zip(permutation);
                    let off = pairs.map(|(found, of)| {
                        let at = view_from_camera.point(&found.point_in_camera);
                        (at - truth[*of]).norm()
                    });
                    off.collect::<Vec<f64>>()
                };
                let all = self.permutations.iter().map(off);
                let least = all.min_by(|a, b| a.iter().sum::<f64>().total_cmp(&b.iter().sum()));
                distances.extend(least.unwrap_or_default());
                let known = found.iter().filter(|found| found.sigma_m < FOUND_M).count();
                four += u64::from(known >= 4);
            }
            distances.sort_by(f64::total_cmp);
            let mean = distances.iter().sum::<f64>() / distances.len().max(1) as f64;
            scores.insert(format!("{name}_mean_mm"), 1e3 * mean);
            scores.insert(format!("{name}_median_mm"), 1e3 * distances[distances.len() / 2]);
            scores.insert(format!("{name}_four_found_share"), four as f64 / self.validation as f64);
            value -= 1e3 * mean;
        }
        Ok((scores, value))
    }
}
