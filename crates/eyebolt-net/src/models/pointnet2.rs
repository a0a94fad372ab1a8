//! PointNet++ (Qi et al., *PointNet++: deep hierarchical feature learning on point sets in a
//! metric space*, NeurIPS 2017), with one or several radii a level.

use crate::Error;
use crate::graph::{
    Domain, Graph, GraphBuilder, MapSpec, NodeId, SampleLevel, SampleScale, Source,
};
use serde::{Deserialize, Serialize};

/// More of anything is a mistake, or malice.
const MOST: usize = 1 << 14;

/// Neighbours within a radius, and the layers that they go through.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scale {
    /// In the units of the points.
    pub radius: f32,
    /// Neighbours of a sample.
    pub neighbours: usize,
    /// Channels of its layers.
    pub channels: Vec<usize>,
}

/// A set abstraction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Abstraction {
    /// Samples of an item.
    pub samples: usize,
    /// One or several radii.
    pub scales: Vec<Scale>,
}

/// What comes out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Logits of every point. Channels of the layers behind each interpolation, coarsest first.
    Segmentation(Vec<Vec<usize>>),
    /// Logits of every item. Channels of the layers before the maximum over samples.
    Classification(Vec<usize>),
}

/// A network of the family.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointNet2 {
    /// Features of a point.
    pub inputs: usize,
    /// Classes.
    pub outputs: usize,
    /// Level after level.
    pub abstractions: Vec<Abstraction>,
    /// What comes out.
    pub task: Task,
    /// Channels of the layer before the logits.
    pub head: usize,
    /// Share of that layer's values that training drops.
    pub dropout: f32,
}

impl PointNet2 {
    /// The single-scale segmentation network of the paper that eyebolt is about: 1024, 256, 64, 16
    /// samples within 0.1, 0.2, 0.4, 0.8 of the unit sphere, 32 neighbours.
    pub fn single_scale(inputs: usize, outputs: usize) -> Self {
        let level = |samples, radius, channels: [usize; 3]| Abstraction {
            samples,
            scales: vec![Scale { radius, neighbours: 32, channels: channels.to_vec() }],
        };
        Self {
            inputs,
            outputs,
            abstractions: vec![
                level(1024, 0.1, [32, 32, 64]),
                level(256, 0.2, [64, 64, 128]),
                level(64, 0.4, [128, 128, 256]),
                level(16, 0.8, [256, 256, 512]),
            ],
            task: segmentation(),
            head: 128,
            dropout: 0.5,
        }
    }

    /// The usual multi-scale one: two radii a level, 16 and 32 neighbours.
    pub fn multi_scale(inputs: usize, outputs: usize) -> Self {
        let level = |samples, radius: f32, near: [usize; 3], far: [usize; 3]| Abstraction {
            samples,
            scales: vec![
                Scale { radius: radius / 2.0, neighbours: 16, channels: near.to_vec() },
                Scale { radius, neighbours: 32, channels: far.to_vec() },
            ],
        };
        Self {
            abstractions: vec![
                level(1024, 0.1, [16, 16, 32], [32, 32, 64]),
                level(256, 0.2, [64, 64, 128], [64, 96, 128]),
                level(64, 0.4, [128, 196, 256], [128, 196, 256]),
                level(16, 0.8, [256, 256, 512], [256, 384, 512]),
            ],
            ..Self::single_scale(inputs, outputs)
        }
    }

    /// The network, for [`Batch::from_points`](crate::Batch::from_points).
    ///
    /// # Errors
    /// If the description makes no network.
    pub fn graph(&self) -> Result<Graph, Error> {
        self.check()?;
        let levels = self.abstractions.iter().map(|level| SampleLevel {
            samples: level.samples,
            scales: level
                .scales
                .iter()
                .map(|s| SampleScale { radius: s.radius, neighbours: s.neighbours })
                .collect(),
        });
        let mut g = GraphBuilder::with_sampling(levels.collect());
        let mut values = vec![g.input(Source::Features, Domain::Points, self.inputs)];
        for (index, level) in self.abstractions.iter().enumerate() {
            let below = values[index];
            values.push(abstraction(&mut g, index as u32 + 1, level, below)?);
        }
        let top = values.len() - 1;
        let x = match &self.task {
            Task::Segmentation(up) => {
                let mut x = values[top];
                for (place, channels) in up.iter().enumerate() {
                    let level = top - place;
                    let skip = (level > 1).then(|| values[level - 1]);
                    x = propagation(&mut g, level as u32, x, skip, channels)?;
                }
                x
            }
            Task::Classification(channels) => {
                let x = layers(&mut g, "global", values[top], channels);
                g.max_pool("pool", x, MapSpec::Items(Domain::samples(top as u32)))?
            }
        };
        let x = layers(&mut g, "head", x, &[self.head]);
        let x = g.dropout(x, self.dropout);
        let logits = g.linear("logits", x, self.outputs, true);
        g.finish(&[logits])
    }

    fn check(&self) -> Result<(), Error> {
        let bad = |problem: String| Err(Error::network("pointnet2", problem));
        if !(0.0..1.0).contains(&self.dropout) {
            return bad(format!(
                "dropout {} is not from 0 up to but not including 1",
                self.dropout
            ));
        }
        let mut counts = vec![self.inputs, self.outputs, self.head];
        for level in &self.abstractions {
            counts.push(level.samples);
            counts.push(level.scales.len());
            for scale in &level.scales {
                if !(scale.radius.is_finite() && scale.radius > 0.0) {
                    return bad(format!("radius {} is not positive", scale.radius));
                }
                counts.push(scale.neighbours);
                counts.extend(&scale.channels);
            }
        }
        match &self.task {
            Task::Segmentation(up) if up.len() != self.abstractions.len() => {
                return bad(format!("{} levels up, not as many as down", up.len()));
            }
            Task::Segmentation(up) => counts.extend(up.iter().flatten()),
            Task::Classification(channels) => counts.extend(channels),
        }
        match counts.iter().find(|count| !(1..=MOST).contains(*count)) {
            Some(count) => bad(format!("{count} of something that there must be 1 to {MOST} of")),
            None if self.abstractions.len() > 16 => bad("more than 16 levels".into()),
            None => Ok(()),
        }
    }
}

/// As the paper has it for four levels.
fn segmentation() -> Task {
    Task::Segmentation(vec![vec![256, 256], vec![256, 256], vec![256, 128], vec![128, 128, 128]])
}

/// Linear layers with batch norm and ReLU.
fn layers(g: &mut GraphBuilder, name: &str, mut x: NodeId, channels: &[usize]) -> NodeId {
    for (index, &width) in channels.iter().enumerate() {
        x = g.linear(&format!("{name}.conv{index}"), x, width, true);
        x = g.batch_norm(&format!("{name}.norm{index}"), x);
        x = g.relu(x);
    }
    x
}

fn abstraction(
    g: &mut GraphBuilder,
    level: u32,
    spec: &Abstraction,
    below: NodeId,
) -> Result<NodeId, Error> {
    let mut parts = Vec::new();
    for (scale, spec) in (0..).zip(&spec.scales) {
        let name = format!("sa{level}.{scale}");
        let offsets = g.input(Source::Offsets { level, scale }, Domain::Groups { level, scale }, 3);
        let grouped = g.combine(&name, below, MapSpec::Group { level, scale })?;
        let both = g.concatenate(&name, &[offsets, grouped])?;
        let x = layers(g, &name, both, &spec.channels);
        parts.push(g.max_pool(&name, x, MapSpec::Neighbours { level, scale })?);
    }
    match parts[..] {
        [only] => Ok(only),
        _ => g.concatenate(&format!("sa{level}"), &parts),
    }
}

fn propagation(
    g: &mut GraphBuilder,
    level: u32,
    x: NodeId,
    skip: Option<NodeId>,
    channels: &[usize],
) -> Result<NodeId, Error> {
    let name = format!("fp{level}");
    let mut x = g.combine(&name, x, MapSpec::Interpolate { level })?;
    if let Some(skip) = skip {
        x = g.concatenate(&name, &[skip, x])?;
    }
    Ok(layers(g, &name, x, channels))
}
