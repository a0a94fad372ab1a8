//! Learning which point of an end-effector is which.

use super::error::TrainError;
use super::hand::{Hand, HandView, HeldOut};
use super::lesson::Lesson;
use crate::pose::{
    CELLS, PARTS, POINT_OUTPUTS, VIEW_FEATURES, keypoint_outputs, matched_pose, view_batch,
    view_edge_m,
};
use eyebolt_geometry::{EndEffector, Link, Transform};
use eyebolt_net::losses::{Loss, cross_entropy, laplace};
use eyebolt_net::models::{Architecture, MinkUNet, ModelDescription};
use eyebolt_net::sampling::farthest_points;
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix, Parameters};
use eyebolt_robot::JointPositions;
use nalgebra::{Isometry3, Point3};
use std::collections::BTreeMap;

/// Networks that say of every point of an end-effector which one it is.
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
    /// Turns of the end-effector that cannot be seen, the identity first.
    twins: Vec<Isometry3<f64>>,
    /// Middles of the parts that are told apart, end-effector frame, metres.
    parts: Vec<Point3<f32>>,
}

/// What each cell shows, for every item and turn that cannot be seen.
pub struct KeypointTarget {
    items: Vec<(usize, Vec<Matched>)>,
}

/// What the cells of an item show.
struct Matched {
    /// Of each cell, its part.
    parts: Vec<u32>,
    /// Of each cell, its point, in halves of the view.
    points: Matrix,
}

const LEARN: u64 = 5;
const VALIDATE: u64 = 6;
/// Points of the surface among which the middles of parts are chosen.
const SURFACE: usize = 4000;
/// The label of no part; there is none.
const IGNORE: u32 = u32::MAX;

/// How far the keypoints and the pose of a view are off.
struct Off {
    keypoints_mm: Vec<f64>,
    rotation_deg: f64,
    translation_mm: f64,
}

impl KeypointLesson {
    /// By a network with four outputs.
    ///
    /// # Errors
    ///
    /// The network is none.
    pub fn new(hand: Hand, net: MinkUNet) -> Result<Self, TrainError> {
        let graph = net.graph()?;
        let turns = hand.end_effector.symmetry().turns();
        let twins = std::iter::once(Isometry3::identity()).chain(turns).collect();
        let (views, validation, trained_on) = (16, 128, String::new());
        let held_out = HeldOut::default();
        let surface = hand.end_effector.points(&JointPositions::default(), SURFACE);
        let surface: Vec<[f32; 3]> =
            surface.iter().map(|point| point.cast::<f32>().into()).collect();
        let chosen = farthest_points(&surface, PARTS).into_iter();
        let parts = chosen.map(|at| Point3::from(surface[at as usize])).collect();
        Ok(Self { hand, views, validation, trained_on, held_out, net, graph, twins, parts })
    }

    /// What each cell shows, for every turn that cannot be seen.
    fn matches(&self, view: &HandView) -> Result<Vec<Matched>, TrainError> {
        let end_effector_from_view = view.view_from_end_effector.inverse();
        let half_m = view.view.half_m;
        let of = |twin: &Isometry3<f64>| {
            let turned = (twin.inverse() * end_effector_from_view.isometry()).cast::<f32>();
            let at = view.view.points_m.iter().map(|point| turned * Point3::from(*point));
            let at: Vec<Point3<f32>> = at.collect();
            let values = at.iter().flat_map(|at| [at.x / half_m, at.y / half_m, at.z / half_m]);
            let points = Matrix::new(at.len(), 3, values.collect())?;
            let parts = at.iter().map(|at| self.part(at)).collect();
            Ok(Matched { parts, points })
        };
        self.twins.iter().map(of).collect()
    }

    /// The part that a point of the end-effector is of.
    fn part(&self, at: &Point3<f32>) -> u32 {
        let distances = self.parts.iter().map(|middle| (middle - at).norm_squared());
        let nearest = distances.zip(0..).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or(IGNORE, |(_, part)| part)
    }

    /// How far `found` is off, by the turn that cannot be seen which is nearest; of no pose, as far as the
    /// end-effector is large.
    fn off(&self, view: &HandView, found: Option<Transform<Link, EndEffector>>) -> Off {
        let keypoints = self.hand.end_effector.keypoints(&view.joints);
        let Some(found) = found else {
            let far = 1e3 * self.hand.extent_m;
            let keypoints_mm = vec![far; keypoints.len()];
            return Off { keypoints_mm, rotation_deg: 180.0, translation_mm: far };
        };
        let of = |twin: &Isometry3<f64>| {
            let truth = Transform::from_isometry(view.view_from_end_effector.isometry() * twin);
            let off = |point| 1e3 * (found.point(point) - truth.point(point)).norm();
            let (metres, radians) = found.distance_to(&truth);
            Off {
                keypoints_mm: keypoints.iter().map(off).collect(),
                rotation_deg: radians.to_degrees(),
                translation_mm: 1e3 * metres,
            }
        };
        let sum = |off: &Off| off.keypoints_mm.iter().sum::<f64>();
        let nearest = self.twins.iter().map(of).min_by(|a, b| sum(a).total_cmp(&sum(b)));
        nearest.expect("the identity is among the turns")
    }
}

impl Lesson for KeypointLesson {
    type Target = KeypointTarget;

    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn description(&self) -> ModelDescription {
        ModelDescription {
            voxel_m: None,
            image_columns: Some(CELLS as u32),
            window_m: Some(view_edge_m(self.hand.extent_m) as f32),
            features: VIEW_FEATURES.map(str::to_owned).to_vec(),
            classes: keypoint_outputs(),
            frame: "view of the end-effector".into(),
            trained_on: self.trained_on.clone(),
            commit: String::new(),
            metrics: BTreeMap::new(),
            architecture: Architecture::Minkunet(self.net.clone()),
        }
    }

    fn batch(&self, step: u64) -> Result<(Batch, KeypointTarget), TrainError> {
        let views = self.hand.views(LEARN, step, self.views)?;
        let item = |view: &HandView| Ok((view.view.cells.len(), self.matches(view)?));
        let items = views.iter().map(item).collect::<Result<_, TrainError>>()?;
        let images: Vec<_> = views.iter().map(|view| &view.view).collect();
        Ok((view_batch(&self.graph, &images)?, KeypointTarget { items }))
    }

    /// Of each item, that turn counts which the network is nearest to.
    fn loss(
        &self,
        outputs: &[Matrix],
        target: &KeypointTarget,
    ) -> Result<Vec<Loss>, eyebolt_net::Error> {
        let (channels, count) = (outputs[0].channels(), target.items.len() as f64);
        let mut gradient = Matrix::zeros(outputs[0].rows(), channels);
        let (mut start, mut value) = (0, 0.0);
        for (rows, twins) in &target.items {
            let range = start * channels..(start + rows) * channels;
            let part = &outputs[0].values()[range.clone()];
            let losses = twins.iter().map(|matched| loss_of(part, channels, matched));
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
        /// A keypoint nearer than this to its place is found (the paper's threshold), millimetres.
        const FOUND_MM: f64 = 30.0;
        let held_out = self.held_out.views(&self.hand, VALIDATE, self.validation)?;
        let mut scores = BTreeMap::new();
        let mut value = 0.0;
        for (name, views) in ["true_labels", "found_labels"].into_iter().zip(held_out) {
            let mut offs = Vec::new();
            for view in views {
                let batch = view_batch(&self.graph, &[&view.view])?;
                let outputs = executor.infer(&self.graph, parameters, &batch)?;
                let rows = (0..outputs[0].rows()).map(|row| outputs[0].row(row));
                let found = matched_pose(&view.view, &rows.collect::<Vec<_>>());
                offs.push(self.off(view, found.map(|(pose, _)| pose)));
            }
            let keypoints: Vec<f64> =
                offs.iter().flat_map(|off| off.keypoints_mm.clone()).collect();
            let four = offs
                .iter()
                .filter(|off| off.keypoints_mm.iter().filter(|mm| **mm < FOUND_MM).count() >= 4);
            let four = four.count() as f64 / offs.len() as f64;
            let rotations: Vec<f64> = offs.iter().map(|off| off.rotation_deg).collect();
            let translations: Vec<f64> = offs.iter().map(|off| off.translation_mm).collect();
            for (what, values) in [
                ("keypoints_mm", &keypoints),
                ("rotation_deg", &rotations),
                ("translation_mm", &translations),
            ] {
                let (mean, median) = mean_and_median(values);
                scores.insert(format!("{name}_mean_{what}"), mean);
                scores.insert(format!("{name}_median_{what}"), median);
            }
            scores.insert(format!("{name}_four_found_share"), four);
            value -= mean_and_median(&keypoints).0;
        }
        Ok((scores, value))
    }
}

/// The loss of some rows of outputs: cross-entropy of the parts, likelihood of the points.
fn loss_of(values: &[f32], channels: usize, matched: &Matched) -> Result<Loss, eyebolt_net::Error> {
    let rows = values.len() / channels;
    let columns = |from: usize, to: usize| {
        let values = values.chunks_exact(channels).flat_map(|row| &row[from..to]).copied();
        Matrix::new(rows, to - from, values.collect())
    };
    let parts = cross_entropy(&columns(0, PARTS)?, &matched.parts, IGNORE, None)?;
    let points = laplace(&columns(PARTS, PARTS + POINT_OUTPUTS.len())?, &matched.points, 3)?;
    let row = |row: usize| parts.gradient.row(row).iter().chain(points.gradient.row(row)).copied();
    let gradient = Matrix::new(rows, channels, (0..rows).flat_map(row).collect())?;
    Ok(Loss { value: parts.value + points.value, gradient })
}

/// Mean and median of values, of which there is one.
pub fn mean_and_median(values: &[f64]) -> (f64, f64) {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN);
    (sorted.iter().sum::<f64>() / sorted.len().max(1) as f64, median)
}
