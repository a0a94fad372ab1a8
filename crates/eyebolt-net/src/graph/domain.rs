//! Which rows a value has, and how rows of one kind lead to rows of another.

use crate::coordinates::KernelSpec;

/// A set of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Domain {
    /// The points as they were handed in.
    Points,
    /// Occupied voxels, `stride` of the finest along an edge.
    Voxels {
        /// Edge, in voxels of the finest resolution.
        #[doc(alias = "tensor_stride")]
        stride: u32,
    },
    /// One row for each item of the batch.
    Items,
    /// Points that sampling kept, at a level from 1 on; level 0 is [`Domain::Points`].
    Samples {
        /// Number of samplings.
        level: u32,
    },
    /// The neighbours of each sample, one after the other.
    Groups {
        /// Level of the samples.
        level: u32,
        /// Which radius.
        scale: u32,
    },
}

impl Domain {
    /// Samples of a level, or the points themselves.
    pub fn samples(level: u32) -> Self {
        if level == 0 { Self::Points } else { Self::Samples { level } }
    }
}

/// How rows of one domain lead to rows of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum MapSpec {
    /// A convolution.
    Kernel(KernelSpec),
    /// From the finest voxels to the points in them.
    Slice,
    /// From the rows of each item to their maximum.
    Maxima(Domain),
    /// From the rows of each item to their mean.
    Means(Domain),
    /// From samples of the level below to the neighbours of each sample.
    Group {
        /// Level of the samples.
        level: u32,
        /// Which radius.
        scale: u32,
    },
    /// From neighbours to the sample that they are the neighbours of.
    Neighbours {
        /// Level of the samples.
        level: u32,
        /// Which radius.
        scale: u32,
    },
    /// From samples to those of the level below, by the three nearest.
    Interpolate {
        /// Level of the samples that values come from.
        level: u32,
    },
}

/// What an input is filled with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The features of the batch.
    Features,
    /// Where neighbours are, seen from their sample, in the units of the points; 3 channels on
    /// [`Domain::Groups`].
    Offsets {
        /// Level of the samples.
        level: u32,
        /// Which radius.
        scale: u32,
    },
    /// Where samples are, in the units and the frame of the points; 3 channels on
    /// [`Domain::samples`].
    Positions {
        /// Level of the samples; 0 are the points.
        level: u32,
    },
}

/// One radius of a ball query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleScale {
    /// In the units of the points.
    pub radius: f32,
    /// Neighbours of each sample; of fewer the first is repeated.
    pub neighbours: usize,
}

/// One set abstraction of PointNet++: how many samples, and around them which neighbours.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleLevel {
    /// Samples of each item.
    pub samples: usize,
    /// Radii, one grouping each.
    pub scales: Vec<SampleScale>,
}
