//! Sparse convolution and point networks, trained and run on the CPU.

mod batch;
pub mod coordinates;
mod cpu;
mod error;
mod executor;
pub mod graph;
pub mod losses;
mod matrix;
pub mod models;
mod parameters;
mod random;
pub mod reference;
mod row_map;
pub mod sampling;
#[doc(hidden)]
pub mod simd;
pub mod training;
pub mod weights;

pub use batch::{Batch, Sampling};
pub use cpu::Cpu;
pub use error::Error;
pub use executor::{Executor, Forward, Gradients};
pub use graph::{Graph, GraphBuilder};
pub use matrix::Matrix;
pub use parameters::Parameters;
