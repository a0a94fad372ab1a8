//! What every loss gives.

use crate::Matrix;

/// A loss and its gradient with respect to what it was computed from.
#[derive(Clone, Debug, PartialEq)]
pub struct Loss {
    /// Its value.
    pub value: f64,
    /// As large as the prediction.
    pub gradient: Matrix,
}
