//! Every executor there is, and runs of them.

use eyebolt_net::reference::Reference;
use eyebolt_net::{
    Batch, Cpu, Executor, Forward, Gradients, Graph, Isa, Matrix, Parameters, PassOptions,
};

/// A new executor must pass what these pass.
pub fn executors() -> Vec<Box<dyn Executor>> {
    let mut all: Vec<Box<dyn Executor>> = vec![Box::new(Reference::<f64>::new())];
    all.extend(Isa::available().into_iter().map(|isa| Box::new(Cpu::with_isa(isa)) as Box<_>));
    all
}

/// Forward, and back from these gradients of the outputs, to inputs too.
pub fn forward_backward(
    executor: &mut dyn Executor,
    (graph, parameters, batch): (&Graph, &Parameters, &Batch),
    seed: u64,
    output_gradients: impl Fn(&[Matrix]) -> Vec<Matrix>,
) -> (Forward, Gradients) {
    let options = PassOptions { seed, with_inputs: true };
    let mut of = |outputs: &[Matrix]| Ok(output_gradients(outputs));
    executor.forward_backward(graph, parameters, batch, options, &mut of).unwrap()
}
