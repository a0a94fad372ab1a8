//! What a person sees while a command works, how long each stage took, and how Ctrl-C ends it.

mod bar;
mod counting;
mod interrupt;
mod waiting;

pub use bar::Bar;
pub use counting::Counting;
pub use interrupt::{Interrupt, leaves};
pub use waiting::Waiting;
