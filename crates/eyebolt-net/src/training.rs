//! Learning: optimisers, schedules, steps, checkpoints.

mod checkpoint;
mod optimiser;
mod schedule;
mod trainer;

pub use optimiser::{Optimiser, Rule};
pub use schedule::Schedule;
pub use trainer::Trainer;
