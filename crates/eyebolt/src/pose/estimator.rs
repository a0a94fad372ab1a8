//! The pose of an end-effector from one frame.

use super::hypotheses::{PoseHypothesis, Source, half_turns, with_translation};
use super::judge::{Judge, Support};
use super::keypoint_net::KeypointNet;
use super::observed::Observed;
use super::rotation_net::RotationNet;
use super::shape::EndEffectorShape;
use super::trust::{ExpectedError, Refusal, expected_error, refusal};
use super::{PoseError, PoseMethod};
use eyebolt_geometry::{Camera, DepthImage, EndEffector, PinholeCamera, Transform};
use eyebolt_registration::{Icp, IcpOptions, Posture, icp};
use eyebolt_robot::JointPositions;
use nalgebra::Point3;

/// Tells the pose of an end-effector from one frame whose pixels are labelled.
#[derive(Debug)]
pub struct PoseEstimator {
    shape: EndEffectorShape,
    rotation: Option<RotationNet>,
    keypoints: Option<KeypointNet>,
    /// How a pose comes about.
    pub method: PoseMethod,
    /// Whether it is refined on the mesh.
    pub refines: bool,
}

/// A pose, and how far to trust it.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseAnswer {
    /// The likeliest pose.
    pub camera_from_end_effector: Transform<Camera, EndEffector>,
    /// Who proposed it.
    pub source: Source,
    /// How far off it is likely to be; `None` of a pose that is not refined.
    pub expected_error: Option<ExpectedError>,
    /// What the frame says of it.
    pub support: Support,
    /// Other poses that the frame supports as well, likeliest first.
    pub alternatives: Vec<Transform<Camera, EndEffector>>,
    /// Why it should not be used, if so.
    pub refusal: Option<Refusal>,
}

/// A hypothesis that was refined and judged.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judged {
    pub(super) hypothesis: PoseHypothesis,
    pub(super) fit: Icp,
    pub(super) support: Support,
    /// Which of the openings of its fingers.
    opening: usize,
}

/// Points of the first refinement, which is only to tell hypotheses apart.
const FEW: usize = 300;
/// Hypotheses that are refined in full.
const FINALISTS: usize = 4;
/// Deviation of the depth while hypotheses are told apart, as a share of it squared, and at the camera, metres.
const COARSE_M: f64 = 0.004;
/// Poses nearer to each other than this are the same one, metres and radians.
const SAME_M: f64 = 0.01;
const SAME_RAD: f64 = 0.1;

impl PoseEstimator {
    /// Of `shape`, by the networks that there are; at least one.
    ///
    /// # Errors
    ///
    /// There is none, or not the one that `method` needs.
    pub fn new(
        shape: EndEffectorShape,
        rotation: Option<RotationNet>,
        keypoints: Option<KeypointNet>,
        method: PoseMethod,
    ) -> Result<Self, PoseError> {
        let there = match method {
            PoseMethod::Rpt => rotation.is_some(),
            PoseMethod::Kpm => keypoints.is_some(),
            PoseMethod::Fused => rotation.is_some() || keypoints.is_some(),
        };
        if !there {
            return Err(PoseError::NoNetwork { method });
        }
        Ok(Self { shape, rotation, keypoints, method, refines: true })
    }

    /// The end-effector.
    pub fn shape(&self) -> &EndEffectorShape {
        &self.shape
    }

    /// The pose of the end-effector whose pixels have that label in `depth`. Its fingers are where `joints` has
    /// them; without, at that one of a few openings which the frame supports best. `None` if too little of it is in
    /// view, or no network has anything to say.
    ///
    /// # Errors
    ///
    /// No memory.
    pub fn estimate(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        label: &[u8],
        joints: Option<&JointPositions>,
    ) -> Result<Option<PoseAnswer>, PoseError> {
        let extent_m = self.shape.end_effector.extent_m();
        let Some(observed) = Observed::new(depth, camera, label, extent_m) else {
            return Ok(None);
        };
        let openings = match joints {
            Some(joints) => vec![self.shape.posture(joints)],
            None => self.shape.openings(),
        };
        let posture = &openings[0];
        let hypotheses = self.hypotheses(&observed, posture)?;
        let shape = &self.shape;
        let mut judge = Judge::new(shape, &observed);
        if !self.refines {
            let Some(first) = hypotheses.first() else { return Ok(None) };
            let support = judge.support(posture, &first.pose, 3.0 * COARSE_M);
            return Ok(Some(PoseAnswer {
                camera_from_end_effector: Transform::from_isometry(*first.pose.isometry()),
                source: first.source,
                expected_error: None,
                support,
                alternatives: Vec::new(),
                refusal: None,
            }));
        }
        let few: Vec<Point3<f32>> = every(&observed.points, FEW);
        let mut judged: Vec<Judged> = hypotheses
            .into_iter()
            .map(|hypothesis| refined(&mut judge, shape, (posture, 0), &few, hypothesis, FIRST))
            .collect();
        keep_distinct(shape, &mut judged, FINALISTS);
        let mut last = Vec::new();
        for it in &judged {
            let again = PoseHypothesis { pose: it.fit.camera_from_base, ..it.hypothesis };
            for posture in openings.iter().zip(0..) {
                last.push(refined(&mut judge, shape, posture, &observed.points, again, LAST));
            }
        }
        let mut judged = last;
        // By one measure for all: that of the best.
        let deviation_m = judged.iter().map(|it| it.fit.deviation_m).fold(f64::INFINITY, f64::min);
        let deviation_m = deviation_m.max(0.5 * LAST.least_scale_m);
        for it in &mut judged {
            let posture = &openings[it.opening];
            it.support = judge.support(posture, &it.fit.camera_from_base, 1.5 * deviation_m);
        }
        keep_distinct(shape, &mut judged, FINALISTS);
        Ok(answer(&observed, &judged))
    }

    fn hypotheses(
        &mut self,
        observed: &Observed,
        posture: &Posture,
    ) -> Result<Vec<PoseHypothesis>, PoseError> {
        let mut found = Vec::new();
        let mut judge = Judge::new(&self.shape, observed);
        if let Some(net) = self.rotation.as_mut().filter(|_| self.method != PoseMethod::Kpm) {
            for mode in net.rotations(&observed.view)? {
                let rotation = mode.camera_from_end_effector;
                let pose = with_translation(&mut judge, &self.shape, posture, observed, rotation);
                let (source, probability) = (Source::Rotation, mode.probability);
                found.push(PoseHypothesis { pose, source, probability });
            }
        }
        if let Some(net) = self.keypoints.as_mut().filter(|_| self.method != PoseMethod::Rpt) {
            if let Some(matched) = net.pose(&observed.view)? {
                let pose = Transform::from_isometry(*matched.camera_from_end_effector.isometry());
                found.push(PoseHypothesis { pose, source: Source::Keypoints, probability: 1.0 });
            }
        }
        if self.method == PoseMethod::Fused {
            let turned = found.iter().flat_map(|of| half_turns(&self.shape, of));
            let turned: Vec<PoseHypothesis> = turned.collect();
            found.extend(turned);
        } else {
            found.truncate(1);
        }
        Ok(found)
    }
}

/// From centimetres and a dozen degrees on, by few points.
const FIRST: IcpOptions = IcpOptions { first_scale_m: 0.03, least_scale_m: 0.004, most_steps: 15 };
/// On from there.
const LAST: IcpOptions = IcpOptions { first_scale_m: 0.01, least_scale_m: 0.002, most_steps: 30 };

fn refined(
    judge: &mut Judge<'_>,
    shape: &EndEffectorShape,
    (posture, opening): (&Posture, usize),
    points: &[Point3<f32>],
    hypothesis: PoseHypothesis,
    options: IcpOptions,
) -> Judged {
    let fit = icp(&shape.model, posture, points, &hypothesis.pose, &options);
    let deviation_m = fit.deviation_m.clamp(COARSE_M, 2.0 * COARSE_M);
    let support = judge.support(posture, &fit.camera_from_base, deviation_m);
    Judged { hypothesis, fit, support, opening }
}

/// About `count` of `points`, evenly chosen.
fn every(points: &[Point3<f32>], count: usize) -> Vec<Point3<f32>> {
    points.iter().step_by(points.len().div_ceil(count).max(1)).copied().collect()
}

/// Best first; of those that are the same pose, the best alone; and no more than `most`.
fn keep_distinct(shape: &EndEffectorShape, judged: &mut Vec<Judged>, most: usize) {
    judged.sort_by(|a, b| a.support.cost.total_cmp(&b.support.cost));
    let mut kept: Vec<Judged> = Vec::new();
    for it in judged.drain(..) {
        let same = |other: &Judged| {
            let poses = [other, &it].map(|of| *of.fit.camera_from_base.isometry());
            let (metres, radians) = shape.apart(&poses[0], &poses[1]);
            metres < SAME_M && radians < SAME_RAD
        };
        if kept.len() < most && !kept.iter().any(same) {
            kept.push(it);
        }
    }
    *judged = kept;
}

fn answer(observed: &Observed, judged: &[Judged]) -> Option<PoseAnswer> {
    let (best, others) = judged.split_first()?;
    let pose = |it: &Judged| Transform::from_isometry(*it.fit.camera_from_base.isometry());
    let alternatives = others.iter().filter(|other| super::trust::is_as_good(best, other));
    let alternatives: Vec<_> = alternatives.map(pose).collect();
    Some(PoseAnswer {
        camera_from_end_effector: pose(best),
        source: best.hypothesis.source,
        expected_error: expected_error(observed, &best.fit),
        support: best.support,
        refusal: refusal(observed, best, &alternatives),
        alternatives,
    })
}
