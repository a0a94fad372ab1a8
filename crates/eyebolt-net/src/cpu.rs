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
mod train;
mod weight_gradient;

use crate::executor::{Executor, Forward, Gradients, check_gradients};
use crate::graph::Graph;
use crate::simd::Isa;
use crate::{Batch, Error, Matrix, Parameters};
use buffers::Buffers;
use train::Kept;

/// Runs graphs on the CPU, in the pool of threads that calls come from.
#[derive(Debug)]
pub struct Cpu {
    isa: Isa,
    buffers: Buffers,
    kept: Option<Kept>,
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

    /// With these instructions; the scalar ones if this CPU does not have them.
    pub fn with_isa(isa: Isa) -> Self {
        let isa = if Isa::available().contains(&isa) { isa } else { Isa::Scalar };
        Self { isa, buffers: Buffers::default(), kept: None }
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
        batch.check(graph, parameters)?;
        self.buffers.set_lean(true);
        let outputs = infer::infer(self.isa, &mut self.buffers, graph, parameters, batch);
        self.buffers.trim();
        outputs
    }

    fn forward(
        &mut self,
        graph: &Graph,
        parameters: &Parameters,
        batch: &Batch,
        seed: u64,
    ) -> Result<Forward, Error> {
        batch.check(graph, parameters)?;
        self.buffers.set_lean(false);
        if let Some(kept) = self.kept.take() {
            kept.give_back(&mut self.buffers);
        }
        let (forward, kept) =
            train::forward(self.isa, &mut self.buffers, graph, parameters, batch, seed)?;
        self.kept = Some(kept);
        Ok(forward)
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
        check_gradients(graph, batch, output_gradients)?;
        let kept = self.kept.take().filter(|kept| kept.fits(graph, batch));
        let kept = kept.ok_or_else(|| Error::input("backward", "no forward pass went before"))?;
        let task = backward::Task { isa: self.isa, graph, parameters, batch, with_inputs };
        backward::backward(&task, &mut self.buffers, kept, output_gradients)
    }
}
