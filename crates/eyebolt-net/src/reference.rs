//! A plain executor, generic over the precision: every operation as it is defined, one loop after
//! the other. What other executors are compared with, and in 64 bits what gradients are.

mod backward;
mod forward;
mod ops;
mod real;

pub use real::Real;

use crate::executor::{Executor, Forward, Gradients, check_gradients};
use crate::graph::Graph;
use crate::{Batch, Error, Matrix, Parameters};

/// All values of a pass, in the graph's order.
#[derive(Clone, Debug)]
struct Pass<T> {
    values: Vec<Matrix<T>>,
    seed: u64,
}

/// The plain executor, in precision `T`.
#[derive(Clone, Debug, Default)]
pub struct Reference<T> {
    last: Option<Pass<T>>,
}

impl<T: Real> Reference<T> {
    /// Nothing kept yet.
    pub fn new() -> Self {
        Self { last: None }
    }

    /// [`Executor::forward`] with parameters of this precision.
    ///
    /// # Errors
    /// As there.
    pub fn forward_with(
        &mut self,
        graph: &Graph,
        parameters: &[Vec<T>],
        batch: &Batch,
        inputs: &[Matrix<T>],
        seed: u64,
    ) -> Result<Forward<T>, Error> {
        let (values, running) = forward::forward(graph, parameters, batch, inputs, Some(seed))?;
        let outputs = graph.outputs().iter().map(|output| values[output.0].clone()).collect();
        self.last = Some(Pass { values, seed });
        Ok(Forward { outputs, running })
    }

    /// [`Executor::infer`] with parameters of this precision.
    ///
    /// # Errors
    /// As there.
    pub fn infer_with(
        &self,
        graph: &Graph,
        parameters: &[Vec<T>],
        batch: &Batch,
        inputs: &[Matrix<T>],
    ) -> Result<Vec<Matrix<T>>, Error> {
        let (values, _) = forward::forward(graph, parameters, batch, inputs, None)?;
        Ok(graph.outputs().iter().map(|output| values[output.0].clone()).collect())
    }

    /// [`Executor::backward`] with parameters of this precision.
    ///
    /// # Errors
    /// As there.
    pub fn backward_with(
        &self,
        graph: &Graph,
        parameters: &[Vec<T>],
        batch: &Batch,
        output_gradients: &[Matrix<T>],
    ) -> Result<Gradients<T>, Error> {
        check_gradients(graph, batch, output_gradients)?;
        let last = self.last.as_ref().filter(|last| last.values.len() == graph.nodes().len());
        let last = last.ok_or_else(|| Error::input("backward", "no forward pass went before"))?;
        backward::backward(graph, parameters, batch, last, output_gradients)
    }
}

fn converted<T: Real>(parameters: &Parameters) -> Vec<Vec<T>> {
    let convert = |values: &Vec<f32>| values.iter().map(|&value| T::from_f32(value)).collect();
    parameters.values().iter().map(convert).collect()
}

fn inputs_of<T: Real>(batch: &Batch) -> Vec<Matrix<T>> {
    batch.inputs().iter().map(|matrix| matrix.map(T::from_f32)).collect()
}

fn rounded<T: Real>(values: Vec<T>) -> Vec<f32> {
    values.into_iter().map(T::to_f32).collect()
}

impl<T: Real> Executor for Reference<T> {
    fn device(&self) -> String {
        format!("reference, {}", std::any::type_name::<T>())
    }

    fn infer(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
    ) -> Result<Vec<Matrix>, Error> {
        batch.check(graph, parameters)?;
        let outputs = self.infer_with(graph, &converted(parameters), batch, &inputs_of(batch))?;
        Ok(outputs.iter().map(|output| output.map(T::to_f32)).collect())
    }

    fn forward(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
        seed: u64,
    ) -> Result<Forward, Error> {
        batch.check(graph, parameters)?;
        let inputs = inputs_of(batch);
        let pass = self.forward_with(graph, &converted(parameters), batch, &inputs, seed)?;
        Ok(Forward {
            outputs: pass.outputs.iter().map(|output| output.map(T::to_f32)).collect(),
            running: pass.running.into_iter().map(|(id, values)| (id, rounded(values))).collect(),
        })
    }

    fn backward(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
        output_gradients: &[Matrix],
        with_inputs: bool,
    ) -> Result<Gradients, Error> {
        batch.check(graph, parameters)?;
        let gradients: Vec<_> = output_gradients.iter().map(|g| g.map(T::from_f32)).collect();
        let found = self.backward_with(graph, &converted(parameters), batch, &gradients)?;
        let inputs = found.inputs.iter().filter(|_| with_inputs);
        Ok(Gradients {
            parameters: found.parameters.into_iter().map(rounded).collect(),
            inputs: inputs.map(|gradient| gradient.map(T::to_f32)).collect(),
        })
    }
}
