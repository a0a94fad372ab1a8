//! Where the base is by the end-effectors of several configurations.

use super::consensus::{Candidate, Consensus, consensus};
use super::estimator::{PoseAnswer, PoseEstimator};
use super::global_search::GlobalSearch;
use super::proposer::{Hypothesis, PoseProposer};
use crate::label::{Labelling, class_of};
use crate::observations::{Configuration, Observations};
use crate::segment::{BACKGROUND, UNKNOWN};
use eyebolt_geometry::{Camera, EndEffector, Transform};
use eyebolt_registration::Labels;
use std::error::Error;
use std::sync::{Mutex, PoisonError};

/// The pose of the end-effector in each configuration, by networks, tells where the base is; that on which most
/// configurations agree is proposed. Grippers look alike from behind, but the wrong turn puts the base elsewhere in each.
///
/// Where few agree, the global search proposes, too.
#[derive(Debug)]
pub struct ByEndEffector {
    estimator: Mutex<PoseEstimator>,
    /// Proposes where few configurations agree.
    pub search: GlobalSearch,
}

/// Hypotheses of the end-effector.
const MOST: usize = 2;
/// So many configurations that agree, if they also are this share of all that say anything, need no search.
const ENOUGH: usize = 3;
const ENOUGH_SHARE: f64 = 0.5;

impl ByEndEffector {
    /// By `estimator`, and where that does not do, by `search`.
    pub fn new(estimator: PoseEstimator, search: GlobalSearch) -> Self {
        Self { estimator: Mutex::new(estimator), search }
    }

    /// Where the base may be by each configuration.
    fn candidates(
        &self,
        observations: &Observations,
        labelling: &Labelling,
    ) -> Result<Vec<Candidate>, Box<dyn Error + Send + Sync>> {
        let mut estimator = self.estimator.lock().unwrap_or_else(PoisonError::into_inner);
        let mut candidates = Vec::new();
        let pairs = observations.configurations.iter().zip(&labelling.labels);
        for (index, (configuration, labels)) in pairs.enumerate() {
            let label = bytes(labels, configuration);
            let posture = estimator.shape().posture_of(&observations.arm, configuration);
            let (depth, camera) = (&configuration.depth, &observations.camera);
            let found = estimator.estimate_at(depth, camera, &label, posture.as_slice())?;
            let Some(found) = found.filter(PoseAnswer::may_be_right) else { continue };
            let twins = estimator.shape().twins().to_vec();
            let end_effector_from_base = configuration.base_from_end_effector.inverse();
            let poses = std::iter::once(found.camera_from_end_effector).chain(found.alternatives());
            candidates.extend(poses.flat_map(|pose| {
                twins.iter().map(move |twin| {
                    let pose =
                        Transform::<Camera, EndEffector>::from_isometry(pose.isometry() * twin);
                    let camera_from_base = pose * end_effector_from_base;
                    Candidate { configuration: index, camera_from_base }
                })
            }));
        }
        Ok(candidates)
    }
}

impl PoseProposer for ByEndEffector {
    fn propose(
        &self,
        observations: &Observations,
        labelling: &Labelling,
    ) -> Result<Vec<Hypothesis>, Box<dyn Error + Send + Sync>> {
        let candidates = self.candidates(observations, labelling)?;
        let mut telling: Vec<usize> = candidates.iter().map(|it| it.configuration).collect();
        telling.dedup();
        let agreed = consensus(candidates, &observations.workspace(), MOST);
        let is_enough = |of: &Consensus| {
            of.configurations >= ENOUGH
                && of.configurations as f64 >= ENOUGH_SHARE * telling.len() as f64
        };
        tracing::debug!(telling = telling.len(), ?agreed, "by the end-effector");
        let searched = match agreed.first().is_some_and(is_enough) {
            true => Vec::new(),
            false => self.search.propose(observations, labelling)?,
        };
        // All are looked at: what the search's score says of them is not known.
        let score = searched.first().map_or(0.0, |best| best.score);
        let agreed =
            agreed.iter().map(|of| Hypothesis { camera_from_base: of.camera_from_base, score });
        Ok(agreed.chain(searched).collect())
    }
}

/// Labels of a configuration's pixels as networks take them.
fn bytes(labels: &Labels, configuration: &Configuration) -> Vec<u8> {
    let width = configuration.depth.width() as usize;
    let label = |(at, z): (usize, &f32)| match labels.at(at % width, at / width) {
        _ if *z <= 0.0 => UNKNOWN,
        label => label.map_or(BACKGROUND, class_of),
    };
    configuration.depth.depth_m().iter().enumerate().map(label).collect()
}
