//! Which of the hypotheses it is.

use super::agreement::total;
use super::rounds::{OPENING, refine};
use super::workspace::Workspace;
use crate::pose::Hypothesis;
use crate::progress::{Cancelled, Progress};
use eyebolt_geometry::{Base, Camera, Transform};
use eyebolt_registration::Start;

/// The hypothesis that explains the views best.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shortlisted {
    pub camera_from_base: Transform<Camera, Base>,
    /// The best of the poses that are clearly other ones, if it explains nearly as much.
    pub rival: Option<Transform<Camera, Base>>,
}

/// A rival has to leave this much more of the pixels contradicted or unexplained to be none.
const RIVAL_MARGIN: f64 = 0.10;

/// Poses nearer to each other than this are one.
const SAME_M: f64 = 0.04;
const SAME_RAD: f64 = 0.05;

/// A start this near to a pose that was found from another one, and that explains this much, would
/// only lead there again.
const REACH_M: f64 = 0.15;
const REACH_RAD: f64 = 0.25;
/// On the LBR Med7 recording the right pose leaves 0.25 contradicted or unexplained after so few steps.
const GOOD: f64 = 0.4;

/// A hypothesis that the search scores this many times worse than the best cannot be the answer.
const HOPELESS: f64 = 2.0;

/// Refines each hopeful hypothesis a little and takes the one that the pixels contradict least and
/// that explains most of them; `None` if there is none or nothing to refine it on.
pub(crate) fn choose(
    work: &mut Workspace<'_, '_>,
    hypotheses: &[Hypothesis],
    progress: &dyn Progress,
) -> Result<Option<Shortlisted>, Cancelled> {
    let Some(first) = hypotheses.first().filter(|_| !work.views.is_empty()) else {
        return Ok(None);
    };
    let hopeful = first.score * HOPELESS;
    let mut scored: Vec<(f64, Transform<Camera, Base>)> = Vec::new();
    for (number, hypothesis) in hypotheses.iter().enumerate() {
        progress.advance(number, 2 * hypotheses.len())?;
        let start = &hypothesis.camera_from_base;
        let leads_to = |(score, pose): &(f64, Transform<Camera, Base>)| {
            let (metres, radians) = pose.distance_to(start);
            *score < GOOD && metres < REACH_M && radians < REACH_RAD
        };
        if hypothesis.score > hopeful || scored.iter().any(leads_to) {
            tracing::debug!(number, score = hypothesis.score, "hypothesis passed over");
            continue;
        }
        let (short, _) =
            refine(work.observations, &work.views, &mut work.rasters, &(*start).into(), OPENING);
        let all = total(&work.agreement(&short.end()));
        let (contradicted, unexplained) = (all.contradicted_share(), all.unexplained_share());
        tracing::debug!(number, score = hypothesis.score, contradicted, unexplained, "hypothesis");
        scored.push((contradicted + unexplained, short.camera_from_base));
    }
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some((best, camera_from_base)) = scored.first().copied() else { return Ok(None) };
    let rival = scored
        .iter()
        .find(|(score, pose)| *score < best + RIVAL_MARGIN && is_another(pose, &camera_from_base));
    Ok(Some(Shortlisted { camera_from_base, rival: rival.map(|(_, pose)| *pose) }))
}

fn is_another(a: &Transform<Camera, Base>, b: &Transform<Camera, Base>) -> bool {
    let (metres, radians) = a.distance_to(b);
    metres > SAME_M || radians > SAME_RAD
}

/// Whether `rival`, refined to its end, still is another pose than `answer` and explains nearly as
/// much.
pub(crate) fn stands(
    work: &mut Workspace<'_, '_>,
    rival: &Transform<Camera, Base>,
    answer: &Start,
) -> bool {
    if work.views.is_empty() {
        return false;
    }
    let (refined, _) = work.refine(&(*rival).into());
    let mut score = |at: &Start| {
        let all = total(&work.agreement(at));
        all.contradicted_share() + all.unexplained_share()
    };
    is_another(&refined.camera_from_base, &answer.camera_from_base)
        && score(&refined.end()) < score(answer) + RIVAL_MARGIN
}
