//! Many configurations into one calibration, and how far to trust it.

mod agreement;
mod error;
mod links;
mod shortlist;
mod verdict;

pub use agreement::{Agreement, agreement};
pub use error::{Deviation, ErrorEstimate};
pub use links::{Misplaced, misplaced_links};
pub use verdict::{Limits, Reason, Verdict};

use crate::pose;
use crate::progress::{Progress, Step};
use crate::refine::{CLOSING, refine};
use crate::session::Session;
use eyebolt_geometry::{Base, Camera, Mask, Transform};
use eyebolt_registration::{Posture, RefineView, Refinement, Start, View};
use eyebolt_render::Raster;

/// What became of one configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct ConfigurationOutcome {
    /// Names of its frames.
    pub frames: Vec<String>,
    /// Why it took no part in the answer; `None` if it did.
    pub dropped: Option<Dropped>,
    /// Median distance of the arm's points from the posed surface, metres.
    pub residual_m: Option<f64>,
    /// How its pixels agree with the answer.
    pub agreement: Option<Agreement>,
}

/// Why a configuration took no part.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Dropped {
    /// Too little of the arm was seen, or had moved.
    #[error("only {pixels} pixels are known to be the arm")]
    FewPixels {
        /// How many there were.
        pixels: usize,
    },
    /// The camera saw through a link where the joints put it.
    #[error(
        "{} is not where its joints put it: the camera sees through {:.0} % of it",
        .0.link, 100.0 * .0.share
    )]
    Misplaced(Misplaced),
}

/// A calibration, trusted or not.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// The answer, for the depth optical frame; `None` if nothing was found at all.
    pub camera_from_base: Option<Transform<Camera, Base>>,
    /// What the last refinement says, in the session's own camera frame.
    pub refinement: Option<Refinement>,
    /// One for each configuration of the session.
    pub configurations: Vec<ConfigurationOutcome>,
    /// How far off the answer is expected to be.
    pub error: Option<ErrorEstimate>,
    /// Whether to use it.
    pub verdict: Verdict,
}

impl Calibration {
    /// No answer, and why.
    pub fn without_pose(verdict: Verdict) -> Self {
        let configurations = Vec::new();
        Self { camera_from_base: None, refinement: None, configurations, error: None, verdict }
    }

    /// How all pixels of the configurations used agree with the answer.
    pub fn agreement(&self) -> Option<Agreement> {
        let views: Vec<_> = self.configurations.iter().filter_map(|c| c.agreement).collect();
        (!views.is_empty()).then(|| shortlist::total(&views))
    }
}

/// Poses that the search hands on.
const CANDIDATES: usize = 4;

/// Calibrates `session` from nothing. `seed` turns the grid of rotations that the search starts
/// from: another seed, another way to the same answer.
pub fn calibrate(
    session: &Session,
    limits: &Limits,
    seed: u64,
    progress: &dyn Progress,
) -> Calibration {
    progress.begin(Step::Label);
    let masks = pose::arm_masks(session);
    let mut outcomes = outcomes(session, &masks);
    let mut work = Work::new(session, &masks, &outcomes);
    progress.begin(Step::Pose);
    let candidates = pose::start(session, &masks, seed, CANDIDATES);
    progress.begin(Step::Refine);
    let Some(choice) = shortlist::choose(&mut work, &candidates) else {
        let verdict = verdict::nothing_found(&outcomes, &session.outside_limits, limits);
        return Calibration { configurations: outcomes, ..Calibration::without_pose(verdict) };
    };
    let (mut refinement, mut observed) = work.refine(&choice.camera_from_base.into());
    let misplaced = work.find_misplaced(&refinement, &mut outcomes);
    if verdict::may_be_dropped(misplaced, &outcomes) {
        work = Work::new(session, &masks, &outcomes);
        (refinement, observed) = work.refine(&refinement.end());
    }
    progress.begin(Step::Calibrate);
    work.measure(&refinement, &mut outcomes);
    let error = error::estimate(&mut work, &refinement, &observed);
    let rival =
        choice.rival.is_some_and(|rival| shortlist::stands(&mut work, &rival, &refinement.end()));
    let evidence = verdict::Evidence {
        refinement: &refinement,
        joints: session.arm.joints(),
        outcomes: &outcomes,
        outside_limits: &session.outside_limits,
        error: &error,
        rival,
        masks: session.has_masks(),
    };
    let verdict = verdict::judge(&evidence, limits);
    Calibration {
        camera_from_base: Some(session.optical_from_camera * refinement.camera_from_base),
        refinement: Some(refinement),
        configurations: outcomes,
        error: Some(error),
        verdict,
    }
}

/// Share of an image's pixels that has to be the arm.
const LEAST_ARM_SHARE: f64 = 1e-3;

fn outcomes(session: &Session, masks: &[Mask]) -> Vec<ConfigurationOutcome> {
    let least = (LEAST_ARM_SHARE * session.camera.pixel_count() as f64) as usize;
    let pairs = session.configurations.iter().zip(masks);
    pairs
        .map(|(configuration, mask)| {
            let depth = configuration.depth.depth_m();
            let seen = mask.as_slice().iter().zip(depth).filter(|(m, z)| **m && **z > 0.0);
            let pixels = seen.count();
            ConfigurationOutcome {
                frames: configuration.frames.clone(),
                dropped: (pixels < least).then_some(Dropped::FewPixels { pixels }),
                residual_m: None,
                agreement: None,
            }
        })
        .collect()
}

/// The configurations that take part, and the buffers to work on them.
pub(crate) struct Work<'a> {
    session: &'a Session,
    /// Which configurations of the session these are.
    indices: Vec<usize>,
    views: Vec<View<'a>>,
    masks: Vec<&'a Mask>,
    rasters: Vec<Raster>,
}

impl<'a> Work<'a> {
    fn new(session: &'a Session, masks: &'a [Mask], outcomes: &[ConfigurationOutcome]) -> Self {
        let used = |index: &usize| outcomes[*index].dropped.is_none();
        let indices: Vec<usize> = (0..outcomes.len()).filter(used).collect();
        Self {
            session,
            views: indices.iter().map(|i| session.view(&session.configurations[*i])).collect(),
            masks: indices.iter().map(|i| &masks[*i]).collect(),
            rasters: indices.iter().map(|_| Raster::new(&session.camera)).collect(),
            indices,
        }
    }

    fn refine(&mut self, start: &Start) -> (Refinement, Vec<RefineView<'a>>) {
        refine(self.session, &self.views, &mut self.rasters, start, CLOSING)
    }

    /// Marks the configurations with a link that the camera sees through, and counts them.
    fn find_misplaced(
        &mut self,
        refinement: &Refinement,
        outcomes: &mut [ConfigurationOutcome],
    ) -> usize {
        let postures = self.postures(&refinement.end());
        let (views, pose) = (with_postures(&self.views, &postures), &refinement.camera_from_base);
        let found = misplaced_links(self.session, &views, &mut self.rasters, pose);
        let mut count = 0;
        for (index, misplaced) in self.indices.iter().zip(found) {
            if let Some(misplaced) = misplaced {
                outcomes[*index].dropped = Some(Dropped::Misplaced(misplaced));
                count += 1;
            }
        }
        count
    }

    /// Where the links are with the joints as `at` has them.
    fn postures(&self, at: &Start) -> Vec<Posture> {
        let moved = |view: &View<'_>| view.posture.moved(&self.session.arm, &at.joint_offsets);
        self.views.iter().map(moved).collect()
    }

    fn agreement(&mut self, at: &Start) -> Vec<Agreement> {
        let postures = self.postures(at);
        let (views, pose) = (with_postures(&self.views, &postures), &at.camera_from_base);
        agreement(self.session, &views, &self.masks, &mut self.rasters, pose)
    }

    fn measure(&mut self, refinement: &Refinement, outcomes: &mut [ConfigurationOutcome]) {
        let agreement = self.agreement(&refinement.end());
        for ((index, fit), agreement) in self.indices.iter().zip(&refinement.views).zip(agreement) {
            outcomes[*index].residual_m = fit.surface_m.is_finite().then_some(fit.surface_m);
            outcomes[*index].agreement = Some(agreement);
        }
    }
}

fn with_postures<'b>(views: &[View<'b>], postures: &'b [Posture]) -> Vec<View<'b>> {
    views.iter().zip(postures).map(|(view, posture)| View { posture, ..*view }).collect()
}
