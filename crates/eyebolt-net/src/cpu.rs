//! The CPU executor: blocks of rows on all cores, no atomics, so that the same input gives the
//! same bytes on any number of threads.

mod backward;
mod buffers;
mod convolve;
mod elementwise;
mod infer;
mod norm;
mod panels;
mod plan;
mod pool;
mod task;
mod train;
mod weight_gradient;

use crate::executor::{
    Executor, Forward, Gradients, OutputGradients, PassOptions, check, check_output_gradients,
    check_outputs, check_training,
};
use crate::graph::Graph;
use crate::simd::Isa;
use crate::{Batch, Error, Matrix, Parameters};
use buffers::Buffers;
use task::Task;

/// Runs graphs on the CPU, in the pool of threads that calls come from: rayon's own, with a thread
/// for every core, unless a call is [installed](rayon::ThreadPool::install) in another.
#[derive(Debug)]
pub struct Cpu {
    isa: Isa,
    buffers: Buffers,
}

impl Default for Cpu {
    fn default() -> Self {
        Self::new()
    }
}

impl Cpu {
    /// With the fastest instructions that this CPU has.
    pub fn new() -> Self {
        Self::with_isa(Isa::detect())
    }

    /// With these instructions.
    pub fn with_isa(isa: Isa) -> Self {
        Self { isa, buffers: Buffers::default() }
    }
}

impl Cpu {
    /// Refuses what needs more memory at once than this, apart from weights, maps and outputs, by an
    /// error. Without it, what the system cannot give is refused, and what it only promised ends the
    /// program.
    #[must_use]
    pub fn with_memory_limit(mut self, bytes: usize) -> Self {
        self.buffers.set_limit(bytes / size_of::<f32>());
        self
    }
}

impl Executor for Cpu {
    fn device(&self) -> String {
        format!("CPU, {}, {} threads", self.isa.name(), rayon::current_num_threads())
    }

    fn infer(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
    ) -> Result<Vec<Matrix>, Error> {
        check(graph, parameters, batch)?;
        self.buffers.start(true);
        let task = Task { isa: self.isa, graph, parameters, batch };
        let outputs = infer::infer(&task, &mut self.buffers);
        self.buffers.finish();
        let outputs = outputs?;
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
        check_training(graph, batch)?;
        self.buffers.start(false);
        let task = Task { isa: self.isa, graph, parameters, batch };
        let found = pass(&task, &mut self.buffers, options, output_gradients);
        self.buffers.finish();
        found
    }
}

fn pass(
    task: &Task<'_>,
    buffers: &mut Buffers,
    options: PassOptions,
    output_gradients: OutputGradients<'_>,
) -> Result<(Forward, Gradients), Error> {
    let (forward, kept) = train::forward(task, buffers, options.seed)?;
    check_outputs(&forward.outputs)?;
    let gradients = output_gradients(&forward.outputs)?;
    check_output_gradients(task.graph, task.batch, &gradients)?;
    let found = backward::backward(task, buffers, kept, &gradients, options.with_inputs)?;
    Ok((forward, found))
}
