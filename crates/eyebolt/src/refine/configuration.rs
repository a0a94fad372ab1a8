//! What becomes of each configuration.

use super::agreement::Agreement;
use super::links::Misplaced;

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
    /// The camera moved afterwards; the answer is where it was then.
    #[error("the camera moved afterwards")]
    BeforeCameraMoved,
    /// The camera saw through a link where the joints put it.
    #[error(
        "{} is not where its joints put it: the camera sees through {:.0} % of it",
        .0.link, 100.0 * .0.share
    )]
    Misplaced(Misplaced),
    /// Its frames say too little of the end-effector.
    #[error("{0}")]
    Insane(String),
    /// Too few of its frames tell a pose of the end-effector.
    #[error("only {poses} poses of the end-effector were found in its frames")]
    FewPoses {
        /// How many there were.
        poses: usize,
    },
    /// It says otherwise than the rest.
    #[error("it puts the base elsewhere than the other configurations")]
    Outlier,
}

/// Share of configurations that may have a misplaced link before the joints themselves are in
/// doubt.
const MISPLACED_SHARE: f64 = 0.25;

/// How many configurations have a misplaced link, of how many that were judged.
pub(crate) fn misplaced(outcomes: &[ConfigurationOutcome]) -> (usize, usize) {
    let is_misplaced = |o: &&ConfigurationOutcome| matches!(o.dropped, Some(Dropped::Misplaced(_)));
    let misplaced = outcomes.iter().filter(is_misplaced).count();
    (misplaced, misplaced + outcomes.iter().filter(|o| o.dropped.is_none()).count())
}

/// Whether so many configurations have a misplaced link that it is not theirs to be left out.
pub(crate) fn too_many_misplaced(outcomes: &[ConfigurationOutcome]) -> bool {
    let (misplaced, judged) = misplaced(outcomes);
    misplaced as f64 > MISPLACED_SHARE * judged as f64
}

/// The configurations that nothing speaks against.
pub(crate) fn taking_part(outcomes: &[ConfigurationOutcome]) -> Vec<usize> {
    (0..outcomes.len()).filter(|index| outcomes[*index].dropped.is_none()).collect()
}
