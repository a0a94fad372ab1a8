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

impl Loss {
    /// The sum of two losses of the same prediction.
    ///
    /// # Panics
    /// If the predictions have different shapes.
    #[must_use]
    pub fn plus(mut self, other: &Self) -> Self {
        let shape = |loss: &Self| (loss.gradient.rows(), loss.gradient.channels());
        assert_eq!(shape(&self), shape(other), "losses of the same prediction");
        self.value += other.value;
        let pairs = self.gradient.values_mut().iter_mut().zip(other.gradient.values());
        pairs.for_each(|(sum, part)| *sum += part);
        self
    }
}
