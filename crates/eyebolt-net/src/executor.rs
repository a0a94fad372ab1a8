//! What runs a graph, and what everything that does must agree on.
//!
//! An executor elsewhere needs nothing but what is public: operations from [`Graph::nodes`], rows
//! and maps from the [`Batch`], values from [`Parameters`], [`check`] and [`check_training`]
//! before a run, [`check_outputs`] and [`check_output_gradients`] between its halves. [`Reference`](crate::reference)
//! says in the plainest way what each operation is, and tests run the same cases on all.

use crate::graph::{Graph, Op, ParameterId};
use crate::random::Random;
use crate::{Batch, Error, Matrix, Parameters};

/// Runs graphs on some device. Graphs, models, training and tests know no more of a device than
/// this.
///
/// An executor gives the same bytes for the same call, whatever ran before and on however many
/// threads. It may keep what it copied to its device, by [`Batch::id`] and
/// [`Parameters::version`].
pub trait Executor {
    /// What it runs on, for people.
    fn device(&self) -> String;

    /// Values of the graph's outputs, with running statistics and without dropout.
    ///
    /// # Errors
    /// If batch, parameters and graph do not fit each other, an output is not finite, or there is not
    /// the memory.
    fn infer(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
    ) -> Result<Vec<Matrix>, Error>;

    /// A forward pass in training, with the statistics of this batch and with dropout, then the
    /// reverse pass. In between `output_gradients` is called once with the values of the outputs
    /// and gives the gradients of a loss with respect to them, one matrix for each.
    ///
    /// # Errors
    /// If batch, parameters and graph do not fit each other, a batch norm has a single row, an
    /// output is not finite, gradients do not fit the outputs, or there is not the memory; or what
    /// `output_gradients` fails with.
    fn forward_backward(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
        options: PassOptions,
        output_gradients: OutputGradients<'_>,
    ) -> Result<(Forward, Gradients), Error>;
}

/// From the values of outputs to the gradients of a loss with respect to them.
pub type OutputGradients<'a, T = f32> =
    &'a mut dyn FnMut(&[Matrix<T>]) -> Result<Vec<Matrix<T>>, Error>;

/// How to run forward and back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PassOptions {
    /// Of dropout, see [`dropout_keeps`].
    pub seed: u64,
    /// Whether gradients of the inputs are wanted too; without them the first layers have less to
    /// do.
    pub with_inputs: bool,
}

/// What the forward half of a pass in training gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Forward<T = f32> {
    /// In the graph's order.
    pub outputs: Vec<Matrix<T>>,
    /// New running values of batch norms, to be set once the step is taken: `(1 - momentum)` times
    /// the old ones and `momentum` times the batch's mean and unbiased variance.
    pub running: Vec<(ParameterId, Vec<T>)>,
}

/// What the reverse half gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradients<T = f32> {
    /// In the order of the graph's parameters; zero where nothing is trained.
    pub parameters: Vec<Vec<T>>,
    /// In the order of the graph's inputs, if asked for, with the rows of [`Batch::inputs`]: one
    /// for each finest voxel as [`VoxelSet::new`](crate::coordinates::VoxelSet::new) orders them,
    /// or one for each point.
    pub inputs: Vec<Matrix<T>>,
}

/// That a batch and parameters were made for a graph.
///
/// # Errors
/// If they were not.
pub fn check(graph: &Graph, parameters: &Parameters, batch: &Batch) -> Result<(), Error> {
    if !batch.is_for(graph) {
        return Err(Error::input("batch", "made for another network"));
    }
    if !graph.has_parameters(parameters.values()) {
        return Err(Error::input("parameters", "made for another network"));
    }
    Ok(())
}

/// That every batch norm has the rows that training needs.
///
/// # Errors
/// If one has a single row, of which nothing would remain but its shift.
pub fn check_training(graph: &Graph, batch: &Batch) -> Result<(), Error> {
    for node in graph.nodes() {
        if matches!(node.op, Op::BatchNorm(_)) && batch.rows()[node.domain] < 2 {
            let domain = graph.domains()[node.domain];
            let problem = format!(
                "{}: one row on {domain:?}, and a batch norm in training needs two or more; train \
                 on larger clouds or on several at once",
                node.name
            );
            return Err(Error::input("batch", problem));
        }
    }
    Ok(())
}

/// That there is one gradient of the right shape for every output.
///
/// # Errors
/// If there is not.
pub fn check_output_gradients<T: Copy + Default>(
    graph: &Graph,
    batch: &Batch,
    gradients: &[Matrix<T>],
) -> Result<(), Error> {
    let expected = graph.outputs().iter().map(|output| {
        let node = &graph.nodes()[output.index()];
        (batch.rows()[node.domain], node.channels)
    });
    if !expected.eq(gradients.iter().map(|gradient| (gradient.rows(), gradient.channels()))) {
        return Err(Error::input("output gradients", "not as many or not as large as the outputs"));
    }
    Ok(())
}

/// That no value of an output is NaN or infinite.
///
/// # Errors
/// The first that is.
pub fn check_outputs(outputs: &[Matrix]) -> Result<(), Error> {
    for (index, output) in outputs.iter().enumerate() {
        if let Some(bad) = output.first_not_finite() {
            let problem = format!("{bad}: features or weights are too large");
            return Err(Error::network(format!("output {index}"), problem));
        }
    }
    Ok(())
}

/// Whether dropout keeps a value: by seed, place of the operation in the graph and place of the
/// value in its matrix (row after row), so that nothing need be stored and every executor drops the
/// same. What is kept is divided by `1 - probability`.
pub fn dropout_keeps(seed: u64, node: usize, place: usize, probability: f32) -> bool {
    let mut stream = Random::new(seed).at(node as u64).at(place as u64);
    stream.uniform() >= f64::from(probability)
}
