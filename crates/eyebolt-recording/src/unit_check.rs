//! Whether lengths are plausible in the unit that a recording claims.

use crate::depth_unit::DepthUnit;
use crate::error::RecordingError;
use std::path::Path;

/// No depth camera for a robot arm sees this far, metres.
const FARTHEST_M: f32 = 100.0;

/// No depth camera sees this near, metres.
const NEAREST_M: f32 = 0.05;

/// About how many values stand for all.
const SAMPLES: usize = 8192;

/// Refuses `lengths_m` whose median shows that `unit` is not the unit that they were stored in.
pub(crate) fn check_unit(
    path: &Path,
    field: &str,
    unit: DepthUnit,
    lengths_m: impl ExactSizeIterator<Item = f32> + Clone,
) -> Result<(), RecordingError> {
    let Some(median_m) = median(lengths_m) else { return Ok(()) };
    let in_metres = unit == DepthUnit::METRES;
    let (problem, remedy) = if median_m > FARTHEST_M {
        let unit = if in_metres { "millimetres" } else { "a smaller unit" };
        (
            format!("the median is {median_m} m, which looks like {unit}"),
            "Set depth_unit = \"mm\" in recording.toml, or the metres of one",
        )
    } else if median_m < NEAREST_M && !in_metres {
        let told = match unit {
            DepthUnit::MILLIMETRES => format!("{} mm, which looks like metres", median_m * 1e3),
            _ => format!("{median_m} m, which looks like a larger unit"),
        };
        (
            format!("the median is {told}"),
            "Set depth_unit = \"m\" in recording.toml, or store millimetres",
        )
    } else {
        return Ok(());
    };
    Err(RecordingError::invalid(path, field, problem, remedy))
}

/// The median of the values that are positive and finite, of a sample where there are many.
fn median(values: impl ExactSizeIterator<Item = f32> + Clone) -> Option<f32> {
    let valid = |v: &f32| v.is_finite() && *v > 0.0;
    let step = (values.len() / SAMPLES).max(1);
    let mut sample: Vec<f32> = values.clone().step_by(step).filter(valid).collect();
    if sample.is_empty() {
        sample = values.filter(valid).collect();
    }
    let middle = sample.len() / 2;
    if sample.is_empty() {
        return None;
    }
    Some(*sample.select_nth_unstable_by(middle, f32::total_cmp).1)
}
