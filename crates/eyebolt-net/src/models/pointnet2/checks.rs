//! What a description of a network may ask for. It may come from a file of anybody's.

use super::description::{Abstraction, PointNet2, Task};
use crate::Error;

/// More samples or channels are a mistake, or malice.
const MOST: usize = 1 << 14;
/// More neighbours of a sample.
const MOST_NEIGHBOURS: usize = 1 << 10;
/// More layers, scales or levels in a row.
const MOST_PARTS: usize = 16;

pub fn check(net: &PointNet2) -> Result<(), Error> {
    if !(0.0..1.0).contains(&net.dropout) {
        let problem = format!("{} is not from 0 up to but not including 1", net.dropout);
        return bad("dropout", problem);
    }
    // Without features a network still sees where points are.
    within("inputs", &[net.inputs.max(1)], MOST)?;
    within("outputs", &[net.outputs], MOST)?;
    at_most_parts("head", net.head.len(), 0)?;
    within("head", &net.head, MOST)?;
    at_most_parts("abstractions", net.abstractions.len(), 1)?;
    net.abstractions.iter().try_for_each(abstraction)?;
    match &net.task {
        Task::Segmentation(up) if up.len() != net.abstractions.len() => {
            bad("task", format!("{} levels up, not as many as down", up.len()))
        }
        Task::Segmentation(up) => up.iter().try_for_each(|channels| layers("task", channels)),
        Task::Classification(channels) => layers("task", channels),
    }
}

fn abstraction(level: &Abstraction) -> Result<(), Error> {
    within("samples", &[level.samples], MOST)?;
    at_most_parts("scales", level.scales.len(), 1)?;
    level.scales.iter().try_for_each(|scale| {
        if !(scale.radius.is_finite() && scale.radius > 0.0) {
            return bad("scales", format!("radius {} is not positive", scale.radius));
        }
        within("neighbours", &[scale.neighbours], MOST_NEIGHBOURS)?;
        layers("scales", &scale.channels)
    })
}

fn layers(field: &str, channels: &[usize]) -> Result<(), Error> {
    at_most_parts(field, channels.len(), 0)?;
    within(field, channels, MOST)
}

fn at_most_parts(field: &str, count: usize, least: usize) -> Result<(), Error> {
    if (least..=MOST_PARTS).contains(&count) {
        return Ok(());
    }
    bad(field, format!("{count} of them; there must be {least} to {MOST_PARTS}"))
}

fn within(field: &str, counts: &[usize], most: usize) -> Result<(), Error> {
    match counts.iter().find(|count| !(1..=most).contains(*count)) {
        Some(count) => bad(field, format!("{count}; it must be 1 to {most}")),
        None => Ok(()),
    }
}

fn bad(field: &str, problem: String) -> Result<(), Error> {
    Err(Error::network(format!("pointnet2, {field}"), problem))
}
