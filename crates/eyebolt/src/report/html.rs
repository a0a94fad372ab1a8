//! A calibration as one page that needs nothing else: no network, no files beside it.
//!
//! The page is drawn from templates (`html/*.html`) with the numbers of the [`Answer`]; plots and the
//! scene are worked out here from the observations and the pose. Whatever came from outside is escaped.

mod advice;
mod base64;
mod batch;
mod pictures;
mod plots;
mod scene;
mod sections;
mod spread;
mod svg;
mod tables;
mod template;
mod uncertainty;

pub use advice::remedies;
pub use batch::batch_page;
pub use tables::tables_page;
pub use template::STYLE;

use super::leftovers;
use super::picture::Picture;
use crate::answer::Answer;
use crate::pipeline::Outcome;
use eyebolt_robot::Input;
use minijinja::{Value, context};

/// What a page tells that answer and outcome do not know.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// What the recording is called, such as its path.
    pub recording: &'a str,
    /// The posed arm over each configuration of the observations, in their order, as
    /// [`overlays`](super::overlays) draws them; or none.
    pub pictures: &'a [Picture],
    /// How far off the answer is, where the truth is known.
    pub truth: Option<TruthComparison>,
    /// What an input is called where this page comes from.
    pub call_input: fn(Input) -> String,
}

impl Default for Context<'_> {
    fn default() -> Self {
        let call_input = |input: Input| input.to_string();
        Self { recording: "", pictures: &[], truth: None, call_input }
    }
}

/// How far an answer is from the truth of a simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthComparison {
    /// Millimetres.
    pub translation_mm: f64,
    /// Degrees.
    pub rotation_deg: f64,
}

/// The page on `answer`, which was made of `outcome`: HTML that shows the verdict, the transform both
/// ways, what the expected error is made of, what is left over in every configuration and link,
/// pictures, and the clouds with the posed robot to turn about (WebGL).
///
/// A refused outcome makes a page too, also without a pose. The same bytes on any number of threads;
/// a few megabytes with pictures and clouds.
pub fn html(answer: &Answer, outcome: &Outcome, context: &Context<'_>) -> String {
    let parts = outcome.observations.as_ref().zip(outcome.calibration.refinement.as_ref());
    let leftovers = parts.map(|(observations, fit)| leftovers::leftovers(observations, fit));
    let leftovers = leftovers.unwrap_or_default();
    let scene = scene::scene(answer, outcome, &leftovers);
    let truth = context.truth.map(|truth| {
        context! { translation_mm => truth.translation_mm, rotation_deg => truth.rotation_deg }
    });
    template::render(
        "page.html",
        context! {
            version => answer.version,
            answer => Value::from_serialize(answer),
            recording => context.recording,
            trusted => answer.reasons.is_empty(),
            reasons => sections::reasons(&outcome.calibration.verdict, context.call_input),
            notes => advice::notes(answer),
            counts => sections::counts(answer),
            transforms => sections::transforms(outcome),
            command => sections::command(answer),
            sources => Value::from_serialize(uncertainty::sources(outcome)),
            truth => truth,
            configurations => sections::configurations(answer, &leftovers),
            plots => sections::plots(answer, outcome, &leftovers),
            pictures => sections::pictures(answer, context.pictures),
            scene => scene.map(|scene| Value::from_safe_string(scene.to_json())),
        },
    )
}
