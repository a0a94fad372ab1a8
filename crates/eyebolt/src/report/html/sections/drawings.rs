//! Plots and pictures for the page.

use crate::answer::Answer;
use crate::calibrate::ConfigurationOutcome;
use crate::pipeline::Outcome;
use crate::report::html::evidence::Leftover;
use crate::report::html::plots::{Panel, Row, matrix, panels, rows};
use crate::report::html::spread::Spread;
use crate::report::html::{pictures as scaled, uncertainty};
use crate::report::picture::Picture;
use minijinja::{Value, context};

/// Where axes end at the latest: beyond, points are not of the arm any more.
const FARTHEST_MM: f32 = 50.0;
const FARTHEST_PX: f32 = 12.0;

/// Each plot as SVG, `None` where there is nothing to show.
pub(in super::super) fn plots(answer: &Answer, outcome: &Outcome, leftovers: &[Leftover]) -> Value {
    let outcomes = &outcome.calibration.configurations;
    let seen = !leftovers.is_empty();
    let outlines = leftovers.iter().any(|leftover| !leftover.outline_px.is_empty());
    let covariance = uncertainty::at_workspace(answer);
    context! {
        surface_by_configuration => seen.then(|| safe(surface_by_configuration(outcomes, leftovers))),
        surface_by_link => seen.then(|| safe(surface_by_link(outcome, leftovers))),
        outline_by_configuration =>
            outlines.then(|| safe(outline_by_configuration(outcomes, leftovers))),
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

fn surface_by_configuration(outcomes: &[ConfigurationOutcome], leftovers: &[Leftover]) -> String {
    let each = outcomes.iter().zip(leftovers).map(|(outcome, leftover)| Row {
        label: name(outcome),
        spread: Spread::new(leftover.surface_mm.iter().map(|(_, mm)| *mm)),
        muted: outcome.dropped.is_some(),
    });
    let label = "mm behind the model's surface";
    rows("surface-by-configuration", label, "mm", &each.collect::<Vec<_>>(), FARTHEST_MM)
}

fn surface_by_link(outcome: &Outcome, leftovers: &[Leftover]) -> String {
    let links = outcome.session.iter().flat_map(|session| session.arm.links());
    let used = || {
        let pairs = outcome.calibration.configurations.iter().zip(leftovers);
        pairs.filter(|(outcome, _)| outcome.dropped.is_none()).flat_map(|(_, l)| &l.surface_mm)
    };
    let each = links.enumerate().map(|(index, link)| Row {
        label: link.name.clone(),
        spread: Spread::new(used().filter(|(of, _)| *of == index).map(|(_, mm)| *mm)),
        muted: false,
    });
    let label = "mm behind the model's surface";
    rows("surface-by-link", label, "mm", &each.collect::<Vec<_>>(), FARTHEST_MM)
}

fn outline_by_configuration(outcomes: &[ConfigurationOutcome], leftovers: &[Leftover]) -> String {
    let each = outcomes.iter().zip(leftovers).map(|(outcome, leftover)| Row {
        label: name(outcome),
        spread: Spread::new(leftover.outline_px.iter().copied()),
        muted: outcome.dropped.is_some(),
    });
    let label = "pixels outside the outline seen";
    rows("outline-by-configuration", label, "px", &each.collect::<Vec<_>>(), FARTHEST_PX)
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
