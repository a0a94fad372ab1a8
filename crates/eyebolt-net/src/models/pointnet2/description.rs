//! What a network of the family is described by.

use serde::{Deserialize, Serialize};

/// Neighbours within a radius, and the layers that they go through.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scale {
    /// In the units of the points.
    pub radius: f32,
    /// Neighbours of a sample.
    #[doc(alias = "nsample")]
    pub neighbours: usize,
    /// Channels of its layers.
    #[doc(alias = "mlp")]
    pub channels: Vec<usize>,
}

/// A set abstraction: samples, what is around them, and its maximum.
#[doc(alias = "set abstraction")]
#[doc(alias = "PointNetSetAbstraction")]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Abstraction {
    /// Samples of an item.
    #[doc(alias = "npoint")]
    pub samples: usize,
    /// One or several radii.
    pub scales: Vec<Scale>,
}

/// What comes out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Logits of every point. Channels of the layers behind each interpolation, coarsest first.
    #[doc(alias = "feature propagation")]
    #[doc(alias = "PointNetFeaturePropagation")]
    Segmentation(Vec<Vec<usize>>),
    /// Logits of every item. Channels of the layers that the last samples go through, each with
    /// where it is, before the maximum over all of them.
    #[doc(alias = "group_all")]
    Classification(Vec<usize>),
}

/// A network of the family.
///
/// Every grouping adds to the features of neighbours where they are, so features need not say it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointNet2 {
    /// Features of a point; 0 where places are all that is known.
    pub inputs: usize,
    /// Classes.
    pub outputs: usize,
    /// Level after level.
    pub abstractions: Vec<Abstraction>,
    /// What comes out.
    pub task: Task,
    /// Channels of the layers before the logits.
    pub head: Vec<usize>,
    /// Share of each of those layers' values that training drops.
    pub dropout: f32,
}
