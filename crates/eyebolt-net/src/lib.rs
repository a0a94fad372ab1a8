//! Sparse convolution and point networks, trained and run on the CPU.

mod batch;
pub mod coordinates;
mod cpu;
mod error;
mod executor;
pub mod graph;
mod matrix;
pub mod models;
mod parameters;
mod random;
pub mod reference;
mod row_map;
#[doc(hidden)]
pub mod simd;

pub use batch::Batch;
pub use cpu::Cpu;
pub use error::Error;
pub use executor::{Executor, Forward, Gradients};
pub use graph::{Graph, GraphBuilder};
pub use matrix::Matrix;
pub use parameters::Parameters;
