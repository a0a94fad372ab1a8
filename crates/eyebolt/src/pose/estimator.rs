//! The pose of an end-effector from one frame.

use super::comparison::Comparison;
use super::contest::Contest;
use super::hypotheses::{PoseHypothesis, Source, everywhere, half_turns, with_translation};
use super::judge::{Judge, Support};
use super::judged::{COARSE_M, Judged};
use super::keypoint_net::KeypointNet;
use super::observed::Observed;
use super::rotation_net::RotationNet;
use super::shape::EndEffectorShape;
use super::trust::{ExpectedError, Refusal, Rival, trust};
use super::{PoseError, PoseMethod};
use eyebolt_geometry::{Camera, DepthImage, EndEffector, PinholeCamera, Transform};
use eyebolt_registration::Posture;
use eyebolt_robot::JointPositions;

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
    /// With its links in which of the postures that were given, or of [`EndEffectorShape::openings`].
    pub opening: usize,
    /// What the frame says of it.
    pub support: Support,
    /// What it says of it against a smooth surface that is no end-effector; `None` of a pose that is not refined, or of too few pixels.
    pub against_smooth: Option<Comparison>,
    /// Other poses that were refined and held against it, likeliest first.
    pub rivals: Vec<Rival>,
    /// Why it should not be used, if so.
    pub refusal: Option<Refusal>,
}

impl PoseAnswer {
    /// Whether it may be right, even if it is not known which of several poses is.
    pub fn may_be_right(&self) -> bool {
        matches!(self.refusal, None | Some(Refusal::Ambiguous { .. }))
    }

    /// Whether it explains some of what was seen, so that the right pose may be near.
    pub(super) fn may_be_near(&self) -> bool {
        /// Least share of what was seen, and most of the shape that was seen through.
        const NEAR: [f64; 2] = [0.3, 0.4];
        let [explained, through] = NEAR;
        self.support.explained > explained && self.support.seen_through < through
    }

    /// By how many standard deviations the frame is for it and against a smooth surface; none where it does not tell.
    pub(super) fn significance(&self) -> f64 {
        self.against_smooth.as_ref().map_or(0.0, Comparison::significance)
    }

    /// Other poses that the frame supports as well, likeliest first.
    pub fn alternatives(&self) -> impl Iterator<Item = Transform<Camera, EndEffector>> {
        self.as_good().map(|rival| rival.camera_from_end_effector)
    }

    fn as_good(&self) -> impl Iterator<Item = &Rival> {
        self.rivals.iter().filter(|rival| rival.is_as_good())
    }

    /// The answer and what the frame supports as well, with the numbers of their postures.
    pub(super) fn possible(&self) -> Vec<(Transform<Camera, EndEffector>, usize)> {
        let own = (self.camera_from_end_effector, self.opening);
        let others = self.as_good().map(|rival| (rival.camera_from_end_effector, rival.opening));
        std::iter::once(own).chain(others).collect()
    }
}

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
        let posture = joints.map(|joints| self.shape.posture(joints));
        let postures = posture.as_slice();
        let found = self.estimate_at(depth, camera, label, postures)?;
        let is_enough = self.method != PoseMethod::Fused || !self.refines;
        if is_enough || found.as_ref().is_none_or(PoseAnswer::may_be_right) {
            return Ok(found);
        }
        let searched = self.estimate_anyhow(depth, camera, label, postures);
        Ok(searched.filter(PoseAnswer::may_be_right).or(found))
    }

    /// As [`Self::estimate_at`], without networks: every way the end-effector may be turned is tried, which takes ten times
    /// as long.
    pub(crate) fn estimate_anyhow(
        &self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        label: &[u8],
        postures: &[Posture],
    ) -> Option<PoseAnswer> {
        let observed = Observed::new(depth, camera, label, self.shape.extent_m())?;
        let openings = self.openings(postures);
        let hypotheses = everywhere(&self.shape, &openings[0], &observed);
        let contest = Contest { shape: &self.shape, observed: &observed, openings: &openings };
        answer(&contest, &contest.ranked(hypotheses))
    }

    /// `postures`, or those that the end-effector may have where none is known.
    pub(super) fn openings(&self, postures: &[Posture]) -> Vec<Posture> {
        match postures {
            [] => self.shape.openings(),
            known => known.to_vec(),
        }
    }

    /// As [`Self::estimate`], with the links of the end-effector in one of `postures`; if there is none, at one of a
    /// few openings.
    ///
    /// # Errors
    ///
    /// No memory.
    pub(crate) fn estimate_at(
        &mut self,
        depth: &DepthImage,
        camera: &PinholeCamera,
        label: &[u8],
        postures: &[Posture],
    ) -> Result<Option<PoseAnswer>, PoseError> {
        let extent_m = self.shape.extent_m();
        let Some(observed) = Observed::new(depth, camera, label, extent_m) else {
            return Ok(None);
        };
        let openings = self.openings(postures);
        let posture = &openings[0];
        let hypotheses = self.hypotheses(&observed, posture)?;
        let contest = Contest { shape: &self.shape, observed: &observed, openings: &openings };
        if !self.refines {
            return Ok(hypotheses.first().map(|first| as_it_is(&contest, first)));
        }
        Ok(answer(&contest, &contest.ranked(hypotheses)))
    }

    /// What the networks of `method` alone say first of what was `observed`.
    pub(crate) fn first_word(
        &mut self,
        observed: &Observed,
        posture: &Posture,
        method: PoseMethod,
    ) -> Result<Option<PoseHypothesis>, PoseError> {
        let own = std::mem::replace(&mut self.method, method);
        let found = self.hypotheses(observed, posture);
        self.method = own;
        Ok(found?.first().copied())
    }

    fn hypotheses(
        &mut self,
        observed: &Observed,
        posture: &Posture,
    ) -> Result<Vec<PoseHypothesis>, PoseError> {
        let mut found = Vec::new();
        let mut judge = Judge::new(&self.shape, observed);
        // By themselves, networks are taken at their first word.
        let fused = self.method == PoseMethod::Fused;
        let modes = if fused { usize::MAX } else { 1 };
        if let Some(net) = self.rotation.as_mut().filter(|_| self.method != PoseMethod::Kpm) {
            for mode in net.rotations(&observed.view)?.into_iter().take(modes) {
                let rotation = mode.camera_from_end_effector;
                let pose = with_translation(&mut judge, &self.shape, posture, observed, rotation);
                let (source, probability) = (Source::Rotation, mode.probability);
                found.push(PoseHypothesis { pose, source, probability });
            }
        }
        let keypoints = self.keypoints.as_mut().filter(|_| self.method != PoseMethod::Rpt);
        if let Some(net) = keypoints
            && let Some(matched) = net.pose(&observed.view)?
        {
            let pose = Transform::from_isometry(*matched.camera_from_end_effector.isometry());
            found.push(PoseHypothesis { pose, source: Source::Keypoints, probability: 1.0 });
        }
        if fused {
            let turned = found.iter().flat_map(|of| half_turns(&self.shape, of));
            let turned: Vec<PoseHypothesis> = turned.collect();
            found.extend(turned);
        }
        Ok(found)
    }
}

/// A hypothesis as the networks have it.
fn as_it_is(contest: &Contest<'_>, first: &PoseHypothesis) -> PoseAnswer {
    let mut judge = Judge::new(contest.shape, contest.observed);
    PoseAnswer {
        camera_from_end_effector: Transform::from_isometry(*first.pose.isometry()),
        source: first.source,
        expected_error: None,
        opening: 0,
        support: judge.support(&contest.openings[0], &first.pose, 3.0 * COARSE_M),
        against_smooth: None,
        rivals: Vec::new(),
        refusal: None,
    }
}

fn answer(contest: &Contest<'_>, judged: &[Judged]) -> Option<PoseAnswer> {
    let (best, others) = judged.split_first()?;
    let pose = |it: &Judged| Transform::from_isometry(*it.fit.camera_from_base.isometry());
    let rivals = others.iter().zip(contest.comparisons(judged));
    let rivals: Vec<Rival> = rivals
        .map(|(other, comparison)| {
            let camera_from_end_effector = pose(other);
            let poses: [Transform<Camera, EndEffector>; 2] = [pose(best), camera_from_end_effector];
            let poses = poses.map(|pose| *pose.isometry());
            let apart = contest.shape.apart(&poses[0], &poses[1]);
            Rival { apart, camera_from_end_effector, opening: other.opening, comparison }
        })
        .collect();
    let against_smooth = contest.against_smooth(best);
    let (expected_error, refusal) = trust(contest, best, &rivals, against_smooth);
    tracing::trace!(
        support = ?best.support,
        inliers = best.fit.inliers,
        deviation_m = best.fit.deviation_m,
        middle = ?contest.observed.middle(),
        translation_m = ?best.fit.camera_from_base.translation_m(),
        rotation_xyzw = ?best.fit.camera_from_base.rotation_xyzw(),
        ?against_smooth,
        ?refusal,
        "a pose was judged"
    );
    Some(PoseAnswer {
        camera_from_end_effector: pose(best),
        source: best.hypothesis.source,
        opening: best.opening,
        expected_error,
        support: best.support,
        against_smooth,
        rivals,
        refusal,
    })
}
