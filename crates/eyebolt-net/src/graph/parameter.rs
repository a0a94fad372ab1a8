//! What is learned.

/// What a parameter is for: how it starts, and whether it is trained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Weights, `fan_in` of which are summed into an output.
    Weight {
        /// Inputs of an output, over all offsets.
        fan_in: usize,
    },
    /// Added to outputs; starts at zero.
    Bias,
    /// Of a batch norm; starts at one.
    Scale,
    /// Of a batch norm; starts at zero.
    Shift,
    /// Running mean of a batch norm, not trained; starts at zero.
    Mean,
    /// Running variance of a batch norm, not trained; starts at one.
    Variance,
}

impl Role {
    /// Whether gradients change it.
    pub fn is_trained(self) -> bool {
        !matches!(self, Self::Mean | Self::Variance)
    }
}

/// Name, shape and role of a parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParameterSpec {
    /// As in a state dict: `block1.0.conv1.kernel`.
    pub name: String,
    /// `[offsets, inputs, outputs]` of a convolution, `[inputs, outputs]` of a linear layer, else
    /// `[channels]`.
    pub shape: Vec<usize>,
    /// What it is for.
    pub role: Role,
}

impl ParameterSpec {
    /// Number of values.
    pub fn len(&self) -> usize {
        self.shape.iter().product()
    }

    /// Whether it has no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
