//! The graph of a description.

use super::checks;
use super::description::{Abstraction, PointNet2, Scale, Task};
use crate::Error;
use crate::graph::{Domain, Graph, GraphBuilder, NodeId, SampleLevel, SampleScale, Source};

impl PointNet2 {
    /// The network, for [`Batch::from_points`](crate::Batch::from_points).
    ///
    /// # Errors
    /// If the description makes no network.
    pub fn graph(&self) -> Result<Graph, Error> {
        checks::check(self)?;
        let mut g = GraphBuilder::with_sampling(self.abstractions.iter().map(sampling).collect());
        let mut values = vec![g.input(Source::Features, Domain::Points, self.inputs)];
        for (level, spec) in (1..).zip(&self.abstractions) {
            let below = values[values.len() - 1];
            values.push(abstraction(&mut g, level, spec, below)?);
        }
        let mut x = match &self.task {
            Task::Segmentation(up) => segmentation(&mut g, &values, up)?,
            Task::Classification(channels) => {
                classification(&mut g, values[values.len() - 1], values.len() - 1, channels)?
            }
        };
        for (index, &width) in self.head.iter().enumerate() {
            x = layer(&mut g, "head", index, x, width);
            x = g.dropout(x, self.dropout);
        }
        let logits = g.linear("logits", x, self.outputs, true);
        g.finish(&[logits])
    }
}

fn sampling(level: &Abstraction) -> SampleLevel {
    let scale = |s: &Scale| SampleScale { radius: s.radius, neighbours: s.neighbours };
    SampleLevel { samples: level.samples, scales: level.scales.iter().map(scale).collect() }
}

/// Around every sample of a level: where its neighbours are and what is known of them, through
/// layers, and the maximum.
fn abstraction(
    g: &mut GraphBuilder,
    level: u32,
    spec: &Abstraction,
    below: NodeId,
) -> Result<NodeId, Error> {
    let mut parts = Vec::new();
    for (scale, spec) in (0..).zip(&spec.scales) {
        let name = format!("sa{level}.{scale}");
        let offsets = g.offsets(level, scale);
        let grouped = g.group(&name, below, scale)?;
        let both = g.concatenate(&name, &[offsets, grouped])?;
        let x = layers(g, &name, both, &spec.channels);
        parts.push(g.group_max_pool(&name, x)?);
    }
    match parts[..] {
        [only] => Ok(only),
        _ => g.concatenate(&format!("sa{level}"), &parts),
    }
}

/// From the last level back to the points: interpolated, joined by what the level below knew.
fn segmentation(
    g: &mut GraphBuilder,
    values: &[NodeId],
    up: &[Vec<usize>],
) -> Result<NodeId, Error> {
    let mut x = values[values.len() - 1];
    for (level, channels) in (1..values.len()).rev().zip(up) {
        let name = format!("fp{level}");
        x = g.interpolate(&name, x)?;
        // Features of points are not joined, as in the published code.
        if level > 1 {
            x = g.concatenate(&name, &[values[level - 1], x])?;
        }
        x = layers(g, &name, x, channels);
    }
    Ok(x)
}

/// The last abstraction: a single group of all samples, around the origin.
fn classification(
    g: &mut GraphBuilder,
    x: NodeId,
    level: usize,
    channels: &[usize],
) -> Result<NodeId, Error> {
    let positions = g.positions(level as u32);
    let both = g.concatenate("global", &[positions, x])?;
    let x = layers(g, "global", both, channels);
    g.global_max_pool("pool", x)
}

fn layers(g: &mut GraphBuilder, name: &str, mut x: NodeId, channels: &[usize]) -> NodeId {
    for (index, &width) in channels.iter().enumerate() {
        x = layer(g, name, index, x, width);
    }
    x
}

/// A linear layer with batch norm and ReLU.
fn layer(g: &mut GraphBuilder, name: &str, index: usize, x: NodeId, width: usize) -> NodeId {
    let x = g.linear(&format!("{name}.conv{index}"), x, width, true);
    let x = g.batch_norm(&format!("{name}.norm{index}"), x);
    g.relu(x)
}
