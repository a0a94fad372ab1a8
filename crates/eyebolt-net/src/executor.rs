//! What runs a graph.

use crate::graph::{Graph, ParameterId};
use crate::{Batch, Error, Matrix, Parameters};

/// Runs graphs on some device. Graphs, models, training and tests know no more of a device than
/// this.
pub trait Executor {
    /// What it runs on, for people.
    fn device(&self) -> String;

    /// Values of the graph's outputs, with running statistics and without dropout.
    ///
    /// # Errors
    /// If batch, parameters and graph do not fit each other.
    fn infer(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
    ) -> Result<Vec<Matrix>, Error>;

    /// Values of the outputs in training, with the statistics of this batch and dropout by `seed`.
    /// What [`Executor::backward`] needs is kept until the next call.
    ///
    /// # Errors
    /// As [`Executor::infer`].
    fn forward(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
        seed: u64,
    ) -> Result<Forward, Error>;

    /// Gradients of a loss whose gradients with respect to the outputs of the last
    /// [`Executor::forward`] are these. Those of the inputs are left out, which saves time, unless
    /// `with_inputs`.
    ///
    /// # Errors
    /// If gradients do not fit the outputs, or no such `forward` went before.
    fn backward(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
        output_gradients: &[Matrix],
        with_inputs: bool,
    ) -> Result<Gradients, Error>;
}

/// What a forward pass in training gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Forward<T = f32> {
    /// In the graph's order.
    pub outputs: Vec<Matrix<T>>,
    /// New running values of batch norms, to be set once the step is taken.
    pub running: Vec<(ParameterId, Vec<T>)>,
}

/// What a backward pass gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradients<T = f32> {
    /// In the order of the graph's parameters; zero where nothing is trained.
    pub parameters: Vec<Vec<T>>,
    /// In the order of the graph's inputs, if asked for.
    pub inputs: Vec<Matrix<T>>,
}

/// That there is one gradient of the right shape for every output.
pub(crate) fn check_gradients<T: Copy + Default>(
    graph: &Graph,
    batch: &Batch,
    gradients: &[Matrix<T>],
) -> Result<(), Error> {
    let expected = graph.outputs().iter().map(|output| {
        let node = &graph.nodes()[output.0];
        (batch.rows[node.domain], node.channels)
    });
    if !expected.eq(gradients.iter().map(|gradient| (gradient.rows(), gradient.channels()))) {
        return Err(Error::input("output gradients", "not as many or not as large as the outputs"));
    }
    Ok(())
}

/// Whether dropout keeps a value: by seed, operation and place, so that nothing need be stored.
pub(crate) fn dropout_keeps(seed: u64, node: usize, place: usize, probability: f32) -> bool {
    let stream = crate::random::Random::new(seed).at(node as u64).at(place as u64);
    let mut stream = stream;
    stream.uniform() >= f64::from(probability)
}
