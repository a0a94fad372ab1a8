//! The executor.

use super::case::Case;
use super::real::Real;
use super::{backward, forward};
use crate::executor::{
    Executor, Forward, Gradients, OutputGradients, PassOptions, check, check_output_gradients,
    check_outputs, check_training,
};
use crate::graph::Graph;
use crate::{Batch, Error, Matrix, Parameters};
use std::marker::PhantomData;

/// The plain executor, in precision `T`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reference<T>(PhantomData<T>);

impl<T: Real> Reference<T> {
    /// Of this precision.
    pub fn new() -> Self {
        Self(PhantomData)
    }

    /// [`Executor::infer`] in this precision.
    ///
    /// # Errors
    /// As there.
    pub fn infer_with(&self, case: Case<'_, T>) -> Result<Vec<Matrix<T>>, Error> {
        case.check()?;
        let (values, _) = forward::forward(case, None)?;
        Ok(case.outputs(&values))
    }

    /// [`Executor::forward_backward`] in this precision, always with gradients of the inputs.
    ///
    /// # Errors
    /// As there.
    pub fn forward_backward_with(
        &self,
        case: Case<'_, T>,
        seed: u64,
        output_gradients: OutputGradients<'_, T>,
    ) -> Result<(Forward<T>, Gradients<T>), Error> {
        case.check()?;
        check_training(case.graph, case.batch)?;
        let (values, running) = forward::forward(case, Some(seed))?;
        let outputs = case.outputs(&values);
        let of = output_gradients(&outputs)?;
        check_output_gradients(case.graph, case.batch, &of)?;
        let gradients = backward::backward(case, &values, seed, &of)?;
        Ok((Forward { outputs, running }, gradients))
    }
}

fn converted<T: Real>(parameters: &Parameters) -> Vec<Vec<T>> {
    let convert = |values: &Vec<f32>| values.iter().map(|&value| T::from_f32(value)).collect();
    parameters.values().iter().map(convert).collect()
}

fn widened<T: Real>(matrices: &[Matrix]) -> Vec<Matrix<T>> {
    matrices.iter().map(|matrix| matrix.map(T::from_f32)).collect()
}

fn narrowed<T: Real>(matrices: &[Matrix<T>]) -> Vec<Matrix> {
    matrices.iter().map(|matrix| matrix.map(T::to_f32)).collect()
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
        check(graph, parameters, batch)?;
        let (parameters, inputs) = (converted(parameters), widened(batch.inputs()));
        let case = Case { graph, parameters: &parameters, batch, inputs: &inputs };
        let outputs = narrowed::<T>(&self.infer_with(case)?);
        check_outputs(&outputs)?;
        Ok(outputs)
    }

    fn forward_backward(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
        options: PassOptions,
        output_gradients: OutputGradients<'_>,
    ) -> Result<(Forward, Gradients), Error> {
        check(graph, parameters, batch)?;
        let (parameters, inputs) = (converted(parameters), widened(batch.inputs()));
        let case = Case { graph, parameters: &parameters, batch, inputs: &inputs };
        let mut of = |outputs: &[Matrix<T>]| {
            let outputs = narrowed(outputs);
            check_outputs(&outputs)?;
            Ok(widened(&output_gradients(&outputs)?))
        };
        let (forward, found) = self.forward_backward_with(case, options.seed, &mut of)?;
        let running = forward.running.into_iter().map(|(id, values)| (id, rounded(values)));
        let forward = Forward { outputs: narrowed(&forward.outputs), running: running.collect() };
        let inputs = if options.with_inputs { narrowed(&found.inputs) } else { Vec::new() };
        let parameters = found.parameters.into_iter().map(rounded).collect();
        Ok((forward, Gradients { parameters, inputs }))
    }
}
