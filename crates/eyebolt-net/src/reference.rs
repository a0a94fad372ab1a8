//! A plain executor, generic over the precision: every operation as it is defined, one loop after
//! the other. What other executors are compared with, and in 64 bits what gradients are.

mod backward;
mod case;
mod executor;
mod forward;
mod ops;
mod real;

pub use case::Case;
pub use executor::Reference;
pub use real::Real;
