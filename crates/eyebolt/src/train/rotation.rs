//! Learning how an end-effector is turned.

use super::error::TrainError;
use super::hand::{Hand, HandView, HeldOut};
use super::keypoints::mean_and_median;
use super::lesson::Lesson;
use crate::pose::{Decoder, QUATERNION, VIEW_FEATURES, view_batch, view_edge_m};
use eyebolt_net::losses::{Loss, PoseLoss, pose_loss, soft_cross_entropy};
use eyebolt_net::models::{Architecture, MinkEncoder, ModelDescription};
use eyebolt_net::{Batch, Cpu, Executor, Graph, Matrix, Parameters};
use eyebolt_robot::JointPositions;
use nalgebra::UnitQuaternion;
use std::collections::BTreeMap;

/// Networks that tell how an end-effector is turned.
pub struct RotationLesson {
    /// Whose.
    pub hand: Hand,
    /// Views of a step.
    pub views: u64,
    /// Views of a validation.
    pub validation: u64,
    /// Said of the model.
    pub trained_on: String,
    held_out: HeldOut,
    net: MinkEncoder,
    graph: Graph,
    decoder: Decoder,
    /// Turns that cannot be seen, the identity first.
    twins: Vec<UnitQuaternion<f64>>,
    /// Points of the shape, end-effector frame, metres.
    points_m: Vec<[f32; 3]>,
}

const LEARN: u64 = 3;
const VALIDATE: u64 = 4;
/// Softness of targets: how fast they fall with the angle, so that some cells beside the nearest have a
/// share. At 12 degrees it is a half.
const CONCENTRATION: f64 = 32.0;
/// Points that the losses of the paper go over.
const POINTS: usize = 256;

impl RotationLesson {
    /// By a network whose last width says what it tells: 4 a quaternion with the paper's losses, else
    /// probabilities of so many rotations.
    ///
    /// # Errors
    ///
    /// The network is none.
    pub fn new(hand: Hand, net: MinkEncoder) -> Result<Self, TrainError> {
        let graph = net.graph()?;
        let decoder = Decoder::of(net.widths.last().copied().unwrap_or(0));
        let turns = hand.end_effector.symmetry().turns();
        let twins = std::iter::once(UnitQuaternion::identity())
            .chain(turns.into_iter().map(|turn| turn.rotation))
            .collect();
        let points = hand.end_effector.points(&JointPositions::default(), POINTS);
        let points_m = points.iter().map(|point| point.cast::<f32>().into()).collect();
        let (views, validation, trained_on) = (32, 128, String::new());
        let held_out = HeldOut::default();
        Ok(Self {
            hand,
            views,
            validation,
            trained_on,
            held_out,
            net,
            graph,
            decoder,
            twins,
            points_m,
        })
    }

    fn error_deg(&self, found: &UnitQuaternion<f64>, truth: &UnitQuaternion<f64>) -> f64 {
        let angles = self.twins.iter().map(|twin| found.angle_to(&(truth * twin)));
        angles.fold(f64::INFINITY, f64::min).to_degrees()
    }

    /// What a row of outputs should be.
    fn target(&self, view: &HandView) -> Vec<f32> {
        let truth = view.view_from_end_effector.rotation();
        match &self.decoder {
            Decoder::Quaternion => {
                let [x, y, z, w]: [f64; 4] = view.view_from_end_effector.rotation_xyzw();
                [x, y, z, w].map(|value| value as f32).to_vec()
            }
            Decoder::Grid(cells) => {
                let turned: Vec<_> = self.twins.iter().map(|twin| truth * twin).collect();
                let share = |cell: &UnitQuaternion<f64>| {
                    // The cosine of an angle is 2 (q p)^2 - 1.
                    let near = |turned: &UnitQuaternion<f64>| {
                        CONCENTRATION * 2.0 * (cell.coords.dot(&turned.coords).powi(2) - 1.0)
                    };
                    turned.iter().map(|turned| near(turned).exp()).sum::<f64>()
                };
                let shares: Vec<f64> = cells.iter().map(share).collect();
                let total: f64 = shares.iter().sum();
                shares.into_iter().map(|share| (share / total) as f32).collect()
            }
        }
    }
}

impl Lesson for RotationLesson {
    type Target = Matrix;

    fn graph(&self) -> &Graph {
        &self.graph
    }

    fn description(&self) -> ModelDescription {
        let classes = match &self.decoder {
            Decoder::Quaternion => QUATERNION.map(str::to_owned).to_vec(),
            Decoder::Grid(cells) => (0..cells.len()).map(|cell| cell.to_string()).collect(),
        };
        ModelDescription {
            voxel_m: None,
            image_columns: Some(crate::pose::CELLS as u32),
            window_m: Some(view_edge_m(self.hand.extent_m) as f32),
            features: VIEW_FEATURES.map(str::to_owned).to_vec(),
            classes,
            frame: "view of the end-effector".into(),
            trained_on: self.trained_on.clone(),
            commit: String::new(),
            metrics: BTreeMap::new(),
            architecture: Architecture::MinkunetRegression(self.net.clone()),
        }
    }

    fn batch(&self, step: u64) -> Result<(Batch, Matrix), TrainError> {
        let views = self.hand.views(LEARN, step, self.views)?;
        let targets: Vec<f32> = views.iter().flat_map(|view| self.target(view)).collect();
        let width = targets.len() / views.len().max(1);
        let images: Vec<_> = views.iter().map(|view| &view.view).collect();
        let batch = view_batch(&self.graph, &images)?;
        Ok((batch, Matrix::new(views.len(), width, targets)?))
    }

    fn loss(&self, outputs: &[Matrix], target: &Matrix) -> Result<Vec<Loss>, eyebolt_net::Error> {
        let loss = match &self.decoder {
            Decoder::Grid(_) => soft_cross_entropy(&outputs[0], target)?,
            Decoder::Quaternion => {
                let same = self.twins.len() < 2;
                let kind = if same { PoseLoss::SamePoint } else { PoseLoss::NearestPoint };
                let mut loss = pose_loss(kind, &outputs[0], target, &self.points_m)?;
                // In units of the shape, so that rates mean the same for large and small ones.
                let scale = (self.hand.extent_m).powi(-2);
                loss.value *= scale;
                loss.gradient.values_mut().iter_mut().for_each(|slope| *slope *= scale as f32);
                loss
            }
        };
        Ok(vec![loss])
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
            let (mut errors, mut best) = (Vec::new(), Vec::new());
            for view in held_out[usize::from(!true_labels)].iter() {
                let batch = view_batch(&self.graph, &[&view.view])?;
                let outputs = executor.infer(&self.graph, parameters, &batch)?;
                let truth = view.view_from_end_effector.rotation();
                let modes = self.decoder.modes(outputs[0].row(0));
                let off = modes.iter().map(|(mode, _)| self.error_deg(mode, &truth));
                best.push(off.fold(f64::INFINITY, f64::min));
                errors.push(self.error_deg(&modes[0].0, &truth));
            }
            let (mean, median) = mean_and_median(&errors);
            scores.insert(format!("{name}_mean_deg"), mean);
            scores.insert(format!("{name}_median_deg"), median);
            scores.insert(format!("{name}_best_mode_mean_deg"), mean_and_median(&best).0);
            value -= mean;
        }
        Ok((scores, value))
    }
}
