//! How a session ends.

use crate::calibrate::{Deviation, Elsewhere, Reason};

/// How a session ends.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// It cannot be simulated: the camera hardly sees the arm. It counts nowhere.
    Unfit(String),
    /// No answer at all: the recording is turned down at the door.
    Failed(Refusal),
    /// An answer, trusted or refused.
    Answered(Answered),
}

/// An answer against the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered {
    /// How far it is off at the centre of the workspace; `None` without a pose.
    pub error: Option<Deviation>,
    /// How far it is off from where the camera was after it was bumped, if it was.
    pub error_after_bump: Option<Deviation>,
    /// What the answer says it is off by.
    pub expected: Option<Deviation>,
    /// Where the links that never move fit best, if they are seen.
    pub still_part: Option<Elsewhere>,
    /// Quantiles of the error at [`super::LEVELS`] that the answer's covariance has.
    pub quantiles: Option<[Deviation; 3]>,
    /// Why it is refused; empty where it is trusted.
    pub refusals: Vec<Refusal>,
}

/// Why an answer is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// For machines: the reason's name in snake case.
    pub name: String,
    /// For people.
    pub text: String,
}

impl Refusal {
    /// For `reason`.
    pub fn of(reason: &Reason) -> Self {
        // Whatever reasons there will be, their variants have names.
        let shown = format!("{reason:?}");
        let variant = shown.split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default();
        Self { name: snake_case(variant), text: reason.to_string() }
    }

    /// For an error that kept the recording from being calibrated.
    pub fn of_error(error: &dyn std::error::Error) -> Self {
        Self { name: "error".to_owned(), text: error.to_string() }
    }
}

fn snake_case(camel: &str) -> String {
    let mut snake = String::new();
    for c in camel.chars() {
        if c.is_ascii_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.push(c.to_ascii_lowercase());
    }
    snake
}

/// An answer within these of the truth is right.
const RIGHT_M: f64 = 0.010;
const RIGHT_RAD: f64 = 0.6 * std::f64::consts::PI / 180.0;

impl Ending {
    /// Whether there is an answer that is trusted.
    pub fn is_trusted(&self) -> bool {
        matches!(self, Self::Answered(answered) if answered.refusals.is_empty())
    }

    /// Whether there is an answer that is right, trusted or not: within 10 mm and 0.6 degrees.
    pub fn is_right(&self) -> bool {
        let Self::Answered(Answered { error: Some(error), .. }) = self else { return false };
        error.translation_m <= RIGHT_M && error.rotation_rad <= RIGHT_RAD
    }

    /// Why there is no trusted answer.
    pub fn refusals(&self) -> &[Refusal] {
        match self {
            Self::Unfit(_) => &[],
            Self::Failed(refusal) => std::slice::from_ref(refusal),
            Self::Answered(answered) => &answered.refusals,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_are_named_after_their_variants() {
        let named = |reason: Reason| Refusal::of(&reason).name;
        assert_eq!(named(Reason::FewConfigurations { used: 1, needed: 3 }), "few_configurations");
        assert_eq!(named(Reason::Ambiguous), "ambiguous");
    }
}
