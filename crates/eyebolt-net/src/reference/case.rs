//! What is run: a graph, and values of its own.

use super::real::Real;
use crate::graph::Graph;
use crate::{Batch, Error, Matrix};

/// A graph on a batch with values of its own for parameters and inputs, in precision `T`.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a, T> {
    /// The network.
    pub graph: &'a Graph,
    /// In the graph's order.
    pub parameters: &'a [Vec<T>],
    /// Whose rows and maps are used.
    pub batch: &'a Batch,
    /// In place of those of the batch, of the same shapes.
    pub inputs: &'a [Matrix<T>],
}

impl<T: Real> Case<'_, T> {
    pub(super) fn check(&self) -> Result<(), Error> {
        if !self.batch.is_for(self.graph) || !self.graph.has_parameters(self.parameters) {
            return Err(Error::input("batch or parameters", "made for another network"));
        }
        let shape = |matrix: &Matrix<T>| (matrix.rows(), matrix.channels());
        let expected = self.batch.inputs().iter().map(|m| (m.rows(), m.channels()));
        if !self.inputs.iter().map(shape).eq(expected) {
            return Err(Error::input("inputs", "not of the shapes of those of the batch"));
        }
        Ok(())
    }

    pub(super) fn outputs(&self, values: &[Matrix<T>]) -> Vec<Matrix<T>> {
        self.graph.outputs().iter().map(|output| values[output.0].clone()).collect()
    }
}
