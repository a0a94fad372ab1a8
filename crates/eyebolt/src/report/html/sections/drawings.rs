//! Plots and pictures for the page.

use crate::answer::Answer;
use crate::pipeline::Outcome;
use crate::refine::ConfigurationOutcome;
use crate::report::html::plots::{Panel, Row, matrix, panels, rows};
use crate::report::html::spread::Spread;
use crate::report::html::{pictures as scaled, uncertainty};
use crate::report::leftovers::Leftover;
use crate::report::picture::Picture;
use eyebolt_registration::{Presentation, presentation};
use minijinja::{Value, context};

/// Axes end at the latest at so many standard deviations: beyond, residuals are not of the arm.
const FARTHEST_DEVIATIONS: f64 = 12.0;

/// Each plot as SVG, `None` where there is nothing to show.
pub(in super::super) fn plots(answer: &Answer, outcome: &Outcome, leftovers: &[Leftover]) -> Value {
    let covariance = uncertainty::at_workspace(answer);
    let kinds = presentation().into_iter().enumerate();
    let residuals = kinds.filter_map(|(kind, shown)| residuals(kind, shown, outcome, leftovers));
    context! {
        residuals => residuals.collect::<Vec<_>>(),
        leave_one_out => leave_one_out(answer, outcome).map(safe),
        deviations => covariance.as_ref().map(|c| safe(deviations(c))),
        correlations => covariance.as_ref().map(|c| {
            let correlations = uncertainty::correlations(c);
            safe(matrix("correlations", "Correlation of the errors", &correlations))
        }),
    }
}

fn safe(svg: String) -> Value {
    Value::from_safe_string(svg)
}

fn name(outcome: &ConfigurationOutcome) -> String {
    outcome.frames.first().cloned().unwrap_or_default()
}

/// What one kind of evidence leaves over, by configuration and by link; `None` if it was not seen.
fn residuals(
    kind: usize,
    shown: Presentation,
    outcome: &Outcome,
    leftovers: &[Leftover],
) -> Option<Value> {
    let seen = leftovers.iter().any(|leftover| !leftover.shown[kind].is_empty());
    let refinement = outcome.calibration.refinement.as_ref().filter(|_| seen)?;
    let deviation = refinement.deviations[kind] * shown.factor.abs();
    let farthest = (FARTHEST_DEVIATIONS * deviation) as f32;
    let outcomes = &outcome.calibration.configurations;
    let by_configuration = outcomes.iter().zip(leftovers).map(|(outcome, leftover)| Row {
        label: name(outcome),
        spread: Spread::new(leftover.shown[kind].iter().map(|(_, value)| *value)),
        muted: outcome.dropped.is_some(),
    });
    let used = || {
        let used = outcomes.iter().zip(leftovers).filter(|(outcome, _)| outcome.dropped.is_none());
        used.flat_map(|(_, leftover)| &leftover.shown[kind])
    };
    let links = outcome.observations.iter().flat_map(|observations| observations.arm.links());
    let by_link = links.enumerate().map(|(index, link)| Row {
        label: link.name.clone(),
        spread: Spread::new(used().filter(|(of, _)| *of == index).map(|(_, value)| *value)),
        muted: false,
    });
    let label = format!("{}, {}", shown.unit, shown.positive);
    let draw = |by: &str, each: Vec<Row>| {
        let id = format!("{}-by-{by}", shown.name);
        safe(rows(&id, &label, shown.unit, &each, farthest))
    };
    Some(context! {
        name => shown.name,
        positive => shown.positive,
        by_configuration => draw("configuration", by_configuration.collect()),
        by_link => draw("link", by_link.collect()),
    })
}

fn leave_one_out(answer: &Answer, outcome: &Outcome) -> Option<String> {
    let error = outcome.calibration.error.as_ref()?;
    let used = outcome.calibration.configurations.iter().filter(|o| o.dropped.is_none());
    let each = used.zip(error.leave_one_out.as_ref()?).map(|(outcome, change)| {
        (name(outcome), [1e3 * change.translation_m, change.rotation_rad.to_degrees()])
    });
    let columns = [
        Panel {
            label: "mm moved without it",
            unit: "mm",
            decimals: 1,
            mark: answer.expected_error.map(|expected| expected.translation_mm),
        },
        Panel {
            label: "degrees turned without it",
            unit: "degrees",
            decimals: 2,
            mark: answer.expected_error.map(|expected| expected.rotation_deg),
        },
    ];
    let label = "What changes without each configuration";
    Some(panels("leave-one-out", label, &each.collect::<Vec<_>>(), &columns))
}

fn deviations(covariance: &nalgebra::Matrix6<f64>) -> String {
    let names = ["x, right", "y, down", "z, forward"].map(str::to_owned);
    let each: Vec<_> = names.into_iter().zip(uncertainty::deviations(covariance)).collect();
    let columns = [
        Panel { label: "mm along the axis", unit: "mm", decimals: 1, mark: None },
        Panel { label: "degrees about the axis", unit: "degrees", decimals: 2, mark: None },
    ];
    panels("deviations", "Standard deviations along the camera's axes", &each, &columns)
}

/// The pictures with the names of their configurations.
pub(in super::super) fn pictures(answer: &Answer, pictures: &[Picture]) -> Vec<Value> {
    let groups = answer.configurations.chunk_by(|a, b| a.configuration == b.configuration);
    let figures = groups.zip(scaled::data_urls(pictures)).filter_map(|(group, url)| {
        let first = group.first()?;
        Some(context! {
            name => first.name,
            used => first.used,
            reason => first.reason,
            residual_mm => first.residual_mm,
            url => Value::from_safe_string(url),
        })
    });
    figures.collect()
}
