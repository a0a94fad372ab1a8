//! The operations.

use super::domain::Source;
use super::ids::{MapId, ParameterId};

/// Parameters and constants of a batch norm (Ioffe and Szegedy, *Batch normalization*, ICML 2015).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatchNorm {
    /// Multiplied last.
    pub scale: ParameterId,
    /// Added last.
    pub shift: ParameterId,
    /// Running mean, for inference.
    pub mean: ParameterId,
    /// Running variance, for inference.
    pub variance: ParameterId,
    /// Added to variances.
    pub epsilon: f32,
    /// Share of the newest batch in the running values.
    pub momentum: f32,
}

/// What a node does to the values of its inputs.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// Takes a value from outside.
    Input(Source),
    /// `out(u) = bias + sum over o of W[o] in(u + o)` over a kernel map; without a map, the same
    /// linear layer for every row.
    Convolution {
        /// Pairs of rows; `None` pairs each row with itself.
        map: Option<MapId>,
        /// `[offsets, inputs, outputs]`, or `[inputs, outputs]` without a map.
        weight: ParameterId,
        /// `[outputs]`.
        bias: Option<ParameterId>,
    },
    /// To mean 0 and variance 1 over all rows, then scaled and shifted.
    BatchNorm(BatchNorm),
    /// `x` where positive, else `slope * x`; slope 0 is ReLU.
    Activation {
        /// Of negative values, from 0 up to but not including 1.
        slope: f32,
    },
    /// Sum of two.
    Add,
    /// Channels of the first, then of the next.
    Concatenate,
    /// In training each value is zero with this probability, the rest scaled to keep the mean.
    Dropout {
        /// From 0 up to but not including 1.
        probability: f32,
    },
    /// Weighted sums of rows: slicing, grouping, interpolation, mean over items.
    Combine {
        /// Which rows.
        map: MapId,
    },
    /// Largest of each run of rows, channel by channel.
    MaxPool {
        /// Which runs.
        map: MapId,
    },
}
